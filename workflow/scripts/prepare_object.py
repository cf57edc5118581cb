"""Build one object of the catalogue, or a user's own mesh, and write its files."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from grasptypes.jobs import job
from grasptypes.objects.catalogue import OBJECTS
from grasptypes.objects.mesh_import import ImportedModel, ImportLimits, import_model
from grasptypes.objects.preparation import Resolution, prepare


def find_model(name: str, settings: Mapping[str, Any]) -> ImportedModel:
    """Return the model of a name: the user's mesh if the settings hold a block `own`."""
    if "own" in settings:
        return import_model(settings["own"], ImportLimits(**settings["import"]))
    return ImportedModel(OBJECTS[name](), settings["scale"], mass_kg=None, repairs=())


def prepare_object(name: str, settings: Mapping[str, Any], folder: Path) -> tuple[str, ...]:
    """Write an object's files to a folder; returns what was repaired."""
    found = find_model(name, settings)
    resolution = Resolution(**settings["resolution"])
    prepare(name, found.model, found.scale, resolution, folder, found.mass_kg, found.repairs)
    return found.repairs


if __name__ == "__main__":
    with job(snakemake.log) as log:
        repairs = prepare_object(
            snakemake.wildcards.object,
            snakemake.params.settings,
            Path(snakemake.output.properties).parent,
        )
        for repair in repairs:
            log.warning("%s: %s", snakemake.input.own, repair)
