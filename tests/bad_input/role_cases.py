"""Mistakes in tables of roles, and in what is asked of `grasptypes inspect`."""

from __future__ import annotations

from case import Case, Content
from mesh_cases import STL
from picture_cases import command


def inspected(what: str, roles: Content, *names: str) -> Case:
    """A call of `grasptypes inspect` with a good mesh."""
    words = ("inspect", "cup.stl", "--roles", "roles.csv")
    return Case("roles", what, {"cup.stl": STL, "roles.csv": roles}, command(*words), names)


def asked(what: str, words: tuple[str, ...], *names: str) -> Case:
    """A call of `grasptypes inspect` without roles."""
    return Case("inspect", what, {"cup.stl": STL}, command("inspect", *words), names)


CASES = [
    inspected("an empty file", "", "roles.csv: part: this column is missing"),
    inspected("not text", b"\xff\xfe\x00", "roles.csv: cannot be read as CSV"),
    inspected("no column of roles", "part\nbody\n", "roles.csv: role: this column is missing"),
    inspected(
        "an unknown column", "part,role,colour\n", "roles.csv: colour: unknown column", "part"
    ),
    inspected("no rows", "part,role\n", "roles.csv: names no part"),
    inspected("a row without a part", "part,role\n,handle\n", "roles.csv: line 2: names no part"),
    inspected("an unknown role", "part,role\nbody,hilt\n", "roles.csv: line 2", "'hilt'", "handle"),
    inspected(
        "an unknown attribute",
        "part,role,attributes\nbody,handle,pointy\n",
        "roles.csv: line 2",
        "'pointy'",
        "sharp",
    ),
    inspected(
        "a part twice", "part,role\nbody,lid\nbody,rim\n", "line 3: 'body' has a role already"
    ),
    inspected(
        "a part that is not there", "part,role\nlid,lid\n", "roles.csv: lid", "its parts: body"
    ),
    inspected("a colour that is none", "part,role\n#red,lid\n", "line 2: '#red' is not a colour"),
    inspected("names and colours", "part,role\nbody,lid\n#ff0000,rim\n", "mixes names and colours"),
    inspected(
        "a colour that the mesh lacks", "part,role\n#ff0000,rim\n", "roles.csv: #ff0000: nothing on"
    ),
    asked("a missing table of roles", ("cup.stl", "--roles", "no.csv"), "no.csv: no such file"),
    asked("a missing mesh", ("mug.stl",), "mug.stl"),
    asked("an unknown task", ("cup.stl", "--task", "juggle"), "juggle"),
    asked("a picture that is not PNG", ("cup.stl", "--output", "cup.jpg"), "must end in .png"),
    asked("a page that is not HTML", ("cup.stl", "--page", "cup.txt"), "must end in .html"),
    asked("a mass that is no number", ("cup.stl", "--mass-kg", "heavy"), "--mass-kg", "heavy"),
    asked("a negative mass", ("cup.stl", "--mass-kg", "-1"), "mass_kg"),
]
