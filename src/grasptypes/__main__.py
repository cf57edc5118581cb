"""``grasptypes`` and ``python -m grasptypes``: see :mod:`grasptypes.commands.command_line`."""

from __future__ import annotations

from collections.abc import Sequence

from grasptypes.runtime import pin_runtime


def main(arguments: Sequence[str] | None = None) -> None:
    """Run one command in the environment that jobs have."""
    pin_runtime()
    # NumPy reads the environment when it is imported.
    from grasptypes.commands import command_line

    command_line.main(arguments)


if __name__ == "__main__":
    main()
