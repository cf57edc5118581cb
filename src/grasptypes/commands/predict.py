"""Predict the grasp types of a picture, a folder of pictures, or a mesh.

Heavy libraries are imported once the arguments are known to be in order.
"""

from __future__ import annotations

import argparse
import importlib
import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from grasptypes.commands.settings import (
    MESH_WORD,
    add_folder,
    check_target,
    folder_params,
    printable,
)
from grasptypes.errors import InputError
from grasptypes.objects.units import UNITS_M
from grasptypes.renders.photos import PhotoLimits, check_photo, photo_files, read_photo

# More rows than these make a picture that no viewer shows.
MAX_ROWS = 40


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The options of `predict`."""
    shown = parser.add_mutually_exclusive_group(required=True)
    shown.add_argument("--image", type=Path, help="a picture, or a folder of them")
    shown.add_argument("--object", type=Path, help="a mesh (STL, OBJ, PLY, GLB), seen from around")
    parser.add_argument("--unit", choices=UNITS_M, help="of the mesh (default: m)")
    parser.add_argument("--task", help="what the object is grasped for, e.g. use")
    parser.add_argument("--model", help="a, b, c, d (row of Table I) or its name")
    parser.add_argument("--labels", help="labels it was trained on: simulated or published")
    parser.add_argument("--json", action="store_true", help="for programs")
    parser.add_argument("--picture", type=Path, help="PNG to draw pictures and bars to")
    add_folder(parser)


def run(asked: argparse.Namespace) -> str:
    """The text to show.

    Raises:
        InputError: anything wrong with what was asked; then nothing is written.
    """
    params = folder_params(asked.folder)
    settings = params["predict"]
    if asked.image and asked.unit:
        raise InputError("--unit", asked.unit, "is for a mesh (--object): a picture has no unit")
    files = photo_files(asked.image) if asked.image else []
    if asked.picture:
        check_target(asked.picture, ".png")
        _check_apart(asked.picture, asked.image, files)
        if len(files) > MAX_ROWS:
            raise InputError(asked.image, "", f"--picture shows {MAX_ROWS} pictures at most")
    limits = PhotoLimits(**settings["photos"])
    # Bad pictures are told before torch takes its seconds.
    if len(files) == 1:
        read_photo(files[0], limits)
    for file in files:
        check_photo(file, limits)

    from grasptypes.predictors.prediction import ask, check_task, describe, open_predictor, report

    labels, model = asked.labels or settings["labels"], asked.model or settings["model"]
    predictor = open_predictor(asked.folder, labels, model)
    task = check_task(predictor.card, asked.task)
    answers, shown = [], []
    if asked.object:
        views = _views(asked, params)
        name = f"{printable(asked.object.name)}, mean of {len(views)} views"
        answers.append(ask(predictor, views, task, name))
        shown.append(views)
    for file in files:
        photo = read_photo(file, limits)[None]
        answers.append(ask(predictor, photo, task, printable(file.name)))
        shown += [photo] if asked.picture else []
    if asked.picture:
        _draw(asked.picture, shown, answers, predictor.card, task)
    if asked.json:
        return json.dumps(describe(answers, predictor.card, task), indent=2) + "\n"
    return report(answers, predictor.card, task)


def _check_apart(target: Path, image: Path | None, files: Sequence[Path]) -> None:
    """Refuse a drawing that would replace a picture, or be one of the folder's the next time."""
    place = target.resolve()
    if place in [file.resolve() for file in files]:
        raise InputError(target, "", "is one of the pictures; name another file with --picture")
    if image and image.is_dir() and place.parent == image.resolve():
        raise InputError(target, "", "lies among the pictures; name another place with --picture")


def _views(asked: argparse.Namespace, params: Mapping[str, Any]) -> Any:
    """Pictures (N, S, S, 3) of the mesh, taken as those the predictors have learned from."""
    # Before OpenGL: see grasptypes.renders.renderer.
    importlib.import_module("torchvision")
    from grasptypes.renders.mesh_views import mesh_views

    block = {"file": str(asked.object), "unit": asked.unit or "m"}
    count = params["predict"]["views"]
    return mesh_views(block, params["objects"], params["renders"], count, MESH_WORD)


def _draw(target: Path, shown: list[Any], answers: list[Any], card: Any, task: str) -> None:
    from grasptypes.labels.label_pictures import save_figure
    from grasptypes.predictors.prediction import sees_task
    from grasptypes.predictors.prediction_pictures import draw_answers, montage

    asked = f"for {task}" if sees_task(card) else "whatever the task"
    title = f"{card.model}, {card.labels} labels, {asked}; {card.backbone}, {card.weights}"
    save_figure(draw_answers([montage(views) for views in shown], answers, card, title), target)
