"""The command `hand`.

Prints a line for everything that looks wrong; the exit status is 1 if anything does.
"""

from __future__ import annotations

import argparse
from pathlib import Path

from grasptypes.commands.settings import add_folder, check_target
from grasptypes.errors import InputError, InputErrors

SUMMARY = "Check the description of a hand, and draw it."


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The options of `hand`."""
    actions = parser.add_subparsers(dest="action", required=True, metavar="ACTION")
    check = actions.add_parser("check", help="check and draw a hand")
    check.add_argument("hand", help="name of a hand, or folder with one")
    check.add_argument("--picture", type=Path, help="PNG of the open, half closed and closed hand")
    add_folder(check)


def run(args: argparse.Namespace) -> str:
    """Check the hand; returns the text to print.

    Raises:
        InputError: the hand cannot be read.
        InputErrors: something looks wrong.
    """
    if args.picture:
        check_target(args.picture, ".png")

    from grasptypes.hands.checking import check_hand
    from grasptypes.hands.folders import DESCRIPTION, hand_folder
    from grasptypes.hands.reading import load_hand
    from grasptypes.planning.plan_contacts import missing_types
    from grasptypes.settings.params import checkout_params

    hand = load_hand(args.hand)
    found = check_hand(hand)
    if args.picture:
        from grasptypes.files import write_bytes
        from grasptypes.reports.hand_pictures import draw_hand

        write_bytes(args.picture, draw_hand(hand, checkout_params(args.folder)))
    if found:
        path = hand_folder(args.hand) / DESCRIPTION
        raise InputErrors(InputError(path, "", line) for line in found)
    mass_kg = sum(link.mass_kg for link in hand.links)
    missing = ", ".join(missing_types(hand)) or "none"
    return (
        f"{hand.title}: {len(hand.fingers)} fingers, {len(hand.joints)} joints, {mass_kg:.3f} kg, "
        f"fingers of {1e3 * hand.finger_length_m:.0f} mm\n"
        f"degrees of freedom: {', '.join(hand.dof_names)}\n"
        f"grasp types that it cannot form: {missing}\nno mistake found\n"
    )
