"""Images of contact maps on their objects, from two sides."""

from __future__ import annotations

import numpy as np
import trimesh
from matplotlib import colormaps
from numpy.typing import ArrayLike, NDArray
from scipy.spatial import cKDTree

from grasptypes.contact_maps.contact_map import ContactMap
from grasptypes.objects.object_files import Surface
from grasptypes.renders.renderer import Camera
from grasptypes.renders.scene import Part
from grasptypes.settings.renders import CameraSettings, ContactPictureSettings

Array = NDArray[np.float64]

LEVELS = 24


def plain(renders: CameraSettings, size_px: int) -> CameraSettings:
    """The same for plain pictures: the materials' own colours, no shadow."""
    return renders.changed(size_px=size_px, colour_randomisation=0.0, shadow_strength=0.0)


def contact_picture(
    contact_map: ContactMap,
    contact: ArrayLike,
    surface: Surface,
    camera: Camera,
    settings: ContactPictureSettings,
) -> NDArray[np.uint8]:
    """A contact on an object, from the two opposite directions of the settings, side by side.

    Args:
        contact: (N,) values at the map's points, 0 to 1; scaled to their largest for the colours.

    Returns:
        (H, 2 H, 3) image.
    """
    parts = _coloured_parts(contact_map, np.asarray(contact), surface, settings.edge_m)
    scene, node, _ = camera.scene(parts)
    points = np.concatenate([part.vertices for part in parts])
    sides = []
    for turn in (0.0, np.pi):
        pose = look_at(points, settings.azimuth_rad + turn, settings.elevation_rad, camera.settings)
        scene.set_pose(node, pose)
        sides.append(camera.compose(camera.shoot(scene), points, pose))
    return np.hstack(sides)


def look_at(
    points: Array, azimuth_rad: float, elevation_rad: float, settings: CameraSettings
) -> Array:
    """T_object_camera (4, 4) of an upright camera (z up) that frames points (N, 3)."""
    back = np.array(
        [
            np.cos(elevation_rad) * np.cos(azimuth_rad),
            np.cos(elevation_rad) * np.sin(azimuth_rad),
            np.sin(elevation_rad),
        ]
    )
    right = np.array([-np.sin(azimuth_rad), np.cos(azimuth_rad), 0.0])
    rotation = np.column_stack([right, np.cross(back, right), back])
    centre = (points.min(axis=0) + points.max(axis=0)) / 2
    seen = (points - centre) @ rotation
    opening = settings.fill * np.tan(settings.field_of_view_rad / 2)
    distance_m = float((np.abs(seen[:, :2]).max(axis=1) / opening + seen[:, 2]).max())
    pose = np.eye(4)
    pose[:3, :3], pose[:3, 3] = rotation, centre + distance_m * back
    return pose


def _coloured_parts(
    contact_map: ContactMap, contact: Array, surface: Surface, edge_m: float
) -> list[Part]:
    """The mesh cut into pieces of nearly the same contact, each with its colour."""
    fine, triangles = trimesh.remesh.subdivide_to_size(
        surface.vertices, surface.faces, edge_m, max_iter=20
    )[:2]
    mesh = trimesh.Trimesh(fine, triangles, process=False)
    centres, normals = mesh.triangles_center, mesh.face_normals
    # Points on the other side of a thin wall are as close, so only those facing the same way count.
    weight_m = 0.01
    tree = cKDTree(np.hstack([contact_map.points, weight_m * contact_map.normals]))
    distance, nearest = tree.query(np.hstack([centres, weight_m * normals]), k=4)
    weight = 1.0 / (distance + 1e-4)
    value = np.sum(weight * contact[nearest], axis=1) / weight.sum(axis=1)
    level = np.minimum((value / max(float(contact.max()), 1e-9) * LEVELS).astype(int), LEVELS - 1)
    colours = colormaps["turbo"](np.linspace(0.08, 0.95, LEVELS))[:, :3] ** 2.2
    parts = []
    for number in np.unique(level):
        chosen = mesh.faces[level == number]
        corners = mesh.vertices[chosen].reshape(-1, 3)
        facing = np.repeat(normals[level == number], 3, axis=0)
        triangles = np.arange(len(corners)).reshape(-1, 3)
        parts.append(Part(corners, facing, triangles, colours[number], 0.0, 0.9))
    return parts
