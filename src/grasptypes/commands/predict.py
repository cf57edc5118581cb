"""The command `predict`.

Heavy libraries are imported after the arguments have been checked.
"""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Callable, Iterator, Sequence
from functools import partial
from pathlib import Path
from typing import Any

from grasptypes.commands.settings import add_folder, check_target, printable, read_task
from grasptypes.errors import InputError
from grasptypes.objects.units import UNITS_M
from grasptypes.predictors.known_size import facts_of_size
from grasptypes.renders.photos import check_photo, photo_files, read_background, read_photo
from grasptypes.settings.commands import PhotoLimits
from grasptypes.settings.params import checkout_params

SUMMARY = "Predict the grasp types of an image, a folder of images, or a mesh."
# A figure with more rows is too tall for image viewers.
MAX_ROWS = 40


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The options of `predict`."""
    shown = parser.add_mutually_exclusive_group(required=True)
    shown.add_argument("--image", type=Path, help="an image, or a folder of images")
    shown.add_argument(
        "--object", type=Path, help="a mesh (STL, OBJ, PLY, GLB), rendered from several views"
    )
    parser.add_argument(
        "--background", metavar="COLOUR", help="colour behind transparent pixels, e.g. white"
    )
    parser.add_argument("--unit", choices=UNITS_M, help="unit of the mesh (default: m)")
    parser.add_argument("--task", help="task, by name or in words, e.g. use")
    parser.add_argument(
        "--size-m",
        type=float,
        nargs="+",
        default=[],
        metavar="LENGTH",
        help="longest extent of the object, or all three, in metres; a mesh has its own",
    )
    parser.add_argument("--mass-kg", type=float, help="mass of the object (default: unknown)")
    parser.add_argument("--model", help="general, or a model of Table I: a, b, c, d, e or its name")
    parser.add_argument("--labels", help="labels the model was trained on: simulated or published")
    parser.add_argument("--json", action="store_true", help="print JSON")
    parser.add_argument(
        "--picture", type=Path, help="PNG file for a figure of the images and their answers"
    )
    add_folder(parser)


def run(args: argparse.Namespace) -> str:
    """Returns the text to print.

    Raises:
        InputError: an argument is wrong; nothing is written.
    """
    params = checkout_params(args.folder)
    limits = params.predict.photos
    _check_options(args)
    facts_of_size(args.size_m, args.mass_kg, params.predict)
    background = _background(args)
    files, skipped = photo_files(args.image) if args.image else ([], {})
    if args.picture:
        check_target(args.picture, ".png")
        _check_apart(args.picture, args.image, files)
    looks = partial(_looks, args.image, skipped, limits, background)
    # Find bad images before torch takes seconds to load.
    files = [file for file, _ in looks(read_photo if len(files) == 1 else check_photo, files)]
    if args.picture and len(files) > MAX_ROWS:
        raise InputError(args.image, "", f"--picture shows at most {MAX_ROWS} images")

    from grasptypes.predictors.prediction import Predictor, report

    predictor = Predictor.load(args.folder, labels=args.labels, model=args.model, params=params)
    task = predictor.check_task(args.task and read_task(args.task, predictor.card.tasks))
    if args.object:
        from grasptypes.objects.loading import own_object

        views, size_m = predictor.mesh_images(own_object(args.object, args.unit or "m"))
        shown = iter([(f"{printable(args.object.name)}, mean of {len(views)} views", views)])
    else:
        size_m = args.size_m
        shown = ((printable(file.name), photo) for file, photo in looks(read_photo, files))
    answers, pictures = [], []
    for name, images in shown:
        answer = predictor.predict(images, task, name=name, size_m=size_m, mass_kg=args.mass_kg)
        answers.append(answer)
        if args.picture:
            pictures.append(predictor.images(images))
    for file, reason in sorted(skipped.items()):
        sys.stderr.write(f"skipped {printable(file.name)}: {reason}\n")
    if args.picture:
        from grasptypes.labels.label_pictures import save_figure
        from grasptypes.predictors.prediction_pictures import draw_answers, montage

        tiles = [montage(picture) for picture in pictures]
        save_figure(draw_answers(tiles, answers, predictor.card, task), args.picture)
    if args.json:
        return json.dumps(predictor.describe(answers, task), indent=2) + "\n"
    return report(answers, predictor.card, task)


def _check_options(args: argparse.Namespace) -> None:
    """Reject options that have no meaning for what is shown."""
    if args.object and args.size_m:
        raise InputError("--size-m", "", "is for images (--image): a mesh has a size")
    if args.image and args.unit:
        raise InputError("--unit", args.unit, "is for meshes (--object): an image has no unit")


def _background(args: argparse.Namespace) -> tuple[int, int, int] | None:
    if args.background is None:
        return None
    if args.object:
        message = "is for images (--image): a mesh has no transparent pixels"
        raise InputError("--background", args.background, message)
    return read_background(args.background)


def _looks(
    image: Path,
    skipped: dict[Path, str],
    limits: PhotoLimits,
    background: tuple[int, int, int] | None,
    look: Callable[..., Any],
    files: Sequence[Path],
) -> Iterator[tuple[Path, Any]]:
    """Yield what `look` (`check_photo` or `read_photo`) returns for each usable image.

    Unusable images of a folder are added to `skipped` with their reason.

    Raises:
        InputError: the image that --image names is unusable, or all images of its folder are.
    """
    failed = {}
    for file in files:
        try:
            seen = look(file, limits, background)
        except InputError as error:
            if file == image:
                raise
            failed[file] = error.message
        else:
            yield file, seen
    skipped |= failed
    if failed and len(failed) == len(files):
        file, reason = next(iter(failed.items()))
        message = f"contains no usable image; {printable(file.name)}: {reason}"
        raise InputError(image, "", message)


def _check_apart(target: Path, image: Path | None, files: Sequence[Path]) -> None:
    """Reject a figure that would replace an image, or be one of the folder's the next time."""
    place = target.resolve()
    if place in [file.resolve() for file in files]:
        raise InputError(target, "", "is one of the input images; name another file with --picture")
    if image and image.is_dir() and place.parent == image.resolve():
        raise InputError(
            target, "", "is in the folder of input images; name another place with --picture"
        )
