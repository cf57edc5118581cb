"""Sample points on the shapes of a group of kinds, with their descriptors and roles."""

from grasptypes.jobs import job
from grasptypes.kinds.names import shape_names
from grasptypes.segmentation.samples import sample_shapes
from grasptypes.settings.segmentation import DescriptorSettings, RoleSampleSettings

if __name__ == "__main__":
    with job(snakemake.log):
        params = snakemake.params
        settings = RoleSampleSettings.check(params.settings)
        names = [name for kind in params.names for name in shape_names(kind, settings.shapes)]
        described = DescriptorSettings.check(params.descriptors)
        sample_shapes(names, described, settings).write(snakemake.output.samples)
