"""What is known about an object's parts: what somebody said, or what its shape tells."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence

import numpy as np
from scipy.spatial import cKDTree

from grasptypes.contact_maps.placement import SurfacePoints
from grasptypes.errors import InputError
from grasptypes.objects.object_geometry import ObjectGeometry
from grasptypes.objects.surface_colours import encoded
from grasptypes.renders.scene import load_parts
from grasptypes.segmentation.parts import Parts, find_parts
from grasptypes.segmentation.role_files import RoleTable
from grasptypes.settings.roles import PartRole, read_roles
from grasptypes.settings.segmentation import PartSettings

# Where roles come from; in plan.json and in what `inspect` prints.
DESCRIBED, NAMED = "its description", "the names of its parts"
# The part of all colours that a user does not list.
OTHER = "other"


def known_parts(
    geometry: ObjectGeometry,
    points: SurfacePoints,
    settings: PartSettings,
    said: RoleTable | None = None,
) -> Parts:
    """The parts of an object at points on its surface.

    What a user says counts before what the object's file says, and that before the shape.

    Args:
        points: with the part of `geometry.surface` that each belongs to, in random order.

    Raises:
        InputError: the user speaks of a part that the object does not have.
    """
    if said and said.by_colour:
        return _coloured_parts(geometry, points, said, settings.same_colour)
    names = [str(name) for name in geometry.surface.part_names]
    if said:
        for name in said.roles:
            if name not in names:
                message = f"{geometry.name} has no part '{name}'; its parts: {', '.join(names)}"
                raise InputError(said.path, name, message)
        return _named_parts(points, names, said.roles, said.path.name)
    if roles := geometry.properties.roles:
        described = {name: PartRole.check(role) for name, role in roles.items()}
        return _named_parts(points, names, described, DESCRIBED)
    if stated := {name: role for name in names if (role := role_in_name(name))}:
        return _named_parts(points, names, stated, NAMED)
    return find_parts(points.points_m, points.normals, settings)


def _named_parts(
    points: SurfacePoints, names: Sequence[str], roles: Mapping[str, PartRole], basis: str
) -> Parts:
    known = {name: roles.get(name) for name in names}
    return Parts(np.asarray(points.part_index), known, dict.fromkeys(names, 1.0), basis)


def _coloured_parts(
    geometry: ObjectGeometry, points: SurfacePoints, said: RoleTable, same: int
) -> Parts:
    """Parts by the colours of the object's file; other colours have no role.

    Args:
        same: largest difference between levels of the same colour.
    """
    seen = load_parts(geometry.visual)
    linear = [
        part.base_colour * (np.ones_like(part.vertices) if part.tints is None else part.tints)
        for part in seen
    ]
    vertices = np.concatenate([part.vertices for part in seen])
    nearest = cKDTree(vertices).query(points.points_m)[1]
    levels = 255 * encoded(np.clip(np.concatenate(linear), 0, 1))[nearest]
    listed = np.array([[int(name[at : at + 2], 16) for at in (1, 3, 5)] for name in said.roles])
    difference = np.abs(levels[:, None] - listed).max(axis=2)
    index = np.where(difference.min(axis=1) <= same, difference.argmin(axis=1), len(listed))
    for number, name in enumerate(said.roles):
        if not (index == number).any():
            raise InputError(said.path, name, f"nothing on {geometry.name} has this colour")
    roles: dict[str, PartRole | None] = dict(said.roles)
    if (index == len(listed)).any():
        roles[OTHER] = None
    return Parts(index.astype(np.int16), roles, dict.fromkeys(roles, 1.0), said.path.name)


def role_in_name(name: str) -> PartRole | None:
    """The role that a part's name states, such as handle, Handle.001 or blade_2, if any."""
    word = re.sub(r"[._ -]*\d*$", "", name).lower().replace(" ", "_").replace("-", "_")
    return PartRole.check({"role": word}) if word in read_roles().roles else None
