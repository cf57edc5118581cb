"""Images of a real scan, taken as `predict` takes them of a mesh."""

import tempfile
from pathlib import Path

from grasptypes.files import write_bytes, zip_bytes
from grasptypes.jobs import job
from grasptypes.objects.mesh_import import import_model
from grasptypes.objects.preparation import visual_glb
from grasptypes.renders.mesh_views import views
from grasptypes.renders.renderer import png_bytes
from grasptypes.settings.objects import ImportLimits, OwnObject
from grasptypes.settings.renders import CameraSettings


def picture_scan(
    scan: str, target: str, count: int, crease_deg: float, how: tuple[ImportLimits, CameraSettings]
) -> None:
    """Write an archive of the images of a scan in metres; its mass does not show."""
    found = import_model(OwnObject(file=scan, unit="m", mass_kg=1.0), how[0])
    with tempfile.TemporaryDirectory() as folder:
        visual = Path(folder) / "visual.glb"
        visual.write_bytes(visual_glb(found, crease_deg))
        taken = views(visual, how[1], count)
    level = how[1].png_compression
    members = {f"{number:03d}.png": png_bytes(view, level) for number, view in enumerate(taken)}
    write_bytes(target, zip_bytes(members))


if __name__ == "__main__":
    with job(snakemake.log):
        params = snakemake.params
        picture_scan(
            params.scan,
            snakemake.output.pictures,
            params.views,
            params.crease_deg,
            (ImportLimits.check(params.settings), CameraSettings.check(params.camera)),
        )
