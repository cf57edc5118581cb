"""Reading the links of a URDF: collision shapes, what is seen, mass and inertia."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import manifold3d
import numpy as np
import trimesh
from numpy.typing import NDArray

from grasptypes.errors import InputError, parsing
from grasptypes.hands.links import ConvexPart, Link, Visual

Array = NDArray[np.float64]

# Corners of round primitives: a cylinder of 10 mm radius is off by 0.1 mm.
SEGMENTS = 24
_GREY = (0.4, 0.4, 0.42, 1.0)


class LinkReader:
    """Reads the links of a URDF.

    Args:
        path: of the URDF; meshes are named relative to its folder.
        robot: the URDF as yourdfpy reads it.
        frictions: of the links that state one.
    """

    def __init__(self, path: Path, robot: Any, frictions: Mapping[str, float]) -> None:
        self._path, self._folder = path, path.parent
        self._frictions = frictions
        self._links = {link.name: link for link in robot.links}
        self._materials = {material.name: material for material in robot.materials}
        self._mesh_of: dict[str, Path] = {}

    def read(self, name: str, members: list[tuple[str, Array]], T_urdf_link: Array | None) -> Link:
        """One link of the hand.

        Args:
            name: of the URDF link that moves.
            members: URDF links that are fixed to it, itself the first, and their poses in it.
            T_urdf_link: the hand's link in the URDF's (None: equal).
        """
        parts: list[ConvexPart] = []
        visuals: list[Visual] = []
        masses, centres, inertias = [], [], []
        for member, T in members:
            urdf_link = self._links[member]
            T_here = T if T_urdf_link is None else np.linalg.inv(T_urdf_link) @ T
            for number, shape in enumerate(urdf_link.collisions):
                parts.append(self._part(member, number, shape, T_here))
            for number, shape in enumerate(urdf_link.visuals):
                visuals.append(self._visual(member, number, shape, T_here))
            if urdf_link.inertial is not None and urdf_link.inertial.mass:
                origin = urdf_link.inertial.origin
                T_com = T_here @ (np.eye(4) if origin is None else np.asarray(origin))
                if urdf_link.inertial.inertia is None or not np.isfinite(T_com).all():
                    raise InputError(self._path, f"link {member}", "its inertial is incomplete")
                if not np.isfinite(urdf_link.inertial.inertia).all():
                    raise InputError(self._path, f"link {member}", "its inertia is not finite")
                masses.append(float(urdf_link.inertial.mass))
                centres.append(T_com[:3, 3])
                inertias.append(T_com[:3, :3] @ urdf_link.inertial.inertia @ T_com[:3, :3].T)
        if not masses or min(masses) <= 0:
            raise InputError(self._path, f"link {name}", "has no mass, or a negative one")
        if not parts:
            raise InputError(self._path, f"link {name}", "has no collision shape")
        mass = sum(masses)
        centre = np.average(centres, axis=0, weights=masses) if len(masses) > 1 else centres[0]
        inertia = np.zeros((3, 3))
        for m, c, moment in zip(masses, centres, inertias, strict=True):
            r = c - centre
            inertia = inertia + moment + m * (r @ r * np.eye(3) - np.outer(r, r))
        friction = self._frictions.get(name, 1.0)
        return Link(name, tuple(parts), tuple(visuals), mass, centre, inertia, friction)

    def _part(self, member: str, number: int, shape: Any, T: Array) -> ConvexPart:
        mesh_name, vertices, faces = self._shape(member, shape, T, exact_hull=True)
        return ConvexPart(mesh_name or f"{member}_{number}", vertices, faces)

    def _visual(self, member: str, number: int, shape: Any, T: Array) -> Visual:
        mesh_name, vertices, faces = self._shape(member, shape, T, exact_hull=False)
        material = shape.material
        known = self._materials.get(material.name) if material is not None else None
        colour = next((m.color for m in (material, known) if m is not None and m.color), None)
        rgba = tuple(map(float, colour.rgba)) if colour is not None else _GREY
        name = mesh_name or f"{member}_{number}"
        kind = material.name if material is not None and material.name else name
        return Visual(name, kind, rgba, vertices, faces)  # type: ignore[arg-type]

    def _shape(
        self, member: str, shape: Any, T: Array, exact_hull: bool
    ) -> tuple[str, Array, NDArray[np.int64]]:
        """Name (of a mesh file), vertices and faces of a shape in its link's frame."""
        geometry, name = shape.geometry, ""
        if geometry.mesh is not None:
            path = self._folder / geometry.mesh.filename
            if not path.is_file():
                raise InputError(
                    self._path, f"link {member}", f"{geometry.mesh.filename}: no such file"
                )
            with parsing(path, "cannot be read as a mesh"):
                mesh = trimesh.load_mesh(path, process=False, maintain_order=True)
            if not len(mesh.faces):
                raise InputError(path, "", "has no faces: a triangle mesh is needed")
            scale = geometry.mesh.scale
            vertices = np.asarray(mesh.vertices, dtype=np.float64)
            faces = np.asarray(mesh.faces, dtype=np.int64)
            if scale is not None:
                vertices = vertices * np.asarray(scale)
        else:
            solid = self._primitive(member, geometry)
            mesh64 = solid.to_mesh64()
            vertices, faces = mesh64.vert_properties[:, :3], mesh64.tri_verts.astype(np.int64)
        T_shape = T if shape.origin is None else T @ np.asarray(shape.origin)
        if np.array_equal(T_shape, np.eye(4)) and geometry.mesh is not None:
            # Links that share a mesh file share its name.
            known = self._mesh_of.setdefault(path.stem, path)
            name = path.stem if scale is None and known == path else ""
        else:
            vertices = vertices @ T_shape[:3, :3].T + T_shape[:3, 3]
        if exact_hull:
            vertices, faces = _convex(vertices, faces)
        return name, vertices, faces

    def _primitive(self, member: str, geometry: Any) -> manifold3d.Manifold:
        if geometry.box is not None:
            return manifold3d.Manifold.cube(tuple(map(float, geometry.box.size)), True)
        if geometry.cylinder is not None:
            radius, length = float(geometry.cylinder.radius), float(geometry.cylinder.length)
            return manifold3d.Manifold.cylinder(length, radius, radius, SEGMENTS, True)
        if geometry.sphere is not None:
            return manifold3d.Manifold.sphere(float(geometry.sphere.radius), SEGMENTS)
        raise InputError(self._path, f"link {member}", "has a shape of unknown kind")


def _convex(vertices: Array, faces: NDArray[np.int64]) -> tuple[Array, NDArray[np.int64]]:
    """The hull of a solid's corners; unchanged if they are all on it and it is closed."""
    hull = manifold3d.Manifold.hull_points(vertices)
    mesh = hull.to_mesh64()
    if len(mesh.vert_properties) == len(vertices) and len(mesh.tri_verts) == len(faces):
        return vertices, faces
    return mesh.vert_properties[:, :3], mesh.tri_verts.astype(np.int64)


def link_frictions(robot: ElementTree.Element) -> dict[str, float]:
    """Friction of the links that state one."""
    found = {}
    for link in robot.findall("link"):
        value = link.find("contact/lateral_friction")
        if value is not None:
            found[link.attrib["name"]] = float(value.attrib["value"])
    return found
