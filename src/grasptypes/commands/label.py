"""The command `label`.

The label follows from where the hand is and how it is closed; physics is not tested.
"""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from grasptypes.commands.settings import add_folder, printable
from grasptypes.objects.units import UNITS_M

if TYPE_CHECKING:
    from grasptypes.labels.grasp_type import Label

SUMMARY = "Label grasps of a mesh with their types, and explain each label."


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The options of `label`."""
    parser.add_argument(
        "grasps",
        type=Path,
        help="CSV with the column HandConfiguration, such as the grasps.csv of a plan",
    )
    parser.add_argument("--object", type=Path, required=True, help="a mesh (STL, OBJ, PLY, GLB)")
    parser.add_argument(
        "--unit", choices=UNITS_M, default="m", help="unit of the mesh (default: m)"
    )
    parser.add_argument(
        "--hand", help="name of a hand, or folder with one (default: hand in params.yaml)"
    )
    parser.add_argument("--json", action="store_true", help="print JSON")
    add_folder(parser)


def run(args: argparse.Namespace) -> str:
    """Label the grasps; returns the text to print.

    Raises:
        InputError: table, mesh or hand cannot be read.
    """
    from grasptypes.files import json_text
    from grasptypes.hands.reading import load_hand
    from grasptypes.labels.grasp_table import read_grasp_table
    from grasptypes.labels.grasp_type import explain, measure, thresholds_of
    from grasptypes.objects.loading import load_object
    from grasptypes.settings.params import checkout_params

    params = checkout_params(args.folder)
    hand = load_hand(args.hand) if args.hand else load_hand(params.hand, args.folder or ".")
    _, states = read_grasp_table(args.grasps, hand)
    geometry = load_object(args.object, args.unit, settings=params.objects)
    measures = measure(geometry.distance_grid, states, params.grasp_types.contacts)
    labels = explain(measures, thresholds_of(params.grasp_types, hand))
    if args.json:
        return json_text([_plain(label) for label in labels])
    return _report(printable(args.object.name), labels)


def _plain(label: Label) -> dict[str, object]:
    return {
        "grasp_type": label.grasp_type,
        "branch": label.branch,
        "margin": float(label.margin),
        "virtual_fingers": int(label.virtual_fingers),
    }


def _report(name: str, labels: list[Label]) -> str:
    """One row per grasp, in the order of the table."""
    rows = [
        f"{number:5}  {label.grasp_type:18}{label.branch}"
        for number, label in enumerate(labels, start=1)
    ]
    return "\n".join([f"{name}: {len(labels)} grasps", "", *rows]) + "\n"
