"""`python -m grasptypes.hand FOLDER` writes the hand's URDF and meshes."""

import argparse
import sys
from collections.abc import Sequence

from grasptypes.hand.urdf import write_hand


def main(arguments: Sequence[str] | None = None) -> None:
    """Write the hand below the folder named on the command line and list its files."""
    parser = argparse.ArgumentParser(prog="python -m grasptypes.hand", description=__doc__)
    parser.add_argument("folder", help="where to write, for example assets/barrett_hand")
    for path in write_hand(parser.parse_args(arguments).folder):
        sys.stdout.write(f"{path}\n")


if __name__ == "__main__":
    main()
