"""The command `plan`.

Heavy libraries are imported after the arguments have been checked.
"""

from __future__ import annotations

import argparse
from pathlib import Path

from grasptypes.commands.messages import say
from grasptypes.commands.settings import add_folder, check_place, printable, read_task
from grasptypes.errors import InputError
from grasptypes.objects.units import UNITS_M

SUMMARY = "Plan grasps of a mesh for a task: searched, tested in physics, labelled and ranked."
# `GRASP_TYPES` without the last, for a fast help text; a test keeps both consistent.
TYPES = "Large Wrap, Medium Wrap, Small Wrap, Power Sphere, Precision Sphere, Precision"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The options of `plan`."""
    parser.add_argument("--object", type=Path, required=True, help="a mesh (STL, OBJ, PLY, GLB)")
    parser.add_argument("--task", required=True, help="task, by name or in words, e.g. use")
    parser.add_argument(
        "--unit", choices=UNITS_M, default="m", help="unit of mesh and contact map (default: m)"
    )
    parser.add_argument(
        "--mass-kg", type=_number, help="mass of the object (default: that of a solid of water)"
    )
    parser.add_argument(
        "--hand", help="name of a hand, or folder with one (default: hand in params.yaml)"
    )
    parser.add_argument("--contact-map", type=Path, help="PLY whose red channel says where to hold")
    parser.add_argument(
        "--roles", type=Path, help="CSV with the role of each part (default: found in the shape)"
    )
    parser.add_argument(
        "--type",
        action="append",
        default=[],
        help=f"requested grasp type; may be repeated (default: predicted types); one of: {TYPES}",
    )
    parser.add_argument("--output", type=Path, help="new folder (default: <mesh>_<task>_grasps)")
    parser.add_argument(
        "--sessions",
        type=_count,
        help="number of ways of holding to search (default: 20, plan.sessions in params.yaml)",
    )
    parser.add_argument("--jobs", type=_count, default=2, help="number of processes (default: 2)")
    parser.add_argument("--json", action="store_true", help="print plan.json instead of a table")
    add_folder(parser)


def run(args: argparse.Namespace) -> str:
    """Write the output folder, completely or not at all; returns the text to print.

    Raises:
        InputError: an argument is wrong; nothing is written.
    """
    from grasptypes.settings.params import checkout_params

    task = read_task(args.task, checkout_params(args.folder).tasks)
    output = args.output or Path(f"{args.object.stem}_{task}_grasps")
    _check_output(output)

    from grasptypes.files import json_text
    from grasptypes.objects.loading import load_object
    from grasptypes.planning.plan_contacts import MeasuredMap
    from grasptypes.planning.plan_summary import report, summarise
    from grasptypes.planning.planner import Planner, check_guidance
    from grasptypes.segmentation.role_files import read_role_table

    planner = Planner(args.folder, hand=args.hand, jobs=args.jobs, tell=say)
    # Check everything before anything is computed.
    planner.check_request(task, args.type, args.mass_kg)
    scan = MeasuredMap(args.contact_map, UNITS_M[args.unit]) if args.contact_map else None
    if scan:
        scan.read()
    roles = read_role_table(args.roles) if args.roles else None
    check_guidance(scan, roles)
    geometry = load_object(
        args.object,
        args.unit,
        mass_kg=args.mass_kg,
        name=printable(args.object.stem),
        settings=planner.params.objects,
    )
    plan = planner.plan(
        geometry,
        task,
        args.type,
        contact_map=scan,
        roles=roles,
        sessions=args.sessions,
        mass_known=args.mass_kg is not None,
    )
    plan.write(output)
    summary = summarise(plan)
    if args.json:
        return json_text(summary)
    return report(summary) + f"written to {printable(str(output))}\n"


def _check_output(folder: Path) -> None:
    """Reject the current folder, one that is not empty, and a place where none can be created."""
    if folder.resolve() == Path.cwd():
        raise InputError(folder, "", "is the current folder; name another folder with --output")
    if folder.exists() and (not folder.is_dir() or any(folder.iterdir())):
        raise InputError(
            folder, "", "already exists and is not empty; name another folder with --output"
        )
    check_place(folder)


def _number(text: str) -> float:
    try:
        return float(text)
    except ValueError as error:
        raise argparse.ArgumentTypeError(f"{text} is not a number") from error


def _count(text: str) -> int:
    if not text.isdecimal() or int(text) < 1:
        raise argparse.ArgumentTypeError(f"{text} is not a positive integer")
    return int(text)
