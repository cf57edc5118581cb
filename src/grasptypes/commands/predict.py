"""The command `predict`; what it does is in `predicting`, which imports heavy libraries."""

from __future__ import annotations

import argparse
from pathlib import Path

from grasptypes.commands.settings import add_folder
from grasptypes.objects.units import UNITS_M

SUMMARY = "Predict the grasp types of an object: from images, a mesh or a point cloud."


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The options of `predict`."""
    parser.add_argument(
        "shown",
        nargs="+",
        type=Path,
        help="images, folders of images, meshes (STL, OBJ, PLY, GLB), points (PLY, NPY, PCD)",
    )
    parser.add_argument("--task", help="task, by name or in words, e.g. use")
    parser.add_argument(
        "--same-object", action="store_true", help="all images show one object: one answer for it"
    )
    parser.add_argument(
        "--size", metavar="SIZE", help="longest extent of the object, or all three: 12cm, 12x5x3cm"
    )
    parser.add_argument("--mass-kg", type=float, help="mass of the object (default: unknown)")
    parser.add_argument(
        "--box", metavar="L,T,R,B", help="part of the image that shows the object, in pixels"
    )
    parser.add_argument("--mask", type=Path, help="image of the same shape, white on the object")
    parser.add_argument(
        "--depth",
        type=Path,
        help="depth image (PNG or NPY; 16-bit integers are millimetres, floats metres), in which "
        "the object is measured",
    )
    parser.add_argument(
        "--intrinsics", type=Path, help="JSON file with fx, fy, cx and cy of the depth camera"
    )
    parser.add_argument(
        "--background", metavar="COLOUR", help="colour behind transparent pixels, e.g. white"
    )
    parser.add_argument("--unit", choices=UNITS_M, help="unit of a mesh or of points (default: m)")
    parser.add_argument("--model", help="general, or a model of Table I: a, b, c, d, e or its name")
    parser.add_argument("--labels", help="labels the model was trained on: simulated or published")
    parser.add_argument("--json", action="store_true", help="print JSON")
    parser.add_argument(
        "--picture", type=Path, help="PNG file for a figure of the images and their answers"
    )
    parser.add_argument(
        "--explain", type=Path, help="PNG file for a figure of what spoke for each type"
    )
    add_folder(parser)


def run(args: argparse.Namespace) -> str:
    """Returns the text to print.

    Raises:
        InputError: an argument is wrong; nothing is written.
    """
    from grasptypes.commands.predicting import predict

    return predict(args)
