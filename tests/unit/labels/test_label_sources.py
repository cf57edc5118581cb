"""The authors' table by path, or by URL and checksum; and that nobody trains on nothing."""

import hashlib

import pytest
from hosts import CONTENT

from grasptypes.errors import InputError
from grasptypes.labels.label_sources import (
    FETCHED,
    PUBLISHED,
    check_published,
    fetch_published,
    label_sources,
    published_address,
    published_path,
)

TASKS = ["use", "handoff", "wash"]
SHA256 = hashlib.sha256(CONTENT).hexdigest()


def test_a_path_is_taken_as_it_is(tmp_path):
    path = tmp_path / "table.csv"
    path.touch()
    named = {PUBLISHED: str(path)}
    check_published(named)
    assert published_path(named) == str(path)
    assert published_address(named) is None
    assert published_path({}) == ""


def test_a_url_is_fetched_to_its_place(host, tmp_path):
    named = {PUBLISHED: f"{host}/content#sha256={SHA256.upper()}"}
    check_published(named)
    assert published_path(named) == FETCHED
    assert fetch_published(named, tmp_path / "table.csv", 2) == (f"{host}/content", SHA256)
    assert (tmp_path / "table.csv").read_bytes() == CONTENT


@pytest.mark.parametrize("fragment", ["", "#", "#sha256=12ab", f"#md5={SHA256}"])
def test_a_url_needs_its_checksum(fragment):
    named = {PUBLISHED: f"https://example.org/table.csv{fragment}"}
    for check in (check_published, published_path):
        with pytest.raises(InputError, match=r"must end in #sha256=<64 hex digits>"):
            check(named)


@pytest.mark.parametrize(
    ("named", "said"),
    [
        ("{host}/content#sha256=" + "0" * 64, f"has the SHA-256 {SHA256} instead of 0000"),
        ("http://127.0.0.1:9/t.csv#sha256=" + SHA256, "cannot be reached.*set its path instead"),
        ("table.csv", "is not a URL"),
    ],
)
def test_what_cannot_be_fetched_is_one_line_and_leaves_nothing(host, tmp_path, named, said):
    environment = {PUBLISHED: named.format(host=host)}
    with pytest.raises(InputError, match=said) as raised:
        fetch_published(environment, tmp_path / "table.csv", 2)
    assert "\n" not in str(raised.value)
    assert list(tmp_path.iterdir()) == []


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
