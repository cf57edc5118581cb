"""The command `inspect`.

Heavy libraries are imported after the arguments have been checked.
"""

from __future__ import annotations

import argparse
from pathlib import Path

from grasptypes.commands.settings import add_folder, check_target, printable, read_task
from grasptypes.objects.units import UNITS_M

SUMMARY = "Show what is known about a mesh: size, parts with roles, and where people hold it."


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The options of `inspect`."""
    parser.add_argument("object", type=Path, help="a mesh (STL, OBJ, PLY, GLB)")
    parser.add_argument(
        "--task", action="append", default=[], help="task; may be repeated (default: all tasks)"
    )
    parser.add_argument(
        "--unit", choices=UNITS_M, default="m", help="unit of the mesh (default: m)"
    )
    parser.add_argument(
        "--mass-kg", type=float, help="mass of the object (default: that of a solid of water)"
    )
    parser.add_argument(
        "--roles", type=Path, help="CSV with the role of each part (default: found in the shape)"
    )
    parser.add_argument(
        "--output", type=Path, help="PNG of the parts and of where people hold them"
    )
    parser.add_argument(
        "--page", type=Path, help="HTML file with the same to turn around, for a browser"
    )
    parser.add_argument("--json", action="store_true", help="print JSON instead of text")
    add_folder(parser)


def run(args: argparse.Namespace) -> str:
    """Inspect a mesh; returns the text to print.

    Raises:
        InputError: an argument is wrong, or the mesh cannot be used; nothing is written.
    """
    from grasptypes.files import json_text
    from grasptypes.settings.params import checkout_params

    params = checkout_params(args.folder)
    tasks = list(dict.fromkeys(read_task(text, params.tasks) for text in args.task)) or list(
        params.tasks
    )
    for path, suffix in ((args.output, ".png"), (args.page, ".html")):
        if path:
            check_target(path, suffix)

    from grasptypes.inspection.inspection import inspect_object, report
    from grasptypes.objects.loading import load_object
    from grasptypes.segmentation.role_files import read_role_table

    roles = read_role_table(args.roles) if args.roles else None
    name = printable(args.object.stem)
    geometry = load_object(
        args.object, args.unit, mass_kg=args.mass_kg, name=name, settings=params.objects
    )
    found = inspect_object(
        geometry, tasks, params, roles=roles, mass_given=args.mass_kg is not None
    )
    written = ""
    if args.output:
        from grasptypes.files import write_bytes
        from grasptypes.inspection.pictures import inspection_png

        write_bytes(args.output, inspection_png(found, params))
        written += f"written: {printable(str(args.output))}\n"
    if args.page:
        from grasptypes.files import write_text
        from grasptypes.inspection.pages import inspection_page

        write_text(args.page, inspection_page(found))
        written += f"written: {printable(str(args.page))}\n"
    return json_text(found.summary()) if args.json else report(found) + written
