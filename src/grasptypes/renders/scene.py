"""What is rendered: the parts of an object, viewpoints around it, and the ground below it.

Camera frames follow OpenGL: x right, y up, the camera looks along -z.
"""

from __future__ import annotations

import colorsys
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import trimesh
from numpy.typing import ArrayLike
from PIL import Image
from scipy.ndimage import gaussian_filter
from scipy.spatial.transform import Rotation

from grasptypes.errors import InputError, parsing
from grasptypes.settings.renders import CameraSettings

# Relative luminance of linear RGB (ITU-R BT.709).
_LUMINANCE = np.array([0.2126, 0.7152, 0.0722])


@dataclass(frozen=True)
class Part:
    """All faces of an object that share a physically based material.

    Attributes:
        vertices: (V, 3) in metres, object frame.
        normals: (V, 3) unit vertex normals.
        faces: (F, 3) vertex indices.
        base_colour: (3,) linear RGB in [0, 1].
        metallic: glTF metallic factor in [0, 1].
        roughness: glTF roughness factor in [0, 1].
        tints: (V, 3) factor on the base colour at each vertex; None if it is the same everywhere.
    """

    vertices: np.ndarray
    normals: np.ndarray
    faces: np.ndarray
    base_colour: np.ndarray
    metallic: float
    roughness: float
    tints: np.ndarray | None = None


def load_parts(path: str | Path) -> list[Part]:
    """The parts of a GLB file, one per material, in the order of the file.

    Materials are treated as opaque: transparent glass would show little but its background.

    Raises:
        InputError: the file is missing, is not a mesh, or has no faces.
    """
    with parsing(path, "cannot be read as a mesh"):
        scene = trimesh.load_scene(path, process=False)
    grouped: dict[tuple[float, ...], list[trimesh.Trimesh]] = {}
    for node in scene.graph.nodes_geometry:
        T_object_node, name = scene.graph[node]
        mesh = scene.geometry[name]
        if isinstance(mesh, trimesh.Trimesh) and len(mesh.faces):
            placed = mesh.copy().apply_transform(T_object_node)
            placed.visual = mesh.visual  # its copy has no vertex colours
            grouped.setdefault(material_of(mesh), []).append(placed)
    if not grouped:
        raise InputError(path, "", "has no faces")
    return [_part(material, meshes) for material, meshes in grouped.items()]


def material_of(mesh: trimesh.Trimesh) -> tuple[float, ...]:
    """Base colour (linear RGB), metallic and roughness factors of a mesh, each 0 to 1."""
    material = getattr(mesh.visual, "material", None)
    if not isinstance(material, trimesh.visual.material.PBRMaterial):
        plain = getattr(mesh.visual, "main_color", np.array([180, 180, 180]))
        return (*(np.asarray(plain[:3]) / 255.0), 0.0, 0.6)
    colour = (255, 255, 255, 255) if material.baseColorFactor is None else material.baseColorFactor
    metallic = 1.0 if material.metallicFactor is None else material.metallicFactor
    roughness = 1.0 if material.roughnessFactor is None else material.roughnessFactor
    return (*(np.asarray(colour[:3]) / 255.0), float(metallic), float(roughness))


def _part(material: tuple[float, ...], meshes: Sequence[trimesh.Trimesh]) -> Part:
    colours = np.concatenate([_vertex_colours(mesh) for mesh in meshes])
    # The base colour is the mean one, which recolouring replaces.
    mean = np.maximum(colours.mean(axis=0), 1e-3)
    offsets = np.cumsum([0] + [len(mesh.vertices) for mesh in meshes])
    return Part(
        vertices=np.concatenate([mesh.vertices for mesh in meshes]),
        normals=np.concatenate([mesh.vertex_normals for mesh in meshes]),
        faces=np.concatenate([mesh.faces + k for mesh, k in zip(meshes, offsets, strict=False)]),
        base_colour=np.array(material[:3]) * mean,
        metallic=material[3],
        roughness=material[4],
        tints=None if (colours == mean).all() else colours / mean,
    )


def _vertex_colours(mesh: trimesh.Trimesh) -> np.ndarray:
    """Linear colours (V, 3) of the vertices; white where the file has none."""
    colours = getattr(mesh.visual, "vertex_attributes", {}).get("color")
    if colours is None:
        return np.ones((len(mesh.vertices), 3))
    return np.asarray(colours[:, :3], dtype=float) / 255


def recolour(parts: Sequence[Part], amount: float, rng: np.random.Generator) -> list[Part]:
    """The parts with each colour moved towards a random one of the same luminance.

    Luminance is kept, because images encode the task in their brightness.

    Args:
        amount: 0 keeps the materials' colours, 1 replaces them.
    """
    colours = []
    for part in parts:
        luminance = float(_LUMINANCE @ part.base_colour)
        colour = np.array(colorsys.hsv_to_rgb(*rng.uniform((0, 0.1, 1), (1, 0.9, 1))))
        colour *= luminance / (_LUMINANCE @ colour)
        # A colour that would exceed white in a channel is mixed with grey until it does not.
        excess = colour.max() - luminance
        share = min(1.0, (1 - luminance) / excess) if excess > 0 else 0.0
        colours.append(luminance + share * (colour - luminance))
    return [
        replace(part, base_colour=(1 - amount) * part.base_colour + amount * colour)
        for part, colour in zip(parts, colours, strict=True)
    ]


