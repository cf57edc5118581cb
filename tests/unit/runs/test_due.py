"""Publishing that a killed run left out is known of."""

import subprocess

import pytest

from grasptypes.runs.due import note_done, note_due, publish_what_is_due, publishing_is_due


@pytest.fixture
def published(monkeypatch):
    """The commands that somebody ran."""
    commands = []
    monkeypatch.setattr(subprocess, "run", lambda command, **_: commands.append(command))
    return commands


def trained(root):
    (root / "models/simulated/no_task").mkdir(parents=True)
    (root / "models/simulated/no_task/predictor.json").touch()


def test_it_is_due_from_the_start_of_a_run_until_somebody_has_published(tmp_path, published):
    trained(tmp_path)
    publish_what_is_due(tmp_path)
    note_due(tmp_path)
    assert publishing_is_due(tmp_path)
    publish_what_is_due(tmp_path)
    note_done(tmp_path)
    note_done(tmp_path)
    publish_what_is_due(tmp_path)
    assert [command[1:] for command in published] == [["-m", "grasptypes.runs.publishing"]]


def test_without_a_model_there_is_nothing_to_publish(tmp_path, published):
    note_due(tmp_path)
    publish_what_is_due(tmp_path)
    assert published == []
