"""Replay the published hand poses on reference meshes; without them, keep the table."""

import os
from pathlib import Path

from grasptypes.errors import InputError
from grasptypes.jobs import job
from grasptypes.labels.published import read_published
from grasptypes.labels.published_source import PUBLISHED, published_path
from grasptypes.labels.replay import REPLAY_SCHEMA, ReplaySettings, replay
from grasptypes.objects.reference_meshes import REFERENCES
from grasptypes.tables import write_table


def replay_grasps(published: str, references: str, settings: ReplaySettings, target: Path) -> str:
    """Write the replay table, or keep it if the user lacks the data; returns a line to log.

    Args:
        published: the authors' GraspTypesWithTasks.csv; empty if the user has none.
        references: folder of `<object>.stl`; empty if the user has none.
    """
    if not (published and references):
        lacking = REFERENCES if published else PUBLISHED
        if not target.exists():
            raise InputError(lacking, "", f"is not set and there is no {target} to keep")
        return f"{lacking} is not set: {target} stays as it is"
    if not Path(references).is_dir():
        raise InputError(REFERENCES, "", f"{references} is no folder")
    meshes = {path.stem: path for path in sorted(Path(references).glob("*.stl"))}
    table = replay(read_published(published), meshes, settings)
    write_table(table, target, REPLAY_SCHEMA)
    return f"replayed {table['n'].sum()} poses on {len(table)} objects of {references}"


if __name__ == "__main__":
    with job(snakemake.log) as log:
        line = replay_grasps(
            published_path(os.environ),
            os.environ.get(REFERENCES, ""),
            ReplaySettings(**snakemake.params.settings),
            Path(snakemake.output.table),
        )
        log.info(line)
