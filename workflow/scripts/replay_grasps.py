"""Replay the published hand poses on reference meshes; without them, keep the table."""

import os
from collections.abc import Sequence
from pathlib import Path

from grasptypes.errors import InputError
from grasptypes.jobs import job
from grasptypes.labels.published import read_published
from grasptypes.labels.published_source import PUBLISHED, published_path
from grasptypes.labels.replay import REPLAY_SCHEMA, ReplaySettings, replay
from grasptypes.objects.reference_meshes import REFERENCES, reference_meshes
from grasptypes.tables import write_table


def replay_grasps(
    published: str, scans: Sequence[Path], settings: ReplaySettings, target: Path
) -> str:
    """Write the replay table, or keep it if the user lacks the data; returns a line to log.

    Args:
        published: the authors' GraspTypesWithTasks.csv; empty if the user has none.
        scans: `<object>.stl` each; none if the user has none.
    """
    if not (published and scans):
        lacking = REFERENCES if published else PUBLISHED
        if not target.exists():
            raise InputError(lacking, "", f"is not set and there is no {target} to keep")
        return f"{lacking} is not set: {target} stays as it is"
    meshes = {path.stem: path for path in scans}
    table = replay(read_published(published), meshes, settings)
    write_table(table, target, REPLAY_SCHEMA)
    return f"replayed {table['n'].sum()} poses on {len(table)} scans"


if __name__ == "__main__":
    with job(snakemake.log) as log:
        line = replay_grasps(
            published_path(os.environ),
            reference_meshes(os.environ),
            ReplaySettings(**snakemake.params.settings),
            Path(snakemake.output.table),
        )
        log.info(line)
