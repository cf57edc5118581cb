"""Inspect YCB objects: a sheet of the roles and contact maps of each, and a table of the parts."""

import json
from pathlib import Path

import pandas as pd

from grasptypes.errors import InputError
from grasptypes.files import write_bytes
from grasptypes.inspection.inspection import inspect_object
from grasptypes.inspection.pictures import inspection_tiles
from grasptypes.jobs import job
from grasptypes.objects.loading import load_object
from grasptypes.renders.contact_pictures import plain
from grasptypes.renders.renderer import Camera, png_bytes
from grasptypes.reports.kind_sizes import MASSES, YCB
from grasptypes.reports.sheets import Group, sheet
from grasptypes.segmentation.evaluation import FOUND_SCHEMA
from grasptypes.segmentation.parts import described
from grasptypes.settings.params import Params
from grasptypes.tables import write_table


def inspect_all(folder: Path, names: list[str], params: Params) -> tuple[pd.DataFrame, bytes]:
    """The table, and the PNG of the sheet."""
    masses_kg = json.loads((folder / MASSES).read_text(encoding="utf-8"))
    settings = params.contact_pictures
    studio = plain(params.renders, settings.size_px)
    rows, groups = [], []
    with Camera(studio) as camera:
        for name in names:
            mesh = folder / "ycb" / name / "textured.obj"
            geometry = load_object(
                mesh, mass_kg=masses_kg.get(name), name=name, settings=params.objects
            )
            found = inspect_object(geometry, list(params.tasks), params)
            rows.append({"object": name, "found": described(found.parts)})
            groups.append(Group("", inspection_tiles(found, camera, settings)))
    picture = sheet(groups, 1 + len(params.tasks), settings.tile_px)
    return pd.DataFrame(rows), png_bytes(picture, studio.png_compression)


if __name__ == "__main__":
    with job(snakemake.log):
        given = snakemake.params
        folder = Path(given.folder)
        if not folder.is_dir():
            raise InputError(YCB, "", "must name a checkout of elpis-lab/YCB_Dataset")
        table, picture = inspect_all(folder, given.names, Params.check(given.params))
        write_table(table, snakemake.output.table, FOUND_SCHEMA)
        write_bytes(snakemake.output.sheet, picture)
