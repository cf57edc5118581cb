"""What the published labels know, and that nobody trains on nothing."""

import pytest

from grasptypes.errors import InputError
from grasptypes.labels.label_sources import label_sources

TASKS = ["use", "handoff", "wash"]


@pytest.fixture
def counts(tmp_path):
    path = tmp_path / "counts.csv"
    path.write_text("object,task,count\nmug,use,1\nmug,handoff,2\npan,use,1\npan,handoff,1\n")
    return path


def test_published_labels_cover_the_authors_objects_and_tasks_in_our_order(counts):
    known = label_sources(["simulated", "published"], counts, ["pan", "ladle", "mug"], TASKS)
    assert known["simulated"].objects == ["pan", "ladle", "mug"]
    assert known["simulated"].tasks == TASKS
    assert known["published"].objects == ["pan", "mug"]
    assert known["published"].tasks == ["use", "handoff"]


@pytest.mark.parametrize(("objects", "tasks"), [(["ladle"], TASKS), (["mug"], ["wash"])])
def test_published_labels_of_nothing_are_refused_only_if_they_are_used(counts, objects, tasks):
    assert label_sources(["simulated"], counts, objects, tasks)["published"].objects == []
    with pytest.raises(InputError, match=r"params\.yaml: labels: 'published' has none of these"):
        label_sources(["published"], counts, objects, tasks)
