"""An object as the viewer shows it: in its materials, by parts, and with its contact maps."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

import numpy as np
import trimesh
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from grasptypes.errors import InputError, parsing
from grasptypes.objects.object_files import Surface
from grasptypes.renders.scene import material_of

Array = NDArray[np.float64]

# Points of a contact map that a vertex takes its value from: those next to it on its own side.
NEIGHBOURS = 8
# Colour, metallic and roughness of what has no material.
GREY = ((0.6, 0.6, 0.6), 0.0, 0.7)


class ShownPart(NamedTuple):
    """A part: its name, role (empty without one), material and mesh in metres."""

    name: str
    role: str
    colour: tuple[float, float, float]
    metallic: float
    roughness: float
    mesh: trimesh.Trimesh


@dataclass(frozen=True)
class ShownObject:
    """An object.

    Attributes:
        parts: in the order of its file.
        surface: evenly meshed, for the contact maps; None if there are none.
        maps: (V,) contact probability at the surface's vertices, by task.
    """

    name: str
    parts: list[ShownPart]
    surface: Surface | None
    maps: dict[str, Array]

    @property
    def mesh(self) -> trimesh.Trimesh:
        """All parts as one mesh."""
        whole = trimesh.util.concatenate([part.mesh for part in self.parts])
        assert isinstance(whole, trimesh.Trimesh)
        return whole


def load_shown_object(
    name: str,
    visual: Path,
    surface: Surface | None,
    maps: Mapping[str, Sequence[NDArray[np.float32]]],
    roles: Mapping[str, str],
) -> ShownObject:
    """Read an object's GLB.

    Args:
        maps: points (N, 3), normals (N, 3) and probability (N,) of each task's contact map.
        roles: role of each part that has one.

    Raises:
        InputError: the file is missing, or is no mesh.
    """
    if not visual.is_file():
        raise InputError(visual, "", f"is missing: {name} cannot be shown")
    with parsing(visual, "cannot be read as a mesh"):
        scene = trimesh.load_scene(visual, process=False)
    parts = []
    for node in scene.graph.nodes_geometry:
        T_object_node, key = scene.graph[node]
        mesh = scene.geometry[key].copy().apply_transform(T_object_node)
        part = str(key).rsplit("_", 1)[0] if key not in roles else str(key)
        *colour, metallic, roughness = material_of(mesh)
        red, green, blue = colour
        look = (red, green, blue), metallic, roughness
        parts.append(ShownPart(part, roles.get(part, ""), *look, mesh))
    if surface is None:
        return ShownObject(name, parts, None, {})
    values = {task: vertex_values(surface, *each) for task, each in maps.items()}
    return ShownObject(name, parts, surface, values)


def surface_parts(
    surface: Surface, roles: Mapping[str, str], seen: Sequence[ShownPart] = ()
) -> list[ShownPart]:
    """A surface cut into its parts.

    Args:
        roles: role of each part that has one.
        seen: the object in its materials; a part takes that which is nearest to most of it. Without
            any, parts are grey.
    """
    # That of two of its corners at least, if three parts do not meet there.
    owner = np.median(surface.part_index[surface.faces], axis=1).astype(int)
    tree, material_at = None, np.empty(0, dtype=int)
    if seen:
        tree = cKDTree(np.concatenate([part.mesh.triangles_center for part in seen]))
        material_at = np.repeat(np.arange(len(seen)), [len(part.mesh.faces) for part in seen])
    parts = []
    for number, name in enumerate(map(str, surface.part_names)):
        if not (owner == number).any():
            continue
        mesh = trimesh.Trimesh(surface.vertices, surface.faces[owner == number], process=False)
        mesh.remove_unreferenced_vertices()
        look = GREY
        if tree is not None:
            near = material_at[tree.query(mesh.triangles_center)[1]]
            most = seen[int(np.bincount(near).argmax())]
            look = most.colour, most.metallic, most.roughness
        parts.append(ShownPart(name, roles.get(name, ""), *look, mesh))
    return parts


def vertex_values(
    surface: Surface,
    points: NDArray[np.float32],
    point_normals: NDArray[np.float32],
    probability: NDArray[np.float32],
) -> Array:
    """Values (V,) of a map's points (N, 3) at the vertices of a surface.

    Points on the other side of a wall do not count.
    """
    normals = trimesh.Trimesh(surface.vertices, surface.faces, process=False).vertex_normals
    distance, near = cKDTree(points).query(surface.vertices, min(NEIGHBOURS, len(points)))
    facing = np.einsum("vkj,vj->vk", point_normals[near], normals)
    weight = np.clip(facing, 1e-6, None) / (distance**2 + 1e-9)
    return np.asarray((weight * probability[near]).sum(1) / weight.sum(1))
