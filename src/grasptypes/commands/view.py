"""The command `view`.

The page is served on 127.0.0.1 until Ctrl-C, or written to a file that opens without a network.
"""

from __future__ import annotations

import argparse
from pathlib import Path

from grasptypes.commands.settings import (
    add_folder,
    add_page,
    check_target,
    printable,
    serve,
)

SUMMARY = "Show grasps in the browser: of an object, a table or a plan."


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The options of `view`."""
    parser.add_argument(
        "what",
        help="an object of the dataset, such as mug; a CSV of grasps beside its objects, such as "
        "data/grasps.csv; or the folder of a plan or a release",
    )
    parser.add_argument(
        "--hand",
        help="name of a hand, or folder with one (default: that of the plan or release, or in "
        "params.yaml)",
    )
    parser.add_argument("--output", type=Path, help="HTML file to write instead of serving it")
    add_page(parser)
    add_folder(parser)


def run(args: argparse.Namespace) -> str:
    """Write the page, or serve it until Ctrl-C; returns the text to print.

    Raises:
        InputError: what is asked for cannot be shown; nothing is written.
    """
    if args.output:
        check_target(args.output, ".html")

    from grasptypes.files import write_text
    from grasptypes.viewer.grasp_views import load_views
    from grasptypes.viewer.page import page
    from grasptypes.viewer.serving import page_server

    views = load_views(args.what, args.folder, args.hand)
    text = page(views)
    if args.output:
        write_text(args.output, text)
        size_mb = len(text.encode()) / 1e6
        return f"{len(views.grasps)} grasps, {size_mb:.1f} MB: {printable(str(args.output))}\n"
    with page_server(text, args.port) as server:
        serve(server, f"{len(views.grasps)} grasps at ", args)
    return ""
