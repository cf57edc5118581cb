import errno
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


@pytest.mark.parametrize(
    ("error", "line"),
    [
        (
            OSError(errno.ENOSPC, "No space left on device", "a.npz"),
            "a.npz: No space left on device",
        ),
        (OSError(errno.EROFS, "Read-only file system"), "a file: Read-only file system"),
        (MemoryError(), "the memory is too short for this job: give it more, or run fewer at once"),
    ],
)
def test_what_the_machine_lacks_is_one_line(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], error: Exception, line: str
) -> None:
    with pytest.raises(SystemExit), job([str(tmp_path / "job.log")]):
        raise error
    assert capsys.readouterr().err.startswith(f"error: {line}")
    assert line in (tmp_path / "job.log").read_text()


def test_other_errors_are_not_swallowed(tmp_path: Path) -> None:
    with pytest.raises(ZeroDivisionError), job([str(tmp_path / "job.log")]):
        _ = 1 / 0
    with pytest.raises(FileNotFoundError), job([str(tmp_path / "job.log")]):
        (tmp_path / "none").read_text()
