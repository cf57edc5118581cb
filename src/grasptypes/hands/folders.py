"""Folders of hands: those of the package by name, and those of users."""

from __future__ import annotations

from pathlib import Path

from grasptypes.errors import InputError

HANDS = Path(__file__).parent / "data"
URDF, DESCRIPTION, GRIPS = "hand.urdf", "hand.yaml", "grips.yaml"


def hand_names() -> list[str]:
    """Names of the hands that come with the package."""
    return sorted(path.parent.name for path in HANDS.glob(f"*/{DESCRIPTION}"))


def hand_folder(name: str | Path, base: str | Path = ".") -> Path:
    """Folder of a hand: one that comes with the package, or a folder of the user's.

    Args:
        base: what a relative folder is relative to.

    Raises:
        InputError: there is no such hand.
    """
    own = HANDS / str(name)
    folder = own if str(name) in hand_names() else Path(base) / name
    if not (folder / DESCRIPTION).is_file():
        known = ", ".join(hand_names())
        message = f"no such hand: use {known}, or a folder with {URDF}, {DESCRIPTION} and {GRIPS}"
        raise InputError(str(name), "", message)
    return folder


def hand_files(name: str | Path) -> list[Path]:
    """All files that a hand is read from, sorted; raises InputError if there is no such hand."""
    endings = (".urdf", ".yaml", ".obj", ".stl", ".ply", ".glb", ".dae")
    return sorted(path for path in hand_folder(name).rglob("*") if path.suffix in endings)
