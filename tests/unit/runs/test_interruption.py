"""Publishing that was cut off is taken up again."""

import subprocess

import pytest

from grasptypes.runs.interruption import MARKS, marked, take_up_publishing


@pytest.fixture
def published(monkeypatch):
    """How often somebody published; the exit statuses to answer with."""
    calls, statuses = [], []

    def run(command, **options):
        calls.append(command)
        return subprocess.CompletedProcess(command, statuses.pop() if statuses else 0)

    monkeypatch.setattr(subprocess, "run", run)
    return calls, statuses


def test_whoever_ends_orderly_leaves_no_mark(tmp_path, published):
    with marked(tmp_path):
        assert len(list((tmp_path / MARKS).iterdir())) == 1
    with pytest.raises(ValueError, match="the store"), marked(tmp_path):
        raise ValueError("the store is locked")
    assert not take_up_publishing(tmp_path)
    assert published[0] == []


def test_whoever_is_killed_leaves_one_until_somebody_has_published(tmp_path, published):
    (tmp_path / MARKS).mkdir(parents=True)
    (tmp_path / MARKS / "4711").touch()
    calls, statuses = published
    statuses.append(1)
    assert take_up_publishing(tmp_path)
    assert take_up_publishing(tmp_path)
    assert not take_up_publishing(tmp_path)
    assert len(calls) == 2
    assert calls[0][1:] == ["-m", "grasptypes.runs.publishing"]
