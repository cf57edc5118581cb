"""Replay the published hand poses on reference meshes."""

import os
from collections.abc import Sequence
from pathlib import Path

from grasptypes.errors import InputError
from grasptypes.hands.hand import Hand
from grasptypes.hands.reading import load_hand
from grasptypes.jobs import job
from grasptypes.labels.label_sources import PUBLISHED, published_path
from grasptypes.labels.published import read_published
from grasptypes.labels.replay import REPLAY_SCHEMA, replay
from grasptypes.objects.reference_meshes import REFERENCES, reference_meshes
from grasptypes.settings.grasp_types import ReplaySettings
from grasptypes.tables import write_table


def replay_grasps(
    published: str, hand: Hand, scans: Sequence[Path], settings: ReplaySettings, target: Path
) -> str:
    """Write the replay table; returns a line for the log.

    Args:
        published: the authors' GraspTypesWithTasks.csv; empty if the user has none.
        hand: the hand of its poses.
        scans: files `<object>.stl`; empty if the user has none.
    """
    if not (published and scans):
        raise InputError(
            REFERENCES if published else PUBLISHED, "", f"is not set; {target} needs it"
        )
    meshes = {path.stem: path for path in scans}
    grasps = read_published(published)
    if not (grasps.object.isin(list(meshes)) & grasps.hand_configuration.notna()).any():
        raise InputError(published, "", "has no configuration for an object with a scan")
    table = replay(grasps, hand, meshes, settings)
    write_table(table, target, REPLAY_SCHEMA)
    return f"replayed {table['n'].sum()} poses on {len(table)} scans"


if __name__ == "__main__":
    with job(snakemake.log) as log:
        line = replay_grasps(
            published_path(os.environ),
            load_hand(snakemake.params.hand["name"]),
            reference_meshes(os.environ),
            ReplaySettings.check(snakemake.params.settings),
            Path(snakemake.output.table),
        )
        log.info(line)
