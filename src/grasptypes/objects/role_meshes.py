"""Meshes with the role of every face: ground truth for the segmentation of parts."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import trimesh

from grasptypes.objects import solids
from grasptypes.objects.parts import Part
from grasptypes.objects.preparation import face_parts, joined
from grasptypes.settings.roles import read_roles

# Faces of parts without a role.
NO_ROLE = -1


def role_mesh(parts: Sequence[Part]) -> bytes:
    """A binary PLY of the surface (metres), with two properties of each face.

    `role` is the place of the part's role in roles.yaml, from 0, or :data:`NO_ROLE`; `part` is the
    place of the part among the object's parts.

    Args:
        parts: scaled, see :func:`grasptypes.objects.preparation.scaled_parts`.
    """
    solid = joined(list(parts))
    owners = face_parts(solid, list(parts)).astype(np.int32)
    order = list(read_roles().roles)
    roles = [order.index(part.role.role) if part.role else NO_ROLE for part in parts]
    mesh = trimesh.Trimesh(*solids.to_mesh(solid), process=False)
    mesh.face_attributes["role"] = np.array(roles, dtype=np.int32)[owners]
    mesh.face_attributes["part"] = owners
    return bytes(trimesh.exchange.ply.export_ply(mesh, include_attributes=True))
