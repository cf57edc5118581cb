"""The affinity table: what is read, and that every wrong cell is named."""

import os
from pathlib import Path

import pytest

from grasptypes.contact_maps.affinities import COLUMNS, AffinityRow, check_rows, read_affinities
from grasptypes.contact_maps.contact_evidence import CLASSES, GRIP_OF_TYPE
from grasptypes.errors import InputError
from grasptypes.labels.published import read_published
from grasptypes.objects.catalogue import OBJECTS, build

TABLE = Path(__file__).parents[3] / "assets" / "affinities.csv"
TASKS = ("use", "handoff")
GOOD = "mug,use,handle,wrap,+x,z,0.3,0.7,2,to drink"


def _table(folder: Path, *rows: str) -> Path:
    path = folder / "affinities.csv"
    path.write_text("\n".join([",".join(COLUMNS), *rows]) + "\n", encoding="utf-8")
    return path


def test_reads_rows_by_object_and_task(tmp_path):
    path = _table(tmp_path, GOOD, "mug,show,*,pinch,around,,0,1,0.5,a third task")
    table = read_affinities(path, ["mug"], ["use", "show"])
    assert table["mug", "use"] == (
        AffinityRow(("handle",), "wrap", "+x", "z", 0.3, 0.7, 2.0, "to drink"),
    )
    assert table["mug", "show"][0].parts == ()


def test_a_missing_table_is_named(tmp_path):
    with pytest.raises(InputError, match="no such affinity table"):
        read_affinities(tmp_path / "none.csv", ["mug"], TASKS)


def test_unknown_part_and_missing_object_are_named(tmp_path):
    path = _table(tmp_path, GOOD)
    table = read_affinities(path, ["mug"], TASKS)
    with pytest.raises(InputError, match=r"part of mug and use: 'handle' is not one of wall, \*"):
        check_rows(table["mug", "use"], ("mug", "use"), ["wall"], path)
    with pytest.raises(InputError, match="mug and handoff: has no row"):
        check_rows(table.get(("mug", "handoff"), ()), ("mug", "handoff"), ["handle"], path)


def test_rows_of_other_tasks_are_checked_and_left_out(tmp_path):
    path = _table(tmp_path, GOOD)
    assert read_affinities(path, ["mug"], ["handoff"]) == {}


def test_our_table_knows_every_object_its_parts_and_both_tasks():
    table = read_affinities(TABLE, OBJECTS, TASKS)
    for name in OBJECTS:
        parts = [part.name for part in build(name).parts]
        for task in TASKS:
            assert len(table[name, task]) >= 3
            check_rows(table[name, task], (name, task), parts, TABLE)


@pytest.mark.skipif(
    "GRASPTYPES_PUBLISHED_CSV" not in os.environ, reason="GRASPTYPES_PUBLISHED_CSV is not set"
)
def test_grips_of_objects_with_poses_are_weighted_as_published():
    table = read_affinities(TABLE, OBJECTS, TASKS)
    grasps = read_published(os.environ["GRASPTYPES_PUBLISHED_CSV"])
    grasps = grasps.assign(grip=grasps.grasp_type.map(GRIP_OF_TYPE)).dropna(subset=["grip"])
    for name in [name for names in CLASSES.values() for name in names]:
        for task in TASKS:
            ours: dict[str, float] = {}
            for hold in table[name, task]:
                grip = "pinch" if hold.grip == "rim" else hold.grip
                ours[grip] = ours.get(grip, 0.0) + hold.affinity
            rows = grasps[(grasps.object == name) & (grasps.task == task)]
            assert ours == pytest.approx(rows.grip.value_counts().to_dict(), abs=0.25)
