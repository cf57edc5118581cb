"""Derive where the published grasps hold the objects, as evidence for assets/affinities.csv."""

from collections.abc import Mapping
from pathlib import Path

import pandas as pd

from grasptypes.contact_maps.contact_evidence import (
    EVIDENCE_SCHEMA,
    PATTERN_SCHEMA,
    SUMMARY_SCHEMA,
    object_evidence,
    pattern,
    summarise,
)
from grasptypes.errors import InputError
from grasptypes.hands.hand import Hand
from grasptypes.hands.reading import load_hand
from grasptypes.jobs import job
from grasptypes.labels.published import read_published
from grasptypes.objects.object_files import read_surface
from grasptypes.settings.contact_maps import ContactEvidenceSettings
from grasptypes.tables import write_table


def derive_affinities(
    published: str | Path,
    hand: Hand,
    meshes: str | Path,
    surfaces: Mapping[str, str],
    targets: tuple[str | Path, str | Path, str | Path],
    scale: float,
    settings: ContactEvidenceSettings,
) -> None:
    """Write one row per published grasp, a summary by hold, and the shares of grips by class."""
    grasps = read_published(published)
    known = grasps[grasps.hand_configuration.notna() & (grasps.grasp_type != "Invalid")]
    rows = []
    for name, group in known.groupby("object", sort=True):
        if name in surfaces:
            scan = Path(meshes) / f"{name}.stl"
            surface = read_surface(surfaces[name])
            rows += object_evidence(group, hand, surface, scan, scale, settings)
    evidence = pd.DataFrame(rows)
    write_table(evidence, targets[0], EVIDENCE_SCHEMA)
    write_table(summarise(evidence), targets[1], SUMMARY_SCHEMA)
    write_table(pattern(grasps), targets[2], PATTERN_SCHEMA)


if __name__ == "__main__":
    with job(snakemake.log):
        if not snakemake.input.published or not snakemake.input.references:
            variables = "GRASPTYPES_PUBLISHED_CSV and GRASPTYPES_REFERENCE_MESHES"
            raise InputError(variables, "", "must name the published poses and the scans")
        derive_affinities(
            snakemake.input.published,
            load_hand(snakemake.params.hand["name"]),
            Path(snakemake.input.references[0]).parent,
            dict(zip(snakemake.params.objects, snakemake.input.surfaces, strict=True)),
            (
                snakemake.output.evidence,
                snakemake.output.summary,
                snakemake.output.pattern,
            ),
            snakemake.params.scale,
            ContactEvidenceSettings.check(snakemake.params.settings),
        )
