"""A user's mesh as an object that grasps can be planned for."""

from __future__ import annotations

import shutil
import tempfile
import weakref
from dataclasses import replace
from pathlib import Path

from grasptypes.errors import InputError
from grasptypes.objects.grid_limit import limited
from grasptypes.objects.mesh_import import import_model
from grasptypes.objects.object_geometry import ObjectGeometry
from grasptypes.objects.preparation import prepare
from grasptypes.objects.units import UNITS_M
from grasptypes.settings.objects import ObjectSettings, OwnObject
from grasptypes.settings.params import checkout_params

WATER_KG_M3 = 1000.0


def load_object(
    path: str | Path,
    unit: str = "m",
    *,
    mass_kg: float | None = None,
    scale: float = 1.0,
    name: str | None = None,
    settings: ObjectSettings | None = None,
) -> ObjectGeometry:
    """Read a mesh, repair it where possible, and prepare it for planning and prediction.

    The prepared files exist as long as the object; `properties.repairs` lists the repairs.

    Args:
        path: an STL, OBJ, PLY or GLB file.
        unit: its length unit: m, cm, mm or inch.
        mass_kg: mass of the object; default: that of a solid of water.
        scale: size to prepare it at, relative to the file.
        name: name of the object; default: that of the file.
        settings: limits and resolution; default: from params.yaml in the current folder, else
            those that come with the package.

    Raises:
        InputError: the mesh cannot be used; the message says why.
    """
    own = own_object(path, unit, mass_kg).changed(scale=scale)
    objects = settings or checkout_params().objects
    imported = import_model(own, objects.import_)
    imported, resolution = limited(imported, objects.resolution, objects.import_)
    folder = Path(tempfile.mkdtemp(prefix="grasptypes-"))
    try:
        made = prepare(name or Path(path).stem, imported, resolution, folder)
    except BaseException:
        shutil.rmtree(folder)
        raise
    geometry = replace(made, source=str(path))
    weakref.finalize(geometry, shutil.rmtree, folder, ignore_errors=True)
    return geometry


def own_object(path: str | Path, unit: str, mass_kg: float | None = None) -> OwnObject:
    """A user's mesh as described by a block `objects.own.<name>` of params.yaml.

    Raises:
        InputError: an unknown unit, or a mass that is not positive.
    """
    if unit not in UNITS_M:
        raise InputError("unit", str(unit), f"unknown; allowed: {', '.join(UNITS_M)}")
    weight = {"density_kg_m3": WATER_KG_M3} if mass_kg is None else {"mass_kg": mass_kg}
    return OwnObject.check({"file": str(path), "unit": unit, **weight}, path)
