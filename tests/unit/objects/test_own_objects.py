"""Blocks of own objects are checked before anything runs."""

import pytest
from tests.unit.settings import RAW

from grasptypes.errors import InputError
from grasptypes.objects.own_objects import check_every_hold, check_own_objects, measured_map
from grasptypes.settings.params import Params
from grasptypes.settings.tasks import read_tasks
from grasptypes.yaml_files import merge

TASKS = {name: read_tasks()[name] for name in ("use", "handoff")}
HANDLE = {"parts": {"body": {"role": "handle"}}}


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
    objects = objects_with(own | HANDLE)
    check_own_objects(objects)
    check_every_hold(objects, TASKS)
    assert measured_map(objects, "box", "use").endswith("use.ply")
    assert measured_map(objects, "box", "handoff") is None
    assert measured_map(objects, "mug", "use") is None


def test_the_shape_of_an_object_without_roles_tells_how_to_hold_it(own):
    check_every_hold(objects_with(own), TASKS)


def test_an_object_whose_roles_nobody_touches_is_named(own):
    with pytest.raises(InputError) as raised:
        check_every_hold(objects_with(own | {"parts": {"body": {"role": "screen"}}}), TASKS)
    assert str(raised.value).startswith(
        "params.yaml: objects.own.box: has no way to be held for handoff: give a part a role"
    )
    assert str(raised.value).endswith("or set contact_maps.handoff")


def test_a_task_that_a_catalogue_object_is_not_held_for_is_named(own):
    objects = objects_with(own | HANDLE).changed(names=("wine_glass",))
    with pytest.raises(InputError, match=r"tasks\.cut: wine_glass has no part .*roles: handle"):
        check_every_hold(objects, {"cut": read_tasks()["cut"]})
