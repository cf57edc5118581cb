"""Plan grasps of a mesh for a task: searched, tested in physics, labelled and ranked.

Heavy libraries are imported once the arguments are known to be in order.
"""

from __future__ import annotations

import argparse
import importlib
import os
import shutil
import sys
import tempfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any, NamedTuple

from grasptypes.commands.settings import (
    MESH_WORD,
    add_folder,
    check_place,
    folder_params,
    printable,
    staging_name,
)
from grasptypes.errors import InputError
from grasptypes.objects.units import UNITS_M

URDF = "assets/barrett_hand/barrett_hand.urdf"
# `GRASP_TYPES` without the last, as the help lists them at no cost; a test holds them in step.
TYPES = "Large Wrap, Medium Wrap, Small Wrap, Power Sphere, Precision Sphere, Precision"


class Wanted(NamedTuple):
    """The wanted grasp types, spelled as in tables, and who chose them."""

    types: list[str]
    chosen_by: Mapping[str, Any] | None
    """The predictor and its answer; None if they were given."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The options of `plan`."""
    parser.add_argument("--object", type=Path, required=True, help="a mesh (STL, OBJ, PLY, GLB)")
    parser.add_argument("--task", required=True, help="what it is grasped for, e.g. use")
    parser.add_argument(
        "--unit", choices=UNITS_M, default="m", help="of mesh and contact map (default: m)"
    )
    parser.add_argument("--mass-kg", type=_number, help="default: that of a solid of water")
    parser.add_argument("--contact-map", type=Path, help="PLY whose red channel says where to hold")
    parser.add_argument(
        "--type",
        action="append",
        default=[],
        help=f"wanted grasp type, may be given again (default: predicted ones); one of: {TYPES}",
    )
    parser.add_argument("--output", type=Path, help="new folder (default: <mesh>_<task>_grasps)")
    parser.add_argument(
        "--sessions",
        type=_count,
        help="ways of holding to be searched (default: 20, from plan.sessions of params.yaml)",
    )
    parser.add_argument("--jobs", type=_count, default=2, help="processes (default: 2)")
    parser.add_argument("--json", action="store_true", help="print plan.json, for programs")
    add_folder(parser)


def run(asked: argparse.Namespace) -> str:
    """The text to show; writes the output folder whole or not at all.

    Raises:
        InputError: anything wrong with what was asked; then nothing is written.
    """
    params = folder_params(asked.folder)
    if asked.task not in params["tasks"]:
        allowed = ", ".join(params["tasks"])
        raise InputError("--task", asked.task, f"unknown; allowed: {allowed}")
    if asked.mass_kg is not None:
        _check_mass(asked.mass_kg, params["plan"], "--mass-kg", f"{asked.mass_kg:g}", "")
    output = asked.output or Path(f"{asked.object.stem}_{asked.task}_grasps")
    _check_output(output)
    with tempfile.TemporaryDirectory() as work:
        prepared, written = Path(work, "prepared"), Path(work, "written")
        summary = _plan(asked, params, prepared, written)
        _move(written, output)
    if asked.json:
        return (output / "plan.json").read_text(encoding="utf-8")

    from grasptypes.planning.plan_summary import report

    return report(summary) + f"written to {printable(str(output))}\n"


def _plan(
    asked: argparse.Namespace, params: Mapping[str, Any], prepared: Path, written: Path
) -> dict[str, Any]:
    """Do it, in two folders of our own."""
    from grasptypes.labels.grasp_type import GRASP_TYPES
    from grasptypes.objects.contact_scan import read_contact_scan

    given = [_known_type(kind, GRASP_TYPES[:-1]) for kind in asked.type]
    scan = (asked.contact_map, UNITS_M[asked.unit]) if asked.contact_map else None
    if scan:
        read_contact_scan(*scan)  # a bad file is told before anything is computed
    predictor = None if given else _open_predictor(asked, params)

    from grasptypes.files import write_json
    from grasptypes.planning.plan_contacts import grips_of, plan_contacts
    from grasptypes.planning.plan_files import write_plan
    from grasptypes.planning.plan_summary import summarise
    from grasptypes.planning.planner import Workshop, plan

    name, drawn = (printable(asked.object.stem), asked.task), (MESH_WORD, asked.task)
    properties = _prepare(asked, params, prepared)
    if asked.mass_kg is None:
        weighs = f"is {properties.mass_kg:.3g} kg as a solid of water, "
        _check_mass(properties.mass_kg, params["plan"], asked.object, "--mass-kg", weighs)
    wanted = Wanted(given, None) if given else _predict(predictor, name, params, prepared)
    sessions = asked.sessions or params["plan"]["sessions"]
    contact_params = {**params["contact_maps"], "sessions": sessions}
    grips = grips_of(wanted.types)
    contacts = plan_contacts(
        prepared, scan, grips, drawn, params["seed"], contact_params, asked.object
    )
    if left_out := sessions - len(contacts.numbers):
        _tell(f"left out {left_out} of {sessions} ways of holding: no place has two sides for them")
    _tell(f"searching for {', '.join(wanted.types)} of {name[0]} for {name[1]}")
    workshop = Workshop(prepared, asked.folder / URDF, name, params["seed"], params, MESH_WORD)
    planned = plan(workshop, contacts, wanted.types, asked.jobs, _tell)
    written.mkdir()
    write_plan(planned, written, prepared, params["plan"]["shown"], params)
    source = asked.contact_map.name if scan else None
    summary = summarise(planned, wanted.types, wanted.chosen_by, source, properties)
    write_json(written / "plan.json", summary)
    return summary


