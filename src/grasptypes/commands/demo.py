"""The command `demo`: a page on 127.0.0.1 until Ctrl-C."""

from __future__ import annotations

import argparse
import sys
import webbrowser

from grasptypes.commands.settings import add_folder, add_page

SUMMARY = "Predict grasp types on a page in the browser: drop an image, choose a task."


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The options of `demo`."""
    add_page(parser)
    add_folder(parser)


def run(args: argparse.Namespace) -> str:
    """Serve the page until Ctrl-C; returns nothing to print.

    Raises:
        InputError: the parameters are wrong.
        OSError: the port is in use.
    """
    from grasptypes.demo.serving import demo_server
    from grasptypes.predictors.prediction import Predictor

    predictor = Predictor.load(args.folder, model="general")
    with demo_server(predictor, args.port) as server:
        address = f"http://127.0.0.1:{server.server_address[1]}/"
        sys.stdout.write(f"{address} until Ctrl-C\n")
        sys.stdout.flush()
        if not args.no_browser:
            webbrowser.open(address)
        server.serve_forever()
    return ""
