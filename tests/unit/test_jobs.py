from pathlib import Path

import pytest

from grasptypes.errors import InputError
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


def test_other_errors_are_not_swallowed(tmp_path: Path) -> None:
    with pytest.raises(ZeroDivisionError), job([str(tmp_path / "job.log")]):
        _ = 1 / 0
