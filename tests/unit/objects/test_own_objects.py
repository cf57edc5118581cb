"""Blocks of own objects are checked before anything runs."""

import pytest

from grasptypes.errors import InputError
from grasptypes.objects.own_objects import check_every_hold, check_own_objects, measured_map

TASKS = ["use", "handoff"]


@pytest.fixture
def objects(tmp_path):
    files = {name: tmp_path / name for name in ("box.stl", "use.ply")}
    for file in files.values():
        file.touch()
    own = {"file": str(files["box.stl"]), "contact_maps": {"use": str(files["use.ply"])}}
    return {"names": ["mug"], "own": {"box": own}}


def test_complete_blocks_pass(objects):
    check_own_objects(objects, TASKS)
    check_every_hold(objects, TASKS, [("mug", "use"), ("mug", "handoff"), ("box", "handoff")], "t")
    assert measured_map(objects, "box", "use").endswith("use.ply")
    assert measured_map(objects, "box", "handoff") is None
    assert measured_map(objects, "mug", "use") is None


def test_unknown_task_is_named_with_its_key(objects):
    objects["own"]["box"]["contact_maps"]["drink"] = "drink.ply"
    with pytest.raises(InputError) as raised:
        check_own_objects(objects, TASKS)
    assert str(raised.value) == (
        "params.yaml: objects.own.box.contact_maps: 'drink' is not one of use, handoff"
    )


def test_missing_files_and_names_given_twice_are_refused(objects):
    box = objects["own"]["box"]
    missing = box | {"contact_maps": {"use": "gone.ply"}}
    with pytest.raises(InputError, match=r"own\.box\.contact_maps\.use: no such file: gone\.ply"):
        check_own_objects(objects | {"own": {"box": missing}}, TASKS)
    with pytest.raises(InputError, match=r"own\.box\.file: no such file: gone\.stl"):
        check_own_objects(objects | {"own": {"box": box | {"file": "gone.stl"}}}, TASKS)
    with pytest.raises(InputError, match=r"own\.mug: is also in objects\.names"):
        check_own_objects(objects | {"own": {"mug": box}}, TASKS)


def test_an_object_that_nothing_says_how_to_hold_is_named(objects):
    with pytest.raises(InputError) as raised:
        check_every_hold(objects, TASKS, [("mug", "use"), ("mug", "handoff")], "table.csv")
    assert str(raised.value) == (
        "table.csv: box and handoff: has no row; add at least one or set "
        "objects.own.box.contact_maps.handoff"
    )
    with pytest.raises(InputError, match=r"mug and use: has no row; add at least one$"):
        check_every_hold(objects, TASKS, [], "table.csv")
