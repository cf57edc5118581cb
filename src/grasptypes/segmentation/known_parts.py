"""What is known about an object's parts: what somebody said, or what its shape tells."""

from __future__ import annotations

import re
from collections.abc import Mapping

import numpy as np

from grasptypes.contact_maps.placement import SurfacePoints
from grasptypes.objects.object_geometry import ObjectGeometry
from grasptypes.segmentation.parts import Parts, find_parts
from grasptypes.settings.roles import PartRole, read_roles
from grasptypes.settings.segmentation import SegmentationSettings

# Where roles come from; in plan.json and in what `inspect` prints.
DESCRIBED, NAMED = "its description", "the names of its parts"


def known_parts(
    geometry: ObjectGeometry,
    points: SurfacePoints,
    settings: SegmentationSettings,
    said: Mapping[str, PartRole] | None = None,
) -> Parts:
    """The parts of an object at points on its surface.

    What somebody says counts before what the object's file says, and that before the shape.

    Args:
        points: with the part of `geometry.surface` that each belongs to, in random order.
        said: roles of parts by name.
    """
    names = [str(name) for name in geometry.surface.part_names]
    described = {name: PartRole.check(role) for name, role in geometry.properties.roles.items()}
    named = {name: PartRole.check({"role": role}) for name in names if (role := role_in_name(name))}
    for roles, basis in ((said or {}, DESCRIBED), (described, DESCRIBED), (named, NAMED)):
        if roles:
            known = {name: roles.get(name) for name in names}
            return Parts(np.asarray(points.part_index), known, dict.fromkeys(names, 1.0), basis)
    return find_parts(points.points_m, points.normals, settings)


def role_in_name(name: str) -> str | None:
    """The role that a part's name states, such as handle, Handle.001 or blade_2; None if it states
    none."""
    word = re.sub(r"[._ -]*\d*$", "", name).lower().replace(" ", "_").replace("-", "_")
    return word if word in read_roles().roles else None
