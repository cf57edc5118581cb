"""Sample points on the shapes of a group of kinds, with their descriptors and roles."""

from grasptypes.jobs import job
from grasptypes.kinds.names import shape_names
from grasptypes.segmentation.samples import sample_shapes
from grasptypes.settings.segmentation import SegmentationSettings

if __name__ == "__main__":
    with job(snakemake.log):
        settings = SegmentationSettings.check(snakemake.params.settings)
        shapes = settings.training.shapes
        names = [name for kind in snakemake.params.names for name in shape_names(kind, shapes)]
        sample_shapes(names, settings).write(snakemake.output.samples)
