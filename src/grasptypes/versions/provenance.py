"""How each result was made, in one file that DVC versions along with the results.

Snakemake keeps records, with times, of all past targets in ``.snakemake``. The information that
decides about staleness goes to ``data/provenance.json``, without times and only for DVC's outs, so
that the file depends only on the results (``python -m grasptypes.versions.provenance`` writes it).
A checkout that got its results from DVC converts it back to Snakemake's records.
"""

from __future__ import annotations

import json
import os
import sys
from pathlib import Path

import yaml
from snakemake.persistence import MetadataRecord
from snakemake.persistence.file import FilePersistence

from grasptypes.content_hash import FileHash
from grasptypes.errors import InputError, parsing
from grasptypes.files import write_json, write_text

PROVENANCE = "data/provenance.json"
# Checksum of the provenance that Snakemake's records correspond to.
ADOPTED = ".snakemake/adopted_provenance"
FILE_HASHES = ".snakemake/file_hashes.json"
# The fields that Snakemake compares, in its own format.
COMPARED = (
    *("rule", "input", "input_checksums", "params", "code", "shellcmd"),
    *("software_stack_hash", "record_format_version"),
)


def write_provenance(root: Path) -> None:
    """Write the provenance of all results that DVC versions and Snakemake made."""
    records, file_hash = FilePersistence(path=root / ".snakemake"), FileHash(root / FILE_HASHES)
    jobs: dict[str, dict[str, str]] = {}
    names = versioned_files(root)
    unfinished = records._filter_incomplete_keys(names)
    for name in names:
        record = records._read_record(name)
        if record is not None and name not in unfinished:
            made = json.dumps({field: record[field] for field in COMPARED}, sort_keys=True)
            jobs.setdefault(made, {})[name] = file_hash(root / name)
    content = [json.loads(made) | {"outputs": jobs[made]} for made in sorted(jobs)]
    write_json(root / PROVENANCE, content)
    write_text(root / ADOPTED, file_hash(root / PROVENANCE))


def adopt_provenance(root: Path) -> None:
    """Give Snakemake records of results from elsewhere, for example from ``dvc pull``.

    Results that differ from the provenance, because they were recomputed, keep their records.

    Raises:
        InputError: the provenance is damaged.
    """
    file_hash, adopted = FileHash(root / FILE_HASHES), root / ADOPTED
    now = file_hash(root / PROVENANCE)
    if now == "missing" or (adopted.exists() and adopted.read_text() == now):
        return
    records = FilePersistence(path=root / ".snakemake")
    with parsing(PROVENANCE, "is damaged; restore it with: dvc checkout --force"):
        for made in json.loads((root / PROVENANCE).read_text(encoding="utf-8")):
            outputs = made.pop("outputs")
            for name, checksum in outputs.items():
                known = records._read_record(name)
                same = known is not None and all(known[field] == made[field] for field in COMPARED)
                if not same and file_hash(root / name) == checksum:
                    time = os.stat(root / name).st_mtime
                    record = MetadataRecord(**made, starttime=time, endtime=time, incomplete=False)
                    records._write_record(name, record)
                    records._unmark_incomplete(name)
    write_text(adopted, now)


def times_ms(result: Path, root: Path = Path()) -> tuple[int, int]:
    """Start and end of the job that made a result, milliseconds since 1970.

    For a result from elsewhere only the file's own time is known.
    """
    record = FilePersistence(path=root / ".snakemake")._read_record(str(result))
    if record is None or record.starttime is None or record.endtime is None:
        return (int(1000 * os.stat(root / result).st_mtime),) * 2
    return int(1000 * record.starttime), int(1000 * record.endtime)


def versioned_files(root: Path) -> list[str]:
    """All files in DVC's outs except the provenance, relative to the root, sorted."""
    stages = yaml.safe_load((root / "dvc.yaml").read_text(encoding="utf-8"))["stages"].values()
    outs = [out for stage in stages for out in stage.get("outs", []) + stage.get("metrics", [])]
    names = [out if isinstance(out, str) else next(iter(out)) for out in outs]
    found = {path for name in names for path in (root / name, *(root / name).rglob("*"))}
    files = {str(path.relative_to(root)) for path in found if path.is_file()}
    return sorted(files - {PROVENANCE})


if __name__ == "__main__":
    try:
        write_provenance(Path.cwd())
    except InputError as error:
        sys.exit(f"error: {error}")
