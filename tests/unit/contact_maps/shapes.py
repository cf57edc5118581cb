"""Objects of simple solids with roles, whose places and sizes are known."""

import numpy as np
import trimesh

from grasptypes.contact_maps.contact_map import sample_surface
from grasptypes.contact_maps.places import HeldObject
from grasptypes.objects.object_files import Surface
from grasptypes.settings.roles import PartRole


def held_object(parts, mass_kg=0.3, centre_of_mass_m=(0.0, 0.0, 0.0), points=1500):
    """An object from (name, role or None, attributes, trimesh) rows."""
    meshes, owners = [], []
    for index, (*_, mesh) in enumerate(parts):
        fine = trimesh.Trimesh(*trimesh.remesh.subdivide_to_size(mesh.vertices, mesh.faces, 0.01))
        meshes.append(fine)
        owners.append(np.full(len(fine.vertices), index, dtype=np.int16))
    whole = trimesh.util.concatenate(meshes)
    names = np.array([name for name, *_ in parts])
    sampled = sample_surface(
        Surface(whole.vertices, whole.faces, np.concatenate(owners), names), points, 1
    )
    roles = {
        name: PartRole(role=role, attributes=attributes) if role else None
        for name, role, attributes, _ in parts
    }
    return HeldObject(
        sampled.points_m,
        sampled.normals,
        sampled.part_index,
        roles,
        mass_kg,
        np.array(centre_of_mass_m),
    )


def box(size_m, centre_m=(0.0, 0.0, 0.0)):
    """A block."""
    return trimesh.creation.box(size_m).apply_translation(centre_m)


def rod(radius_m, length_m, centre_m=(0.0, 0.0, 0.0)):
    """A cylinder along z."""
    return trimesh.creation.cylinder(radius_m, length_m, sections=32).apply_translation(centre_m)


def mallet(mass_kg=0.5, attributes=()):
    """A handle from z = 0 to 0.2 m below a block of 0.1 x 0.06 x 0.06 m, whose middle is heavy."""
    handle = rod(0.014, 0.2, (0.0, 0.0, 0.1))
    head = box((0.1, 0.06, 0.06), (0.0, 0.0, 0.23))
    parts = [("handle", "handle", (), handle), ("head", "head", attributes, head)]
    return held_object(parts, mass_kg, (0.0, 0.0, 0.21))
