"""Draw the population's contact maps of all objects and tasks, and a sheet of all of them."""

from collections.abc import Mapping
from pathlib import Path

from grasptypes.contact_maps.contact_map_files import read_contact_map
from grasptypes.files import write_bytes
from grasptypes.jobs import job
from grasptypes.objects.object_files import read_surface
from grasptypes.renders.contact_pictures import contact_picture, plain
from grasptypes.renders.renderer import Camera, png_bytes
from grasptypes.reports.sheets import Group, Tile, sheet
from grasptypes.settings.renders import CameraSettings, ContactPictureSettings


def plot_contact_maps(
    maps: Mapping[tuple[str, str], str],
    surfaces: Mapping[str, str],
    targets: Mapping[tuple[str, str], str],
    whole: str | Path,
    renders: CameraSettings,
    settings: ContactPictureSettings,
) -> None:
    """Draw each map of (object, task) to its target, and all of them to the sheet `whole`."""
    tiles = []
    plainly = plain(renders, settings.size_px)
    with Camera(plainly) as camera:
        for (name, task), path in maps.items():
            surface, contact = read_surface(surfaces[name]), read_contact_map(path)
            picture = contact_picture(contact, contact.probability, surface, camera, settings)
            write_bytes(targets[name, task], png_bytes(picture, plainly.png_compression))
            tiles.append(Tile(picture, f"{name}, {task}"))
    picture = sheet([Group("", tiles)], settings.columns, settings.tile_px)
    write_bytes(whole, png_bytes(picture, plainly.png_compression))


if __name__ == "__main__":
    with job(snakemake.log):
        names = [tuple(name) for name in snakemake.params.names]
        plot_contact_maps(
            dict(zip(names, snakemake.input.contact_maps, strict=True)),
            dict(zip(snakemake.params.objects, snakemake.input.surfaces, strict=True)),
            dict(zip(names, snakemake.output.pictures, strict=True)),
            snakemake.output.sheet,
            CameraSettings.check(snakemake.params.renders),
            ContactPictureSettings.check(snakemake.params.settings),
        )
