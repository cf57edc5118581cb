"""What the command `predict` does: files in, answers out. Torch is imported after all checks."""

from __future__ import annotations

import argparse
import json
from collections.abc import Callable, Iterable, Iterator, Sequence
from functools import partial
from itertools import islice
from pathlib import Path
from typing import TYPE_CHECKING, Any

from grasptypes.commands.messages import say
from grasptypes.commands.settings import check_target, printable, read_task
from grasptypes.errors import InputError
from grasptypes.predictors.known_size import facts_of_size, read_size
from grasptypes.predictors.shown import Hints, Shown, is_photo, look, together
from grasptypes.renders.image_parts import read_box
from grasptypes.renders.photos import check_photo, photo_files, read_background
from grasptypes.settings.commands import PhotoLimits
from grasptypes.settings.params import checkout_params

if TYPE_CHECKING:
    from grasptypes.predictors.answers import Answer
    from grasptypes.predictors.prediction import Predictor

# A figure with more rows is too tall for image viewers.
MAX_ROWS = 40


def predict(args: argparse.Namespace) -> str:
    """Returns the text to print.

    Raises:
        InputError: an argument is wrong; nothing is written.
    """
    params = checkout_params(args.folder)
    size_m = read_size(args.size) if args.size is not None else ()
    facts_of_size(size_m, args.mass_kg, params.predict)
    files, skipped = _files(args.shown)
    hints = _hints(args)
    _check_options(args, files, hints)
    _check_targets(args, files)
    # Find bad images before torch takes seconds to load, without keeping a folder in memory.
    one = args.same_object or len(files) == 1
    see = partial(look, hints=hints, params=params)
    check = partial(_check, hints=hints, limits=params.predict.photos)
    looks = list(_looks(args.shown, files, see if one else check, skipped))
    if args.picture and len(looks) > MAX_ROWS:
        raise InputError(args.shown[0], "", f"--picture shows at most {MAX_ROWS} images")

    from grasptypes.predictors.answers import report
    from grasptypes.predictors.prediction import Predictor

    predictor = Predictor.load(args.folder, labels=args.labels, model=args.model, params=params)
    task = predictor.check_task(args.task and read_task(args.task, predictor.card.tasks))
    again = iter(looks) if one else _looks(args.shown, [file for file, _ in looks], see, skipped)
    facts = {"size_m": size_m, "mass_kg": args.mass_kg}
    answers: list[Answer] = []
    drawn: list[Shown] = []
    objects = _named(again, one)
    while group := list(islice(objects, params.predict.batch)):
        names, shown = zip(*group, strict=True)
        answers += predictor.answer(shown, task, names=names, **facts)
        drawn += shown if args.picture or args.explain else ()
    for file, reason in sorted(skipped.items()):
        say(f"skipped {printable(file.name)}: {reason}")
    if args.picture:
        _draw(drawn, answers, predictor, task, args.picture)
    if args.explain:
        _explain(drawn[0], predictor, task, facts, args.explain)
    if args.json:
        return json.dumps(predictor.describe(answers, task), indent=2) + "\n"
    return report(answers, predictor.card, task)


def _files(shown: Sequence[Path]) -> tuple[list[Path], dict[Path, str]]:
    """The files that are named or in folders that are named, and what a folder has besides."""
    files: list[Path] = []
    skipped: dict[Path, str] = {}
    for path in shown:
        found, others = photo_files(path)
        files += found
        skipped |= others
    return files, skipped


def _hints(args: argparse.Namespace) -> Hints:
    """What the options say of an image or a file."""
    return Hints(
        args.unit,
        None if args.background is None else read_background(args.background),
        None if args.box is None else read_box(args.box),
        args.mask,
        args.depth,
        args.intrinsics,
    )


def _check_options(args: argparse.Namespace, files: Sequence[Path], hints: Hints) -> None:
    """Reject options that have no meaning for what is shown."""
    if len(files) > 1:
        for name in ("box", "mask", "depth", "intrinsics"):
            if getattr(hints, name) is not None:
                raise InputError(f"--{name}", "", f"is for one image, but there are {len(files)}")
        if args.explain and not args.same_object:
            raise InputError(
                "--explain", "", f"is for one object, but there are {len(files)} files"
            )
    if args.size is not None and hints.depth is not None:
        raise InputError("--size", args.size, "is measured in the depth image: leave one out")
    if args.size is not None and not all(map(is_photo, files)):
        raise InputError("--size", args.size, "is for images: a mesh has a size")


def _check_targets(args: argparse.Namespace, files: Sequence[Path]) -> None:
    """Reject figures that cannot be written, or that would replace what is read."""
    for target in filter(None, (args.picture, args.explain)):
        check_target(target, ".png")
        _check_apart(target, args.shown, files)


def _check(file: Path, hints: Hints, limits: PhotoLimits) -> None:
    """Check the header of an image."""
    if is_photo(file):
        check_photo(file, limits, hints.background)


def _looks(
    named: Sequence[Path],
    files: Sequence[Path],
    look_at: Callable[[Path], Any],
    skipped: dict[Path, str],
) -> Iterator[tuple[Path, Any]]:
    """Yield what `look_at` returns for each usable file.

    Unusable images of a folder are added to `skipped` with their reason.

    Raises:
        InputError: a file that is named is unusable, or all images of the folders are.
    """
    failed = {}
    for file in files:
        try:
            seen = look_at(file)
        except InputError as error:
            if file in named:
                raise
            failed[file] = error.message
        else:
            yield file, seen
    skipped |= failed
    if failed and len(failed) == len(files):
        file, reason = next(iter(failed.items()))
        message = f"contains no usable image; {printable(file.name)}: {reason}"
        raise InputError(file.parent, "", message)


def _named(looks: Iterable[tuple[Path, Shown]], one: bool) -> Iterator[tuple[str, Shown]]:
    """Objects with names; `one`: all files show the same."""
    seen = looks
    if one:
        parts = list(looks)
        names = [printable(file.name) for file, _ in parts]
        name = names[0] if len(names) == 1 else f"{names[0]} and {len(names) - 1} more"
        seen = [(Path(name), together([shown for _, shown in parts]))]
    for file, shown in seen:
        count = len(shown.pictures)
        mean = f", from {count} {'views' if not is_photo(file) else 'images'}" if count > 1 else ""
        yield printable(file.name) + mean, shown


def _check_apart(target: Path, named: Sequence[Path], files: Sequence[Path]) -> None:
    """Reject a figure that would replace an image, or be one of a folder's the next time."""
    place = target.resolve()
    if place in [file.resolve() for file in files]:
        raise InputError(target, "", "is one of the input images; name another file")
    if place.parent in [path.resolve() for path in named if path.is_dir()]:
        raise InputError(target, "", "is in the folder of input images; name another place")


def _draw(
    drawn: Sequence[Shown],
    answers: Sequence[Answer],
    predictor: Predictor,
    task: str,
    target: Path,
) -> None:
    from grasptypes.labels.label_pictures import save_figure
    from grasptypes.predictors.prediction_pictures import draw_answers, montage

    tiles = [montage(shown.pictures, predictor.card.input_px) for shown in drawn]
    save_figure(draw_answers(tiles, answers, predictor.card, task), target)


def _explain(
    shown: Shown, predictor: Predictor, task: str, facts: dict[str, Any], target: Path
) -> None:
    from grasptypes.labels.label_pictures import save_figure
    from grasptypes.predictors.prediction_pictures import draw_explanation

    picture, heat = predictor.explain(shown, task, **facts)
    title = f"what spoke for each type, for {task}"
    save_figure(draw_explanation(picture, heat, title), target)
