"""All mistakes, and the table of their messages: `make bad-input` writes docs/bad_input.md."""

from __future__ import annotations

import tempfile
from pathlib import Path

import command_cases
import hand_cases
import kind_cases
import knowledge_cases
import map_cases
import mesh_cases
import params_cases
import picture_cases
import plan_cases
import role_cases
import shown_cases
import table_cases
import view_cases
import weights_cases
from case import ROOT, Case, try_in

MODULES = (
    params_cases,
    mesh_cases,
    map_cases,
    table_cases,
    knowledge_cases,
    view_cases,
    weights_cases,
    picture_cases,
    command_cases,
    hand_cases,
    kind_cases,
    plan_cases,
    role_cases,
    shown_cases,
)
CASES: list[Case] = [case for module in MODULES for case in module.CASES]
TABLE = ROOT / "docs/bad_input.md"
HEAD = """# Bad input

Each mistake below is reported in the given line, ends with a nonzero exit status, and leaves no
file behind. `make bad-input` tries them all and writes this table; the cases are in
tests/bad_input.

| input | mistake | message |
|---|---|---|
"""


def row(case: Case, printed: str) -> str:
    """The case's line of the table."""
    line = printed.strip().replace(str(ROOT), ".").replace("|", "\\|").replace("`", "'")
    return f"| {case.kind} | {case.what} | `{line}` |\n"


def main() -> None:
    """Try every case and write the table."""
    rows = []
    for case in CASES:
        with tempfile.TemporaryDirectory() as folder:
            rows.append(row(case, try_in(Path(folder) / "folder", case).printed))
    TABLE.write_text(HEAD + "".join(rows), encoding="utf-8")


if __name__ == "__main__":
    main()
