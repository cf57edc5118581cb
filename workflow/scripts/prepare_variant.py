"""Prepare a variant of a catalogue object: write its files."""

from pathlib import Path

from grasptypes.jobs import job
from grasptypes.kinds.variation import build_variant
from grasptypes.objects.parts import ImportedModel
from grasptypes.objects.preparation import prepare
from grasptypes.settings.objects import Resolution, VariationRanges

if __name__ == "__main__":
    with job(snakemake.log):
        name, settings = snakemake.wildcards.object, snakemake.params.settings
        ranges = VariationRanges.check(settings["variation"])
        model = build_variant(name, ranges, snakemake.params.seed)
        folder = Path(snakemake.output.properties).parent
        resolution = Resolution.check(settings["resolution"])
        prepare(name, ImportedModel(model, settings["scale"]), resolution, folder)