def _prepare(asked: argparse.Namespace, params: Mapping[str, Any], folder: Path) -> Any:
    """Write the object's files; returns its properties."""
    from grasptypes.objects.mesh_import import import_model
    from grasptypes.objects.mesh_limits import ImportLimits
    from grasptypes.objects.preparation import Resolution, prepare

    block = {"file": str(asked.object), "unit": asked.unit}
    if asked.mass_kg is not None:
        block["mass_kg"] = asked.mass_kg
    found = import_model(block, ImportLimits(**params["objects"]["import"]))
    resolution = Resolution(**params["objects"]["resolution"])
    return prepare(
        printable(asked.object.stem), found.model, found.scale, resolution, folder, found.mass_kg,
        found.repairs,
    )  # fmt: skip


def _open_predictor(asked: argparse.Namespace, params: Mapping[str, Any]) -> Any:
    from grasptypes.predictors.prediction import check_task, open_predictor

    settings = params["predict"]
    predictor = open_predictor(asked.folder, settings["labels"], settings["model"])
    check_task(predictor.card, asked.task)
    # Before OpenGL: see grasptypes.renders.renderer.
    importlib.import_module("torchvision")
    return predictor


def _predict(
    predictor: Any, name: tuple[str, str], params: Mapping[str, Any], prepared: Path
) -> Wanted:
    """The types that the predictor chooses for the prepared object; the likeliest if none is."""
    from grasptypes.objects.object_files import VISUAL
    from grasptypes.predictors.prediction import ask, describe, wanted_types
    from grasptypes.renders.mesh_views import views

    count = params["predict"]["views"]
    pictures = views(prepared / VISUAL, params["renders"], count, MESH_WORD)
    answer = ask(predictor, pictures, name[1], f"{name[0]}, mean of {count} views")
    types = wanted_types(answer, predictor.card.types)
    return Wanted(types, describe([answer], predictor.card, name[1]))


def _known_type(text: str, allowed: tuple[str, ...]) -> str:
    """A grasp type as tables spell it, from any spelling with spaces or underscores."""
    kind = text.replace("_", " ").title()
    if kind not in allowed:
        raise InputError("--type", text, f"unknown; allowed: {', '.join(allowed)}")
    return kind


def _check_mass(
    mass_kg: float, settings: Mapping[str, Any], named: str | Path, key: str, weighs: str
) -> None:
    """Refuse what the hand cannot lift, and what nothing weighs that it can hold."""
    low, high = settings["min_mass_kg"], settings["max_mass_kg"]
    if not low <= mass_kg <= high:
        raise InputError(named, key, f"{weighs}allowed are {low:g} to {high:g} kg")


def _check_output(folder: Path) -> None:
    """Refuse the current folder, one with something in it, and a place where none can be made."""
    if folder.resolve() == Path.cwd():
        raise InputError(folder, "", "is the current folder; name another with --output")
    if folder.exists() and (not folder.is_dir() or any(folder.iterdir())):
        raise InputError(folder, "", "is there already and not empty; name another with --output")
    check_place(folder)


def _move(written: Path, output: Path) -> None:
    """Put the finished folder in its place in one step."""
    output = output.resolve()
    output.parent.mkdir(parents=True, exist_ok=True)
    staged = output.with_name(staging_name(output.name))
    try:
        shutil.copytree(written, staged)
        os.replace(staged, output)
    except shutil.Error as error:  # holds a triple for every file that could not be copied
        raise InputError(output, "", f"cannot be written: {error.args[0][0][-1]}") from error
    finally:
        shutil.rmtree(staged, ignore_errors=True)


def _tell(line: str) -> None:
    sys.stderr.write(f"{line}\n")
    sys.stderr.flush()


def _number(text: str) -> float:
    try:
        return float(text)
    except ValueError as error:
        raise argparse.ArgumentTypeError(f"{text} is not a number") from error


def _count(text: str) -> int:
    if not text.isdecimal() or int(text) < 1:
        raise argparse.ArgumentTypeError(f"{text} is not a whole number from 1 up")
    return int(text)
