"""A user's own mesh: read, checked, repaired and turned into an object model."""

from __future__ import annotations

import logging
from pathlib import Path

from grasptypes.errors import InputError
from grasptypes.objects.bodies import BODY, assembled, closed_bodies, concatenated, tidied
from grasptypes.objects.leaky_meshes import rebuilt
from grasptypes.objects.mesh_files import read_meshes
from grasptypes.objects.mesh_limits import check_size, check_volume
from grasptypes.objects.parts import ImportedModel, ObjectModel, Part
from grasptypes.objects.surface_colours import GREY, joined
from grasptypes.objects.units import UNITS_M
from grasptypes.settings.objects import ImportLimits, OwnObject

LOGGER = logging.getLogger("grasptypes")


def import_model(own: OwnObject, limits: ImportLimits) -> ImportedModel:
    """Make a model of a user's mesh; what was repaired or ignored is logged.

    Args:
        limits: what the mesh must meet.

    Raises:
        InputError: the mesh cannot be used; the message says why.
    """
    path, unit, scale = own.file, own.unit, own.scale
    repairs: list[str] = []
    meshes, face_colours = read_meshes(Path(path), limits, repairs)
    pieces = [piece for some in meshes.values() for piece in some]
    for piece in pieces:
        piece.apply_scale(UNITS_M[unit])
    check_size(path, pieces, unit, scale, limits)
    bodies, cavities = closed_bodies(meshes, repairs), None
    if bodies:
        found, cavities = assembled(bodies, repairs)
    else:
        solid, spacing_m = rebuilt(path, tidied(concatenated(pieces), []), limits)
        found = {BODY: solid}
        repairs.append(
            f"closed holes by rebuilding the surface at {1e3 * scale * spacing_m:.1f} mm"
        )
    for name in own.parts:
        if name not in found:
            message = f"has no part '{name}'; its parts: {', '.join(found)}"
            raise InputError(path, "", message)
    colours = joined([piece.triangles for piece in pieces], face_colours, limits.colour_cells)
    material = colours.material()
    parts = tuple(
        Part(name, solid, material or GREY, role=own.parts.get(name))
        for name, solid in found.items()
    )
    check_volume(path, sum(part.solid.volume() for part in parts), pieces, limits)
    if cavities is not None and own.shell_thickness_m is not None:
        message = (
            "shell_thickness_m is for meshes of the outside only, but this mesh has a cavity and "
            "thus walls of its own: leave it out"
        )
        raise InputError(path, "", message)
    # With a given mass any density will do: the inertia is scaled to the mass.
    density = own.density_kg_m3 or 1e3
    model = ObjectModel(
        parts, density, own.shell_thickness_m, cavities, None if material else colours
    )
    repairs = list(dict.fromkeys(repairs))
    for repair in repairs:
        LOGGER.warning("%s: %s", path, repair)
    return ImportedModel(model, scale, own.mass_kg, tuple(repairs))
