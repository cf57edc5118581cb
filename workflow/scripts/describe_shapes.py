"""The shapes of prepared objects, or of scans, in numbers."""

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

import trimesh

from grasptypes.jobs import job
from grasptypes.objects import solids
from grasptypes.objects.mesh_import import import_model
from grasptypes.objects.object_files import read_surface
from grasptypes.objects.preparation import joined, scaled_parts
from grasptypes.predictors.general_files import write_pictures
from grasptypes.predictors.general_shapes import describe_shapes
from grasptypes.settings.objects import ImportLimits, OwnObject
from grasptypes.settings.segmentation import SegmentationSettings


def meshes(
    surfaces: Sequence[str], scans: Mapping[str, str], limits: ImportLimits
) -> Iterator[tuple[str, trimesh.Trimesh]]:
    """Names and meshes of prepared objects by their surfaces, then of scans in metres."""
    for path in map(Path, surfaces):
        surface = read_surface(path)
        yield path.parent.name, trimesh.Trimesh(surface.vertices, surface.faces, process=False)
    for name, path in scans.items():
        found = import_model(OwnObject(file=path, unit="m", mass_kg=1.0), limits)
        solid = joined(scaled_parts(found.model, found.scale))
        yield name, trimesh.Trimesh(*solids.to_mesh(solid), process=False)


if __name__ == "__main__":
    with job(snakemake.log):
        params = snakemake.params
        limits = ImportLimits.check(params.settings)
        shown = meshes(snakemake.input.surfaces, params.scans, limits)
        shapes = describe_shapes(shown, SegmentationSettings.check(params.segmentation))
        write_pictures(snakemake.output.shapes, shapes)
