"""Mistakes in params.yaml and in the variables a run reads."""

from __future__ import annotations

from typing import Any

import yaml
from case import PARAMS, ROOT, Case, start

from grasptypes.yaml_files import merge

BOX = {"file": "box.stl", "unit": "mm", "mass_kg": 0.1}


def text(what: str, content: str | bytes, *names: str) -> Case:
    """A file that is no mapping of parameters."""
    return Case("params.yaml", what, {"params.yaml": content}, start, ("params.yaml", *names))


def change(what: str, changes: dict[str, Any], *names: str, **files: bytes) -> Case:
    """The project's parameters with one thing changed."""
    content = yaml.safe_dump(merge(PARAMS, changes), sort_keys=False)
    written = {"params.yaml": content} | {f"{k}.stl": v for k, v in files.items()}
    return Case("params.yaml", what, written, start, ("params.yaml", *names))


def environment(what: str, name: str, value: str, *names: str) -> Case:
    """A variable that leads nowhere."""
    files = {"params.yaml": (ROOT / "params.yaml").read_bytes()}
    return Case("environment", what, files, start, (name, *names), {name: value})


def photographs(what: str, row: str, *names: str) -> Case:
    """A table of photographs with a wrong row."""
    files = {
        "params.yaml": (ROOT / "params.yaml").read_bytes(),
        "photographs/photographs.csv": f"file,object,left,top,right,bottom\n{row}\n",
    }
    named = {"GRASPTYPES_PHOTOGRAPHS": "photographs"}
    return Case("environment", what, files, start, ("photographs.csv", *names), named)


CASES = [
    text("empty", "", "must contain a mapping"),
    text("a list", "- seed\n", "must contain a mapping"),
    text("not YAML", "seed: [1\n", "line 2", "not valid YAML"),
    text("a tab for indentation", "tasks:\n\tuse: 1\n", "line 2"),
    text("two documents", "seed: 1\n---\nseed: 2\n", "line 2"),
    text("not text", b"\xff\xfe\x00\x01", "UTF-8"),
    text("nested too deeply", "[" * 5000, "nested more than 100"),
    text("a duplicate key", "seed: 1\nseed: 2\n", "line 2", "duplicate key 'seed'"),
    text("a merge of mappings", "a: &a {b: 1}\nc: {<<: *a}\n", "line 2", "'<<' is not supported"),
    text("a key that is not text", "1: 2\n", "line 1", "a key must be text"),
    text("a key that is a list", "? [a, b]\n: 1\n", "line 1", "a key must be text"),
    text(
        "a tag that runs a command", "seed: !!python/object/apply:os.system [touch ran]\n", "line 1"
    ),
    text("a tag that makes an object", "seed: !!python/object:os.PathLike {}\n", "line 1"),
    text("a tag that does not fit its value", "seed: !!int many\n", "line 1", "'many'"),
    text("a date that does not exist", "seed: 2020-99-99\n", "line 1", "2020-99-99"),
    text("Python for Snakemake to run", "__use_yte__: true\n?open('ran', 'w'): 1\n", "__use_yte__"),
    change("an unknown section", {"sed": 1}, "'sed' is not a known key", "allowed: "),
    change("an unknown key", {"tasks": {"use": {"color_shift": 1}}}, "tasks.use", "colour_shift"),
    text("a missing section", "seed: 1\n", "'tasks' is missing"),
    change("a wrong type", {"seed": "one"}, "seed", "not an integer"),
    change("a seed with a decimal point", {"seed": 0.0}, "seed", "not an integer"),
    change("a count with a decimal point", {"renders": {"views": 100.0}}, "renders.views", "100.0"),
    change("a boolean for a number", {"seed": True}, "seed", "not an integer"),
    change("below the range", {"objects": {"scale": 0}}, "objects.scale", "0"),
    change("a list for a mapping", {"tasks": ["use"]}, "tasks", "is not a mapping"),
    change("a task named none", {"tasks": {"none": {"colour_shift": 1}}}, "tasks.none", "no task"),
    change("a shift used twice", {"tasks": {"wash": {"colour_shift": 10}}}, "is also that of use"),
    change("an unknown task", {"tasks": {"give": {"colour_shift": 1}}}, "tasks.give", "tasks.yaml"),
    change("a range upside down", {"objects": {"variation": {"size": [2, 1]}}}, "2 is above 1"),
    change("an empty list", {"labels": []}, "labels", "too few values: at least 1 needed"),
    change("too few values", {"predictors": {"hidden": [1, 2]}}, "predictors.hidden", "2 values"),
    change("above the range", {"folds": {"count": 1000}}, "folds.count", "maximum of 100"),
    change("NaN", {"objects": {"scale": float("nan")}}, "objects.scale", "not a finite number"),
    change("infinity", {"physics": {"test": {"friction": float("inf")}}}, "physics.test.friction"),
    change("an unknown object", {"objects": {"names": ["mug", "jug"]}}, "objects.names.1", "'jug'"),
    change("an object named twice", {"objects": {"names": ["mug", "mug"]}}, "objects.names"),
    change("no object at all", {"objects": {"names": []}}, "objects.names", "name an object"),
    change(
        "a name with shell characters", {"tasks": {"a; ls": {"colour_shift": 1}}}, "tasks", "a; ls"
    ),
    change("a task named nan", {"tasks": {"nan": {"colour_shift": 1}}}, "tasks", "'nan'"),
    change("an object named null", {"objects": {"own": {"null": BOX}}}, "own", "'null'"),
    change("an unknown unit", {"objects": {"own": {"box": BOX | {"unit": "ell"}}}}, "own.box.unit"),
    change(
        "mass and density",
        {"objects": {"own": {"box": BOX | {"density_kg_m3": 1}}}},
        "own.box",
        "exactly one of density_kg_m3 and mass_kg",
    ),
    change(
        "a missing contact map",
        {"objects": {"own": {"box": BOX | {"contact_maps": {"use": "no.ply"}}}}},
        *("objects.own.box.contact_maps.use", "no such file: no.ply"),
        box=b"",
    ),
    change(
        "a contact map for an unknown task",
        {"objects": {"own": {"box": BOX | {"contact_maps": {"drink": "no.ply"}}}}},
        *("objects.own.box.contact_maps", "'drink' is not one of use, handoff"),
        box=b"",
    ),
    change("a missing mesh", {"objects": {"own": {"box": BOX}}}, "box.stl"),
    change(
        "an own object with a catalogue name", {"objects": {"own": {"mug": BOX}}}, "objects.own.mug"
    ),
    environment("a missing table", "GRASPTYPES_PUBLISHED_CSV", "no.csv", "'no.csv'"),
    environment("missing photographs", "GRASPTYPES_PHOTOGRAPHS", "no", "'no'", "photographs.csv"),
    photographs("an object that is not known", "one.png,spaceship,0,0,40,40", "spaceship"),
    photographs("a missing photograph", "two.png,mug,0,0,40,40", "file: no such file: two.png"),
    photographs("a missing corner", "one.png,mug,0,0,,40", "right"),
    environment("missing scans", "GRASPTYPES_REFERENCE_MESHES", "no", "'no'"),
    environment(
        "a URL without checksum",
        "GRASPTYPES_PUBLISHED_CSV",
        "https://example.org/t.csv",
        "#sha256=<64 hex digits>",
    ),
]
