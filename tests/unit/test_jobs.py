import logging
from pathlib import Path

import pytest
from snakemake.logging import logger
from snakemake_interface_logger_plugins.common import LogEvent

from grasptypes.errors import InputError
from grasptypes.failed_jobs import FailedJobs
from grasptypes.jobs import job


def test_bad_input_is_one_line_and_status_1(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    log = tmp_path / "logs" / "job.log"

    def fail() -> None:
        with job([str(log)]) as logger:
            logger.info("started")
            raise InputError("mesh.stl", "vertices", "NaN at\nrow 3")

    with pytest.raises(SystemExit) as raised:
        fail()
    assert raised.value.code == 1
    assert capsys.readouterr().err == "error: mesh.stl: vertices: NaN at row 3\n"
    assert log.read_text().splitlines() == [
        "INFO started",
        "ERROR mesh.stl: vertices: NaN at row 3",
    ]


def test_what_nobody_foresaw_is_one_line_with_its_trace_in_the_log(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(SystemExit), job([str(tmp_path / "job.log")]):
        raise KeyError("mug")
    assert capsys.readouterr().err == "error: KeyError: 'mug'\n"
    lines = (tmp_path / "job.log").read_text().splitlines()
    assert lines[-1] == "ERROR KeyError: 'mug'"
    assert "Traceback (most recent call last):" in lines


def failed(job: str) -> logging.LogRecord:
    record = logging.LogRecord("snakemake", logging.ERROR, "", 0, "Error", None, None)
    record.event, record.log = LogEvent.JOB_ERROR, [f"logs/{job}.log"]
    return record


def test_every_failed_job_has_its_reason_in_the_summary(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "logs/train").mkdir(parents=True)
    (tmp_path / "logs/train/mug.log").write_text("INFO started\nERROR first\nERROR last\n")
    failures = FailedJobs()
    for name in ("train/mug", "killed"):
        failures.emit(failed(name))
    reasons = failures.summary().splitlines()
    assert reasons[0] == "error: train/mug: last (log: logs/train/mug.log)"
    assert reasons[1].startswith("error: killed: ended without a message, as if killed")
    logger.removeHandler(failures)
