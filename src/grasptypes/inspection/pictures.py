"""Images of an inspection: the parts in the colours of their roles, and where people hold them for
each task."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from matplotlib import colormaps
from matplotlib.colors import to_hex
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from grasptypes.contact_maps.placement import SurfacePoints
from grasptypes.inspection.inspection import Inspection
from grasptypes.objects.object_files import Surface
from grasptypes.renders.contact_pictures import contact_picture, look_at, plain
from grasptypes.renders.renderer import Camera, png_bytes
from grasptypes.renders.scene import Part
from grasptypes.reports.sheets import Group, Tile, sheet
from grasptypes.segmentation.parts import Parts
from grasptypes.settings.params import Params
from grasptypes.settings.roles import read_roles

Array = NDArray[np.float64]

# Parts without a role.
GREY = (0.6, 0.6, 0.6)
# Weight of a difference between normals against metres: points on the other side of a wall are far
# away.
NORMAL_M = 0.01


def inspection_png(inspection: Inspection, params: Params) -> bytes:
    """PNG of the object in the colours of its roles, and of the contact map of each task, from two
    sides."""
    settings, surface = params.contact_pictures, inspection.geometry.surface
    studio = plain(params.renders, settings.size_px)
    with Camera(studio) as camera:
        views = [
            both_sides(
                coloured_parts(inspection), camera, settings.azimuth_rad, settings.elevation_rad
            )
        ]
        captions = [", ".join(dict.fromkeys(role_of(inspection.parts).values()))]
        for each in inspection.tasks:
            if each.contact_map:
                contact_map = each.contact_map
                views.append(
                    contact_picture(contact_map, contact_map.probability, surface, camera, settings)
                )
                grip, part, share = each.shares()[0]
                captions.append(f"{each.task}: {share:.0%} {grip} {part}")
    tiles = [Tile(view, caption) for view, caption in zip(views, captions, strict=True)]
    picture = sheet([Group(inspection.geometry.name, tiles)], len(tiles), settings.size_px)
    return png_bytes(picture, studio.png_compression)


def both_sides(
    parts: list[Part], camera: Camera, azimuth_rad: float, elevation_rad: float
) -> NDArray[np.uint8]:
    """Parts from two opposite directions, (H, 2 H, 3)."""
    scene, node, _ = camera.scene(parts)
    points = np.concatenate([part.vertices for part in parts])
    sides = []
    for turn in (0.0, np.pi):
        pose = look_at(points, azimuth_rad + turn, elevation_rad, camera.settings)
        scene.set_pose(node, pose)
        sides.append(camera.compose(camera.shoot(scene), points, pose))
    return np.hstack(sides)


def role_of(parts: Parts) -> Mapping[str, str]:
    """Name of the role of each part by name; empty without one."""
    return {name: part.role if part else "" for name, part in parts.roles.items()}


def role_colours() -> dict[str, tuple[float, float, float]]:
    """An sRGB colour for each role; neighbours in roles.yaml, such as parts made for the hand,
    look alike."""
    roles = list(read_roles().roles)
    shades = colormaps["gist_rainbow"](np.linspace(0, 1, len(roles)))[:, :3]
    return {role: tuple(shade) for role, shade in zip(roles, shades.tolist(), strict=True)}


def face_parts(
    surface: Surface, points: SurfacePoints, part_index: NDArray[np.int16]
) -> NDArray[np.int16]:
    """Part (F,) of each face of a surface: that of the nearest point (N,) that faces the same
    way."""
    corners = surface.vertices[surface.faces]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-30)
    tree = cKDTree(np.hstack([points.points_m, NORMAL_M * points.normals]))
    return np.asarray(
        part_index[tree.query(np.hstack([corners.mean(axis=1), NORMAL_M * normals]))[1]]
    )


def coloured_parts(inspection: Inspection) -> list[Part]:
    """The object's surface cut by parts, each in the colour of its role."""
    surface, parts = inspection.geometry.surface, inspection.parts
    of_face, colours = (
        face_parts(surface, inspection.drawn.points, parts.part_index),
        role_colours(),
    )
    found = []
    for number, role in enumerate(role_of(parts).values()):
        corners = surface.vertices[surface.faces[of_face == number]]
        if len(corners):
            normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
            normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-30)
            triangles = np.arange(3 * len(corners)).reshape(-1, 3)
            colour = np.array(colours.get(role, GREY)) ** 2.2
            found.append(
                Part(
                    corners.reshape(-1, 3),
                    np.repeat(normals, 3, axis=0),
                    triangles,
                    colour,
                    0.0,
                    0.9,
                )
            )
    return found


def legend(parts: Parts) -> dict[str, str]:
    """Hex colour of each role that the parts have."""
    return {
        role: to_hex(colour)
        for role, colour in role_colours().items()
        if role in role_of(parts).values()
    }
