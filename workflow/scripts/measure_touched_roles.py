"""Measure which roles the published grasps touch, as evidence for the tasks' weights of roles."""

from collections.abc import Mapping
from pathlib import Path

import pandas as pd

from grasptypes.contact_maps.touched_roles import TOUCH_SCHEMA, touched_roles
from grasptypes.errors import InputError
from grasptypes.hands.hand import Hand
from grasptypes.hands.reading import load_hand
from grasptypes.jobs import job
from grasptypes.labels.published import read_published
from grasptypes.objects.object_geometry import read_object
from grasptypes.settings.holds import TouchSettings
from grasptypes.tables import write_table


def measure_touched_roles(
    published: str | Path,
    hand: Hand,
    meshes: str | Path,
    folders: Mapping[str, Path],
    scale: float,
    settings: TouchSettings,
) -> pd.DataFrame:
    """The counts of all objects whose folders are given."""
    grasps = read_published(published)
    known = grasps[grasps.hand_configuration.notna() & (grasps.grasp_type != "Invalid")]
    tables = [
        touched_roles(
            known[known.object == name],
            hand,
            read_object(folder),
            Path(meshes) / f"{name}.stl",
            scale,
            settings,
        )
        for name, folder in folders.items()
        if (known.object == name).any()
    ]
    return pd.concat(tables, ignore_index=True)


if __name__ == "__main__":
    with job(snakemake.log):
        if not snakemake.input.published or not snakemake.input.references:
            variables = "GRASPTYPES_PUBLISHED_CSV and GRASPTYPES_REFERENCE_MESHES"
            raise InputError(variables, "", "must name the published poses and the scans")
        folders = [Path(path).parent for path in snakemake.input.properties]
        table = measure_touched_roles(
            snakemake.input.published,
            load_hand(snakemake.params.hand["name"]),
            Path(snakemake.input.references[0]).parent,
            dict(zip(snakemake.params.objects, folders, strict=True)),
            snakemake.params.scale,
            TouchSettings.check(snakemake.params.settings),
        )
        write_table(table, snakemake.output.table, TOUCH_SCHEMA)
