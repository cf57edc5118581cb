"""Prepare a catalogue object or a user's own mesh: write its files."""

from pathlib import Path

from grasptypes.jobs import job
from grasptypes.kinds.catalogue import build
from grasptypes.objects.grid_limit import limited
from grasptypes.objects.mesh_import import import_model
from grasptypes.objects.parts import ImportedModel
from grasptypes.objects.preparation import prepare
from grasptypes.settings.objects import ImportLimits, OwnObject, Resolution

if __name__ == "__main__":
    with job(snakemake.log):
        name, settings = snakemake.wildcards.object, snakemake.params.settings
        resolution = Resolution.check(settings["resolution"])
        if "own" in settings:
            limits = ImportLimits.check(settings["import"])
            own = import_model(OwnObject.check(settings["own"]), limits)
            found, resolution = limited(own, resolution, limits)
        else:
            found = ImportedModel(build(name), settings["scale"])
        prepare(name, found, resolution, Path(snakemake.output.properties).parent)