def viewpoints(
    vertices: np.ndarray, count: int, settings: CameraSettings, rng: np.random.Generator
) -> np.ndarray:
    """Camera poses uniform on the sphere, randomly rolled, at distances that frame the object.

    The smallest distance keeps a view along a handle from being distorted.

    Args:
        vertices: (V, 3) points of the object in metres.

    Returns:
        (count, 4, 4) T_object_camera.
    """
    centre = (vertices.min(axis=0) + vertices.max(axis=0)) / 2
    offsets = vertices - centre
    radius_m = float(np.linalg.norm(offsets, axis=1).max())
    R_object_camera = Rotation.random(count, rng).as_matrix()
    in_camera = np.einsum("vi,nij->nvj", offsets, R_object_camera)
    seen = settings.fill * np.tan(settings.field_of_view_rad / 2)
    framing_m = (np.abs(in_camera[..., :2]).max(axis=-1) / seen + in_camera[..., 2]).max(axis=1)
    distance_m = np.maximum(framing_m, settings.min_distance_radii * radius_m)
    T_object_camera = np.tile(np.eye(4), (count, 1, 1))
    T_object_camera[:, :3, :3] = R_object_camera
    T_object_camera[:, :3, 3] = centre + R_object_camera[:, :, 2] * distance_m[:, None]
    return T_object_camera


def surface_points(parts: Sequence[Part], count: int, rng: np.random.Generator) -> np.ndarray:
    """(count, 3) points uniform over the surface, in metres, object frame."""
    triangles = np.concatenate([part.vertices[part.faces] for part in parts])
    edges = triangles[:, 1:] - triangles[:, :1]
    areas = np.linalg.norm(np.cross(edges[:, 0], edges[:, 1]), axis=1)
    chosen = rng.choice(len(triangles), count, p=areas / areas.sum())
    weights = np.sort(rng.random((count, 2)), axis=1)
    first, second = weights[:, :1], weights[:, 1:] - weights[:, :1]
    return np.asarray(triangles[chosen, 0] + first * edges[chosen, 0] + second * edges[chosen, 1])


def ground_light(
    points: np.ndarray, T_object_camera: np.ndarray, settings: CameraSettings
) -> np.ndarray:
    """Share of light that reaches the ground in each pixel when the object rests on it.

    The camera looks down at the ground plane, which touches the object's lowest point. Each point
    casts its shadow along the first light, fainter the higher it is.

    Args:
        points: (N, 3) surface points, object frame, metres.
        T_object_camera: (4, 4).

    Returns:
        (size, size) float32 from 1 - ``shadow_strength`` to 1.
    """
    elevation_rad, size_px = settings.ground_elevation_rad, settings.size_px
    light_direction = unit(settings.lights[0].direction)
    up = np.array([0.0, np.cos(elevation_rad), np.sin(elevation_rad)])
    in_camera = (points - T_object_camera[:3, 3]) @ T_object_camera[:3, :3]
    height_m = in_camera @ up
    height_m -= height_m.min()
    shadow = in_camera + np.outer(height_m / -(light_direction @ up), light_direction)
    cells = size_px // 4  # a soft shadow needs no finer raster
    scale = cells / (2 * np.tan(settings.field_of_view_rad / 2))
    column = cells / 2 + scale * shadow[:, 0] / -shadow[:, 2]
    row = cells / 2 - scale * shadow[:, 1] / -shadow[:, 2]
    weight = np.exp(-settings.shadow_fading * height_m / height_m.max())
    # A margin as wide as the raster keeps shadows cast from outside the image.
    place = np.clip(np.floor([row, column]).astype(int) + cells, 0, 3 * cells - 1)
    counts = np.bincount(place[0] * 3 * cells + place[1], weight, (3 * cells) ** 2)
    raster = counts.reshape(3 * cells, 3 * cells).astype(np.float32)
    raster[[0, -1]] = raster[:, [0, -1]] = 0  # where everything farther away was clipped to
    # Blur only what can reach the image: up to four standard deviations.
    blur_cells = settings.shadow_softness_px / 4
    reach = min(int(np.ceil(4 * blur_cells)) + 1, cells)
    seen = slice(cells - reach, 2 * cells + reach)
    blurred = gaussian_filter(raster[seen, seen], blur_cells, truncate=4)
    blurred = blurred[reach : reach + cells, reach : reach + cells]
    usual = float(blurred.sum() / max((blurred > blurred.max() / 10).sum(), 1)) + 1e-9
    light = 1 - settings.shadow_strength * (1 - np.exp(-2.0 * blurred / usual))
    coarse = Image.fromarray(light.astype(np.float32))
    return np.asarray(coarse.resize((size_px, size_px), Image.Resampling.BILINEAR))


def unit(vector: ArrayLike) -> np.ndarray:
    """A vector (3,) scaled to length 1."""
    return np.asarray(np.asarray(vector, dtype=float) / np.linalg.norm(vector))
