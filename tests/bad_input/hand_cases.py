"""Mistakes in the description of a hand."""

from __future__ import annotations

import shutil
from pathlib import Path

from case import Case

from grasptypes.commands.command_line import main
from grasptypes.hands.folders import hand_folder

MODEL = hand_folder("barrett")
URDF, YAML, GRIPS = "hand.urdf", "hand.yaml", "grips.yaml"
DISTAL = "distal_3"


def check() -> None:
    main(["hand", "check", "mine"])


def changed(what: str, file: str, old: str, new: str, *names: str) -> Case:
    """A copy of a hand, with one passage of one file replaced (the last one that matches)."""

    def write(folder: Path) -> None:
        shutil.copytree(MODEL, folder)
        text = (folder / file).read_text()
        before, found, after = text.rpartition(old)
        assert found, f"{old!r} is not in {file}"
        (folder / file).write_text(before + new + after)

    return Case("hand", what, {"mine": write}, check, names)


def without(what: str, *files: str, names: tuple[str, ...]) -> Case:
    """A copy of a hand that lacks files."""

    def write(folder: Path) -> None:
        shutil.copytree(MODEL, folder)
        for file in files:
            (folder / file).unlink()

    return Case("hand", what, {"mine": write}, check, names)


def replaced(what: str, file: str, content: str, *names: str) -> Case:
    """A copy of a hand with another content of a file."""

    def write(folder: Path) -> None:
        shutil.copytree(MODEL, folder)
        (folder / file).write_text(content)

    return Case("hand", what, {"mine": write}, check, names)


FINGER = "joints: [proximal_3, distal_3]"
RATES = "rates: [[1.0, 0.3333333333333333], [0.0, 1.0]]"

CASES = [
    Case("hand", "an unknown name", {}, check, ("mine", "barrett")),
    without("no URDF", URDF, names=(URDF, "no such file")),
    without("no grips", GRIPS, names=(GRIPS, "no such file")),
    without(
        "a mesh that is missing", "collision/distal_fingertip.obj", names=(URDF, "no such file")
    ),
    replaced("a URDF that is not XML", URDF, "<robot", URDF, "cannot be read"),
    replaced("a mesh that is none", "collision/proximal_beam.obj", "beam", "proximal_beam.obj"),
    changed("an unknown key", YAML, "thumb: true", "thumbs: true", YAML, "finger_3", "thumbs"),
    changed("no palm", YAML, "palm: {link: palm, xyz_m", "hand: {link: palm, xyz_m", YAML, "hand"),
    changed("an unknown palm link", YAML, "{link: palm,", "{link: wrist,", "is not a link"),
    changed("an unknown joint", YAML, FINGER, "joints: [proximal_3, tip_3]", "not a joint"),
    changed("an unknown preshape joint", YAML, "spread_2: 1.0", "spread_3: 1.0", "not a joint"),
    changed("a joint of two fingers", YAML, FINGER, "joints: [proximal_2, distal_3]", "already"),
    changed("a joint listed twice", YAML, FINGER, "joints: [distal_3, distal_3]", "listed twice"),
    changed("a joint that is forgotten", YAML, ", spread_2: 1.0", "", "not mention spread_2"),
    changed("a tip before its base", YAML, FINGER, "joints: [distal_3, proximal_3]", "distal_3"),
    changed("too few rates", YAML, RATES, "rates: [[1.0, 0.3333333333333333]]", "finger_3.rates"),
    changed(
        "a stopped joint that moves", YAML, RATES, "rates: [[1.0, 0.3], [1.0, 1.0]]", "stopped"
    ),
    changed("a joint that never closes", YAML, RATES, "rates: [[0.0, 0.3], [0.0, 1.0]]", "closes"),
    changed("too many open positions", YAML, "open: [0.0, 0.0]", "open: [0.0]", "finger_3.open"),
    changed("no thumb", YAML, "    thumb: true\n", "", YAML, "thumb"),
    changed("an unknown drive", YAML, "drive: coupled", "drive: belt", YAML, "drive", "belt"),
    changed(
        "no force", YAML, "fingertip_force_n: 5.0", "fingertip_force_n: 0.0", "fingertip_force"
    ),
    changed("an unknown pair", YAML, "[palm, proximal_2]", "[palm, thumb]", "not a moving link"),
    changed("a preshape too long", GRIPS, "[[0.0], [0.1]]", "[[0.0, 0.1]]", "per preshape"),
    changed("a grip that is forgotten", GRIPS, "rim:\n", "edge:\n", GRIPS, "edge"),
    changed("a joint without limits", URDF, ' effort="0.825"', "", URDF, DISTAL, "effort"),
    changed(
        "limits the wrong way round", URDF, 'lower="0.0"', 'lower="3.0"', URDF, DISTAL, "lower"
    ),
    changed("a joint without end", URDF, 'type="revolute"', 'type="continuous"', URDF, "is con"),
    changed("an axis without length", URDF, 'axis xyz="0 0 1"', 'axis xyz="0 0 0"', "no length"),
    changed("a link without mass", URDF, '<mass value="0.041000" />', "", URDF, DISTAL, "mass"),
    changed("a negative mass", URDF, 'mass value="0.041000"', 'mass value="-0.041"', URDF, DISTAL),
    changed("an impossible inertia", URDF, '<inertia ixx="', '<inertia ixx="9', DISTAL),
    changed("an axis that opens", URDF, 'axis xyz="0 0 1"', 'axis xyz="0 0 -1"', DISTAL, "opens"),
    changed("a coupling beyond the limits", YAML, RATES, "rates: [[1.0, 0.5], [0.0, 1.0]]", DISTAL),
    changed("wrong angles", YAML, "bend_rad: [0.08726646259971647", "bend_rad: [1.5", "proximal_3"),
    changed("a preshape beyond the limits", GRIPS, "[1.57]", "[4.0]", "spread", "3.142"),
    changed(
        "an open position beyond the limits", YAML, "open: [0.0, 0.0]", "open: [0.0, -1.0]", DISTAL
    ),
    changed(
        "the thumb on the wrong side",
        YAML,
        "rpy_rad: [0.0, 0.0, 0.0]",
        "rpy_rad: [0.0, 0.0, 3.14159]",
        "thumbs",
    ),
]
