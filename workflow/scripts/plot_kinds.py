"""Draw the contact sheet of a group of kinds."""

from grasptypes.files import write_bytes
from grasptypes.jobs import job
from grasptypes.renders.contact_pictures import plain
from grasptypes.renders.renderer import Camera, png_bytes
from grasptypes.reports.kind_sheets import kind_sheet
from grasptypes.settings.kinds import KindSheetSettings
from grasptypes.settings.renders import CameraSettings

if __name__ == "__main__":
    with job(snakemake.log):
        params = snakemake.params
        sheet = KindSheetSettings.check(params.sheet)
        renders = plain(CameraSettings.check(params.renders), sheet.size_px)
        with Camera(renders) as camera:
            whole = kind_sheet(params.names, camera, sheet, params.crease_deg)
        write_bytes(snakemake.output.sheet, png_bytes(whole, renders.png_compression))
