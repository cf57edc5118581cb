"""Mistakes in the description of a kind."""

from __future__ import annotations

import shutil
from pathlib import Path

from case import Case, library

from grasptypes.kinds.modelling import build_shape
from grasptypes.kinds.names import DATA, MATERIALS

FILE = "kinds/mine.yaml"
DISC = """disc:
  imagenet: []
  family: disc
  mass_kg: [0.1, 0.2, "a scale"]
  sizes:
    radius: [0.03, 0.04, "a ruler"]
  derived: {height: 0.5 * radius}
  colours: {paint: [red, blue]}
  shapes:
    core: [{cylinder: {radius: radius, between: [0, height]}}]
  parts:
    body:
      role: panel
      attributes: [fragile]
      material: plastic
      colour: paint
      solids:
        - {shape: core}
        - turned: {profile: [[0, 0], [radius, 0], [0, height]]}
        - lofted: {columns: [x, half_y, half_z], rows: [[0, 0.01, 0.01], [0.02, 0.01, 0.01]]}
"""


def kind(what: str, old: str, new: str, *names: str, file: str = FILE) -> Case:
    """The disc with one passage replaced."""
    assert DISC.count(old) == 1, f"{old!r} is not once in the disc"
    return whole(what, {file: DISC.replace(old, new)}, file, *names)


def whole(what: str, files: dict[str, str], *names: str) -> Case:
    """Files of kinds."""
    content = {f"kinds/{MATERIALS}": materials, **files}
    call = library(build_shape, "disc_s01", Path("kinds"))
    return Case("kind", what, content, call, names)


def materials(path: Path) -> None:
    """The materials of the package."""
    shutil.copy(DATA / MATERIALS, path)


BODY = "disc.parts.body"
CASES = [
    whole("no kind of the name", {FILE: DISC.replace("disc:", "plate:", 1)}, "disc", "plate"),
    whole("in two files", {FILE: DISC, "kinds/other.yaml": DISC}, "kinds/other.yaml", "mine.yaml"),
    whole("not a mapping", {FILE: "disc: round\n"}, FILE, "disc", "mapping"),
    whole("broken YAML", {FILE: DISC + "  parts: [\n"}, FILE, "line"),
    kind("an unknown key", "family", "familly", "disc", "'familly'", "family"),
    kind("no mass", '  mass_kg: [0.1, 0.2, "a scale"]\n', "", "disc", "'mass_kg' is missing"),
    kind("no weight", "[0.1, 0.2,", "[0, 0.2,", "disc.mass_kg", "above 0"),
    kind("a range without a source", ', "a ruler"', "", "sizes.radius", "source"),
    kind("a range from high to low", "0.03, 0.04", "0.04, 0.03", "sizes.radius", "smaller one"),
    kind("a broken expression", "0.5 * radius", "0.5 * * radius", "derived.height", "expression"),
    kind(
        "an expression that runs code", "0.5 * radius", "__import__('os').getpid()",
        "derived.height", "allowed",
    ),
    kind("a division by zero", "0.5 * radius", "1 / (radius - radius)", "derived.height", "zero"),
    kind("an unknown dimension", "0.5 * radius", "0.5 * width", "derived.height", "radius"),
    kind("an unknown role", "panel", "plate", f"{BODY}.role", "panel"),
    kind("an unknown attribute", "[fragile]", "[heavy]", f"{BODY}.attributes", "fragile"),
    kind("an unknown material", "plastic", "plastik", f"{BODY}.material", "plastic"),
    kind("an unknown colour", "red, blue", "red, bleu", "disc.colours.paint", "blue"),
    kind("an unknown shape", "{shape: core}", "{shape: cone}", f"{BODY}.solids.0.shape", "core"),
    kind("two shapes in a solid", "{shape: core}", "{shape: core, box: {size: [1, 1, 1]}}",
         f"{BODY}.solids.0", "box and shape"),
    kind("a solid without a shape", "{shape: core}", "{at: [0, 0, 1]}", f"{BODY}.solids.0", "box"),
    kind("a solid that is cut away", "{shape: core}", "{shape: core, cut: [{shape: core}]}",
         f"{BODY}.solids.0", "empty"),
    kind("a profile beyond the axis", "[radius, 0], [0, height]", "[-1 * radius, 0], [0, height]",
         f"{BODY}.solids.1.turned", "below 0"),
    kind("a point with one number", "[[0, 0], [radius, 0]", "[[0], [radius, 0]",
         f"{BODY}.solids.1.turned.profile.0", "not a point"),
    kind("a row that is too short", "[0.02, 0.01, 0.01]", "[0.02, 0.01]",
         f"{BODY}.solids.2.lofted.rows.1", "3 columns"),
    kind("rows in the wrong order", "[0.02, 0.01, 0.01]", "[0, 0.01, 0.01]",
         f"{BODY}.solids.2.lofted", "increase"),
    kind("an unknown column", "half_y", "wide_y", f"{BODY}.solids.2.lofted.columns", "half_y"),
    kind("ends in the wrong order", "between: [0, height]", "between: [height, 0]",
         "disc.shapes.core.0.cylinder", "between"),
]  # fmt: skip
