"""The command `demo`: a page on 127.0.0.1 until Ctrl-C."""

from __future__ import annotations

import argparse

from grasptypes.commands.settings import add_folder, add_page, serve

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
        serve(server, "", args)
    return ""
