"""Draw the population's contact maps of all objects and tasks, and one sheet of them all."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from grasptypes.contact_maps.contact_map_files import read_contact_map
from grasptypes.files import write_bytes
from grasptypes.jobs import job
from grasptypes.objects.object_files import read_surface
from grasptypes.renders.contact_pictures import contact_picture, studio_of
from grasptypes.renders.renderer import Camera, png_bytes
from grasptypes.reports.sheets import Group, Tile, sheet


def plot_contact_maps(
    maps: Mapping[tuple[str, str], str],
    surfaces: Mapping[str, str],
    targets: Mapping[tuple[str, str], str],
    whole: str | Path,
    renders: Mapping[str, Any],
    params: Mapping[str, Any],
) -> None:
    """Draw each map of (object, task) to its target, and all of them small to `whole`."""
    tiles = []
    studio = studio_of(renders, params["size_px"])
    with Camera(studio) as camera:
        for (name, task), path in maps.items():
            surface, contact = read_surface(surfaces[name]), read_contact_map(path)
            mesh = surface.vertices, surface.faces
            picture = contact_picture(contact, contact.probability, *mesh, camera, params)
            write_bytes(targets[name, task], png_bytes(picture, studio.png_compression))
            tiles.append(Tile(picture, f"{name}, {task}"))
    picture = sheet([Group("", tiles)], params["columns"], params["tile_px"])
    write_bytes(whole, png_bytes(picture, studio.png_compression))


if __name__ == "__main__":
    with job(snakemake.log):
        names = [tuple(name) for name in snakemake.params.names]
        plot_contact_maps(
            dict(zip(names, snakemake.input.contact_maps, strict=True)),
            dict(zip(snakemake.params.objects, snakemake.input.surfaces, strict=True)),
            dict(zip(names, snakemake.output.pictures, strict=True)),
            snakemake.output.sheet,
            snakemake.params.renders,
            snakemake.params.settings,
        )
