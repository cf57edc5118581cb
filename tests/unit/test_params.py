import subprocess
import sys
from pathlib import Path

import pytest
from tests.unit.settings import PARAMS, RAW

from grasptypes.errors import InputError
from grasptypes.settings.base import Settings
from grasptypes.settings.params import Params, read_params
from grasptypes.settings.schema import PLACE, write_schema
from grasptypes.yaml_files import merge

ROOT = Path(__file__).parents[2]
BOX = {"file": "box.stl", "unit": "m", "mass_kg": 0.1}


def test_the_parameters_of_the_project_are_allowed():
    assert read_params(ROOT / "params.yaml").labels == ("simulated", "published")


@pytest.mark.parametrize(
    ("change", "line"),
    [
        ({"seed": "one"}, "seed: 'one' is not an integer (integer, part of the key"),
        ({"seed": -1}, "seed: -1 is less than the minimum of 0 ("),
        ({"tasks": ["use"]}, "tasks: ['use'] is not a mapping"),
        ({"tasks": {"use": {"colour_shift": 999}}}, "tasks.use.colour_shift: 999 is greater than"),
        ({"tasks": {"none": {"colour_shift": 1}}}, "tasks.none: 'none' stands for no task"),
        (
            {"tasks": {"give": {"colour_shift": 10}}},
            "tasks.give.colour_shift: 10 is also that of use",
        ),
        ({"objects": {"scale": 0}}, "objects.scale: 0 is not greater than 0 (size relative to"),
        ({"objects": {"variation": {"size": [2, 1]}}}, "objects.variation.size: 2 is above 1"),
        (
            {"objects": {"own": {"box": BOX | {"contact_maps": {"drink": "d.ply"}}}}},
            "objects.own.box.contact_maps: 'drink' is not one of use, handoff",
        ),
        (
            {"objects": {"resolution": {"grid_spacing_m": 1}}},
            "objects.resolution.grid_spacing_m: 1 is greater than the maximum of 0.01 (distance "
            "between nodes of the distance grid, metres)",
        ),
        ({"labels": []}, "labels: [] has 0 values, at least 1 are needed"),
        ({"predictors": {"hidden": [1, 2]}}, "predictors.hidden: has 2 values, more are needed"),
    ],
)
def test_the_first_mistake_is_one_line(change: dict, line: str):
    with pytest.raises(InputError) as raised:
        Params.check(merge(RAW, change), "my.yaml")
    assert str(raised.value).startswith(f"my.yaml: {line}")
    assert "\n" not in str(raised.value)


def test_an_unknown_section_is_told_before_the_missing_one_it_stands_for():
    changed = {**RAW, "sed": RAW["seed"]}
    del changed["seed"]
    with pytest.raises(InputError, match=r"'sed' is not a known key; allowed: .*, seed, "):
        Params.check(changed)


def test_settings_are_constant_and_survive_a_round_trip():
    with pytest.raises(ValueError, match="frozen"):
        PARAMS.seed = 1
    assert Params.check(PARAMS.model_dump(by_alias=True)) == PARAMS


def sections(section: type[Settings]):
    yield section
    for field in section.model_fields.values():
        if isinstance(field.annotation, type) and issubclass(field.annotation, Settings):
            yield from sections(field.annotation)


@pytest.mark.parametrize("section", list(sections(Params)), ids=lambda section: section.__name__)
def test_every_key_says_what_it_means(section):
    for name, field in section.model_fields.items():
        inner = isinstance(field.annotation, type) and issubclass(field.annotation, Settings)
        assert inner or field.description, name


def test_the_schema_for_editors_is_that_of_the_settings(tmp_path):
    write_schema(tmp_path / "schema.json")
    assert (tmp_path / "schema.json").read_text() == (ROOT / PLACE).read_text()


def test_settings_import_no_heavy_library():
    code = "import sys, grasptypes.settings.params; print(*sys.modules)"
    found = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert not {"numpy", "torch", "numba", "trimesh", "scipy"} & set(found.stdout.split())


def test_merge_replaces_lists_and_keeps_the_rest():
    base = {"a": {"x": [1, 2], "y": 3}, "b": 4}
    assert merge(base, {"a": {"x": [5]}}) == {"a": {"x": [5], "y": 3}, "b": 4}
    assert base == {"a": {"x": [1, 2], "y": 3}, "b": 4}
