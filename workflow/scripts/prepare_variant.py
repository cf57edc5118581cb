"""Build a variant of an object of the catalogue and write its files."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from grasptypes.jobs import job
from grasptypes.objects.preparation import Resolution, prepare
from grasptypes.objects.variation import build_variant


def prepare_variant(name: str, settings: Mapping[str, Any], seed: int, folder: Path) -> None:
    """Write a variant's files to a folder; `settings` is the section `objects`."""
    model = build_variant(name, settings["variation"], seed)
    resolution = Resolution(**settings["resolution"])
    prepare(name, model, settings["scale"], resolution, folder)


if __name__ == "__main__":
    with job(snakemake.log):
        prepare_variant(
            snakemake.wildcards.object,
            snakemake.params.settings,
            snakemake.params.seed,
            Path(snakemake.output.properties).parent,
        )
