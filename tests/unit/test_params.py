from pathlib import Path

import pytest
import yaml

from grasptypes.errors import InputError
from grasptypes.params import load_params, merge, read_yaml, validate_params

ROOT = Path(__file__).parents[2]
SCHEMA = read_yaml(ROOT / "workflow/schemas/params.schema.yaml")


def params() -> dict:
    return read_yaml(ROOT / "params.yaml")


def test_committed_params_meet_the_schema() -> None:
    assert load_params(ROOT / "params.yaml", ROOT / "workflow/schemas/params.schema.yaml")


@pytest.mark.parametrize(
    ("change", "key", "allowed"),
    [
        ({"sed": 1}, "params.yaml", "allowed: "),
        ({"seed": "one"}, "seed", "whole number"),
        ({"seed": -1}, "seed", "minimum"),
        ({"tasks": ["use"]}, "tasks", "object"),
        ({"tasks": {"use": {"colour_shift": 999}}}, "tasks.use.colour_shift", "255"),
        ({"tasks": {"use": {"color_shift": 10}}}, "tasks.use", "colour_shift"),
        ({"tasks": {"Bad Name": {"colour_shift": 1}}}, "tasks", "Bad Name"),
        ({"objects": {"scale": 0}}, "objects.scale", "0"),
        ({"objects": {"names": ["mug", "teapot"]}}, "objects.names.1", "utah_teapot"),
        (
            {"objects": {"own": {"box": {"file": "box.stl", "unit": "m"}}}},
            "objects.own.box",
            "exactly one of density_kg_m3 and mass_kg",
        ),
    ],
)
def test_wrong_value_is_named_in_one_line(change: dict, key: str, allowed: str) -> None:
    with pytest.raises(InputError) as raised:
        validate_params(merge(params(), change), SCHEMA)
    line = str(raised.value)
    assert line.startswith("params.yaml")
    assert key in line
    assert allowed in line
    assert "\n" not in line


@pytest.mark.parametrize(
    ("text", "problem"),
    [
        ("", "mapping"),
        ("- a\n- b\n", "mapping"),
        ("seed: 1\nseed: 2\n", "'seed' is there twice"),
        ("seed: [1\n", "not valid YAML"),
        ("seed: !!python/object/apply:os.system [ls]\n", "not valid YAML"),
    ],
)
def test_unusable_yaml_is_refused(tmp_path: Path, text: str, problem: str) -> None:
    path = tmp_path / "params.yaml"
    path.write_text(text)
    with pytest.raises(InputError, match=problem) as raised:
        read_yaml(path)
    assert str(path) in str(raised.value)
    assert "\n" not in str(raised.value)


def test_missing_and_binary_files_are_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="no such file"):
        read_yaml(tmp_path / "nowhere.yaml")
    (tmp_path / "binary.yaml").write_bytes(b"\xff\xfe\x00")
    with pytest.raises(InputError, match="UTF-8"):
        read_yaml(tmp_path / "binary.yaml")


def test_merge_replaces_lists_and_keeps_the_rest() -> None:
    base = {"a": {"x": [1, 2], "y": 3}, "b": 4}
    assert merge(base, {"a": {"x": [5]}}) == {"a": {"x": [5], "y": 3}, "b": 4}
    assert base == {"a": {"x": [1, 2], "y": 3}, "b": 4}


def leaves(schema: dict, path: str = "") -> list[tuple[str, dict]]:
    if "properties" in schema:
        found = []
        for key, value in schema["properties"].items():
            found += leaves(value, f"{path}.{key}")
        return found
    return [(path, schema)]


def test_every_key_has_a_description_and_sections_are_closed() -> None:
    for path, schema in leaves(SCHEMA):
        assert "description" in schema or "$ref" in schema, path
    text = (ROOT / "workflow/schemas/params.schema.yaml").read_text()
    assert yaml.safe_load(text)["additionalProperties"] is False
