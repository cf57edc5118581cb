"""What is noted about one run that was killed does not pass for another."""

import json
from pathlib import Path

import kill_runs
import pytest
from repository import Repository


class BegunError(Exception):
    """A run was started."""


def begin(*_: object) -> bool:
    raise BegunError


def test_only_the_same_run_is_taken_from_a_note(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    noted = tmp_path / f"{kill_runs.run_name(seed=0, number=1, kills=1)}.json"
    noted.write_text(json.dumps("run 1: no trace\n"))
    (tmp_path / "fresh").mkdir()
    monkeypatch.setattr(kill_runs, "undisturbed", lambda _: (Repository(tmp_path), 1.0))
    monkeypatch.setattr(kill_runs, "kill_after", begin)
    assert kill_runs.disturb(tmp_path, seed=0, number=1, kills=1) == []
    assert capsys.readouterr().out == "run 1: no trace\n"
    for other in ({"seed": 1}, {"number": 2}, {"kills": 2}):
        with pytest.raises(BegunError):
            kill_runs.disturb(tmp_path, **{"seed": 0, "number": 1, "kills": 1, **other})
    monkeypatch.setattr(kill_runs, "TRIAL", "data_samples.csv")
    with pytest.raises(BegunError):
        kill_runs.disturb(tmp_path, seed=0, number=1, kills=1)
