"""Snakemake's records of what it made: which results have one, and what becomes of the others."""

from __future__ import annotations

import ast
import base64
import json
from pathlib import Path
from typing import Any

RECORDS = ".snakemake/metadata"
UNFINISHED = ".snakemake/incomplete"
# Longer names are cut into folders, since file names end at 255 bytes.
_PART_LENGTH = 254


def record_path(result: str, folder: str = RECORDS) -> Path:
    """Where Snakemake keeps its record of a result: the path in URL-safe base64."""
    name = base64.urlsafe_b64encode(result.encode()).decode()
    *folders, last = [name[i : i + _PART_LENGTH] for i in range(0, len(name), _PART_LENGTH)]
    return Path(folder, *(f"@{part}" for part in folders), last)


def recorded_result(record: Path) -> str:
    """The result that a record, relative to the folder of all records, is about."""
    encoded = "".join(part.removeprefix("@") for part in record.parts)
    return base64.urlsafe_b64decode(encoded).decode()


def is_recorded(result: str) -> bool:
    """Whether a job of this checkout, or of the one it was pulled from, made this result."""
    return record_path(result).is_file()


def recorded_params(result: str, root: str | Path = ".") -> list[Any]:
    """What the job that made a result had for parameters, in Snakemake's order, without names.

    Returns:
        nothing if there is no record, or if a job was killed before it could renew it.
    """
    if (Path(root) / record_path(result, UNFINISHED)).exists():
        return []
    try:
        record = json.loads((Path(root) / record_path(result)).read_text())
    except FileNotFoundError:
        return []
    return [ast.literal_eval(text) for text in record["params"]]


def distrust_unrecorded(persistence: type[Any]) -> None:
    """Have results made anew of which Snakemake has no record.

    Small tables lie in git, so a clone has them before anything was computed; their being there
    says nothing of the parameters, code and inputs at hand. Snakemake looks for files that a
    killed job left unfinished, and makes them anew (``rerun-incomplete``); results without a
    record now count among these. ``dvc pull`` brings the records, and then nothing is to be done.
    Outputs that are marked ``update(...)`` keep what they hold where the data for it are lacking.

    Args:
        persistence: Snakemake's class that keeps the records.
    """
    find_unfinished = persistence.incomplete

    async def incomplete(self: Any, job: Any) -> list[Any]:
        """What Snakemake finds unfinished, and results without a record."""
        unfinished = await find_unfinished(self, job)
        unrecorded = [
            result
            for result in job.output
            if self.metadata(result) is None
            and "update" not in result.flags
            and await result.exists()
        ]
        return [*unfinished, *unrecorded]

    persistence.incomplete = incomplete
