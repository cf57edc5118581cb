"""``grasptypes`` and ``python -m grasptypes``: see :mod:`grasptypes.commands.command_line`."""

from __future__ import annotations

import os
import sys
from collections.abc import Sequence

from grasptypes.runtime import pin_runtime


def main(arguments: Sequence[str] | None = None) -> None:
    """Run one command in the environment that jobs have."""
    pin_runtime()
    if arguments is None and sys.flags.optimize:
        # pyrender starts OpenGL in assertions, which Python drops with -O.
        os.execv(sys.executable, [sys.executable, "-m", "grasptypes", *sys.argv[1:]])
    # NumPy reads the environment when it is imported.
    from grasptypes.commands import command_line

    command_line.main(arguments)


if __name__ == "__main__":
    main()
