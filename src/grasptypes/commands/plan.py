"""Plan grasps of a mesh for a task: searched, tested in physics, labelled and ranked.

Heavy libraries are imported once the arguments are known to be in order.
"""

from __future__ import annotations

import argparse
import os
import shutil
import sys
import tempfile
from pathlib import Path

from grasptypes.commands.settings import (
    add_folder,
    check_place,
    folder_params,
    printable,
    staging_name,
)
from grasptypes.errors import InputError
from grasptypes.objects.units import UNITS_M

# `GRASP_TYPES` without the last, as the help lists them at no cost; a test holds them in step.
TYPES = "Large Wrap, Medium Wrap, Small Wrap, Power Sphere, Precision Sphere, Precision"


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


def run(args: argparse.Namespace) -> str:
    """The text to show; writes the output folder whole or not at all.

    Raises:
        InputError: anything wrong with the arguments; then nothing is written.
    """
    folder_params(args.folder)
    output = args.output or Path(f"{args.object.stem}_{args.task}_grasps")
    _check_output(output)

    from grasptypes.objects.contact_scan import read_contact_scan
    from grasptypes.objects.loading import load_object
    from grasptypes.planning.plan_contacts import MeasuredMap
    from grasptypes.planning.plan_files import write_plan
    from grasptypes.planning.plan_summary import report, summarise
    from grasptypes.planning.planner import Planner, known_type

    planner = Planner(args.folder, jobs=args.jobs, tell=_tell)
    planner.check_task(args.task)
    types = [known_type(text) for text in args.type]
    if args.mass_kg is not None:
        planner.check_mass(args.mass_kg, "--mass-kg")
    measured = None
    if args.contact_map:  # a bad file is told before anything is computed
        measured = MeasuredMap(args.contact_map, UNITS_M[args.unit])
        read_contact_scan(*measured)
    if not types:
        planner.load_predictor()
    geometry = load_object(
        args.object,
        args.unit,
        mass_kg=args.mass_kg,
        name=printable(args.object.stem),
        settings=planner.params.objects,
    )
    plan = planner.plan(geometry, args.task, types, contact_map=measured, sessions=args.sessions)
    with tempfile.TemporaryDirectory() as work:
        written = Path(work, "written")
        written.mkdir()
        write_plan(plan, written, planner.params)
        _move(written, output)
    if args.json:
        return (output / "plan.json").read_text(encoding="utf-8")
    return report(summarise(plan)) + f"written to {printable(str(output))}\n"


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
