"""Blocks of own objects are checked before anything runs."""

import pytest
from tests.unit.settings import RAW

from grasptypes.errors import InputError
from grasptypes.objects.own_objects import check_every_hold, check_own_objects, measured_map
from grasptypes.settings.params import Params
from grasptypes.yaml_files import merge

TASKS = ["use", "handoff"]
MUG = [("mug", "use"), ("mug", "handoff")]


@pytest.fixture
def own(tmp_path):
    files = {name: tmp_path / name for name in ("box.stl", "use.ply")}
    for file in files.values():
        file.touch()
    maps = {"use": str(files["use.ply"])}
    return {"file": str(files["box.stl"]), "unit": "m", "mass_kg": 1, "contact_maps": maps}


def objects_with(own):
    return Params.check(merge(RAW, {"objects": {"names": ["mug"], "own": {"box": own}}})).objects


def test_complete_blocks_pass(own):
    objects = objects_with(own)
    check_own_objects(objects)
    check_every_hold(objects, TASKS, [*MUG, ("box", "handoff")], "t")
    assert measured_map(objects, "box", "use").endswith("use.ply")
    assert measured_map(objects, "box", "handoff") is None
    assert measured_map(objects, "mug", "use") is None


def test_an_object_that_nothing_says_how_to_hold_is_named(own):
    objects = objects_with(own)
    with pytest.raises(InputError) as raised:
        check_every_hold(objects, TASKS, MUG, "table.csv")
    assert str(raised.value) == (
        "table.csv: box and handoff: has no row; add at least one or set "
        "objects.own.box.contact_maps.handoff"
    )
    with pytest.raises(InputError, match=r"mug and use: has no row; add at least one$"):
        check_every_hold(objects, TASKS, [], "table.csv")
