import subprocess
import sys
from pathlib import Path

import pytest
from tests.unit.settings import PARAMS

from grasptypes.settings.base import Settings
from grasptypes.settings.params import Params, read_params
from grasptypes.settings.schema import PLACE, write_schema
from grasptypes.yaml_files import merge

ROOT = Path(__file__).parents[2]
BOX = {"file": "box.stl", "unit": "m", "mass_kg": 0.1}


def test_the_parameters_of_the_project_are_allowed():
    assert read_params(ROOT / "params.yaml").labels == ("simulated", "published")


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
