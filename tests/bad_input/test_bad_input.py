"""Every mistake is reported in one line that names the file and the key; nothing is written."""

from __future__ import annotations

import tempfile
from pathlib import Path

import pytest
from case import Case, try_in
from table import CASES, TABLE, row


@pytest.mark.parametrize("case", CASES, ids=lambda case: f"{case.kind}: {case.what}")
def test_a_mistake_ends_with_one_line_and_writes_nothing(case: Case, tmp_path: Path) -> None:
    result = try_in(tmp_path / "folder", case)
    assert result.status != 0
    assert result.printed.startswith("error: ")
    assert result.printed.strip().count("\n") == 0, result.printed
    for name in case.names:
        assert name in result.printed
    assert result.written == []


def test_there_are_enough_of_them_and_none_is_there_twice() -> None:
    assert len({(case.kind, case.what) for case in CASES}) == len(CASES) >= 60


def test_the_documentation_lists_them_all() -> None:
    """The lines themselves may change with a library's version: make bad-input rewrites them."""
    documented = TABLE.read_text(encoding="utf-8")
    for case in CASES:
        assert row(case, "").split("`")[0].rstrip() in documented
    # Messages name files as the user does.
    assert tempfile.gettempdir() not in documented
