"""Rendering of objects; the only module that imports pyrender and OpenGL.

A process that also uses torch must import torchvision before it creates a :class:`Camera`: Mesa and
torch's compiler each load an LLVM, and the process crashes if torch's is loaded second.
"""

from __future__ import annotations

import io
import logging
import os
from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from PIL import Image

from grasptypes.renders.gl_platform import PLATFORM_VARIABLE, choose_platform
from grasptypes.renders.scene import Part, ground_light, recolour, surface_points, viewpoints
from grasptypes.seeds import rng

if TYPE_CHECKING:
    import pyrender

LOGGER = logging.getLogger("grasptypes")


@dataclass(frozen=True)
class Studio:
    """How images are rendered; the fields are the keys of the ``renders`` section of params.yaml.

    Attributes:
        size_px: height and width of an image.
        field_of_view_rad: full angle of the image.
        fill: share of half the image that the object reaches.
        min_distance_radii: closest camera distance in radii of the object.
        colour_randomisation: 0 keeps the materials' colours, 1 draws new ones for every view.
        ambient: linear ambient light.
        lights: one mapping per light: ``intensity_lux`` and ``direction`` (3,), in which the light
            travels in the camera frame. The first is the key light, which casts the shadow.
        background_rgb: (3,) 8-bit colour of the ground at the centre of the image.
        vignette: share by which the ground is darker in the corners.
        ground_elevation_rad: angle at which the camera looks down on the ground.
        shadow_strength: share of the light that the deepest shadow removes; 0 disables the shadow.
        shadow_softness_px: standard deviation of the shadow's blur.
        shadow_fading: the highest point casts exp(-fading) of the lowest point's shadow.
        shadow_points: surface points that cast the shadow.
        png_compression: zlib level, 0 to 9.
    """

    size_px: int
    field_of_view_rad: float
    fill: float
    min_distance_radii: float
    colour_randomisation: float
    ambient: float
    lights: Sequence[Mapping[str, Any]]
    background_rgb: Sequence[int]
    vignette: float
    ground_elevation_rad: float
    shadow_strength: float
    shadow_softness_px: float
    shadow_fading: float
    shadow_points: int
    png_compression: int


class Camera:
    """An off-screen OpenGL context and a studio, used for any number of objects.

    The context, the shader programs and the scene of an object are created once and reused for all
    its views: only poses and colours change between images.
    """

    def __init__(self, studio: Studio) -> None:
        self.platform = choose_platform()
        # PyOpenGL reads the variable only at its first import.
        os.environ[PLATFORM_VARIABLE] = self.platform
        import pyrender

        self._pyrender = pyrender
        self.studio = studio
        self._renderer = pyrender.OffscreenRenderer(studio.size_px, studio.size_px)
        self._background = _background(studio)
        LOGGER.info("rendering through %s", self.platform)

    def __enter__(self) -> Camera:
        return self

    def __exit__(self, *_: object) -> None:
        self._renderer.delete()

    def views(self, parts: Sequence[Part], count: int, key: str, seed: int) -> Views:
        """``count`` random views of an object, determined by ``key`` and ``seed``."""
        studio = self.studio
        vertices = np.concatenate([part.vertices for part in parts])
        T_object_camera = viewpoints(
            vertices,
            count,
            studio.field_of_view_rad,
            studio.fill,
            studio.min_distance_radii,
            rng("viewpoints", key, seed),
        )
        return Views(self, parts, T_object_camera, key, seed)

    def scene(self, parts: Sequence[Part]) -> tuple[pyrender.Scene, pyrender.Node, list[Any]]:
        """The object with lights that move with the camera: scene, camera node, materials."""
        pyrender, studio = self._pyrender, self.studio
        scene = pyrender.Scene(bg_color=(0, 0, 0, 0), ambient_light=(studio.ambient,) * 3)
        materials = [_material(pyrender, part) for part in parts]
        primitives = [
            pyrender.Primitive(part.vertices, part.normals, indices=part.faces, material=material)
            for part, material in zip(parts, materials, strict=True)
        ]
        scene.add(pyrender.Mesh(primitives))
        diagonal_m = float(scene.scale)
        lens = pyrender.PerspectiveCamera(
            studio.field_of_view_rad, znear=diagonal_m / 50, zfar=diagonal_m * 50, aspectRatio=1.0
        )
        camera = scene.add(lens)
        for number, light in enumerate(studio.lights):
            lamp = pyrender.DirectionalLight(intensity=light["intensity_lux"])
            pose = _looking_along(np.array(light["direction"]))
            scene.add_node(_numbered_node(pyrender, number, lamp, pose), parent_node=camera)
        return scene, camera, materials

    def shoot(self, scene: pyrender.Scene) -> np.ndarray:
        """Image of the scene on black: (size, size, 4) uint8, alpha is the coverage."""
        colour, depth_m = self._renderer.render(scene, self._pyrender.RenderFlags.RGBA)
        if colour.shape[-1] == 4:
            return colour
        # With OSMesa, pyrender gives neither alpha nor anti-aliasing.
        return np.dstack([colour, np.where(depth_m > 0, 255, 0).astype(np.uint8)])

    def compose(
        self, picture: np.ndarray, points: np.ndarray, T_object_camera: np.ndarray
    ) -> np.ndarray:
        """Compose an image of :meth:`shoot` with the ground and shadow: (size, size, 3) uint8."""
        studio = self.studio
        ground = (255 - picture[..., 3]) * np.float32(1 / 255)
        if studio.shadow_strength > 0:
            ground *= ground_light(
                points,
                T_object_camera,
                studio.size_px,
                studio.field_of_view_rad,
                studio.ground_elevation_rad,
                _unit(studio.lights[0]["direction"]),
                studio.shadow_softness_px,
                studio.shadow_strength,
                studio.shadow_fading,
            )
        colour = self._background * ground[..., None]
        colour += picture[..., :3]
        colour += np.float32(0.5)
        return np.minimum(colour, 255, out=colour).astype(np.uint8)


class Views:
    """The views of one object: camera poses at once, images on demand.

    Attributes:
        T_object_camera: (N, 4, 4).
    """

    def __init__(
        self,
        camera: Camera,
        parts: Sequence[Part],
        T_object_camera: np.ndarray,
        key: str,
        seed: int,
    ) -> None:
        self._camera, self._parts, self._key, self._seed = camera, parts, key, seed
        self.T_object_camera = T_object_camera

    def pictures(self) -> Iterator[np.ndarray]:
        """Images in order, (size, size, 3) uint8 each."""
        return self._finished(self._camera.compose)

    def pngs(self) -> Iterator[bytes]:
        """The images as PNG files, in order."""
        level = self._camera.studio.png_compression
        return self._finished(lambda *view: png_bytes(self._camera.compose(*view), level))

    def _finished(self, finish: Any) -> Iterator[Any]:
        """Run ``finish`` on each image while the next view is drawn."""
        count = self._camera.studio.shadow_points
        points = surface_points(self._parts, count, rng("shadow", self._key, self._seed))
        with ThreadPoolExecutor(max_workers=1) as pool:
            pending = None
            for picture, pose in zip(self._drawn(), self.T_object_camera, strict=True):
                if pending is not None:
                    yield pending.result()
                pending = pool.submit(finish, picture, points, pose)
            if pending is not None:
                yield pending.result()

    def _drawn(self) -> Iterator[np.ndarray]:
        amount = self._camera.studio.colour_randomisation
        colours = rng("colours", self._key, self._seed)
        scene, node, materials = self._camera.scene(self._parts)
        for pose in self.T_object_camera:
            scene.set_pose(node, pose)
            if amount > 0:
                coloured = recolour(self._parts, amount, colours)
                for material, part in zip(materials, coloured, strict=True):
                    material.baseColorFactor = (*part.base_colour, 1.0)
            yield self._camera.shoot(scene)


def png_bytes(picture: np.ndarray, compression: int) -> bytes:
    """PNG file of a (H, W, 3) uint8 image."""
    buffer = io.BytesIO()
    Image.fromarray(picture).save(buffer, "PNG", compress_level=compression)
    return buffer.getvalue()


def _background(studio: Studio) -> np.ndarray:
    """(size, size, 3) float32: the empty ground, darker towards the corners."""
    axis = np.linspace(-1, 1, studio.size_px, dtype=np.float32)
    falloff = (axis[:, None] ** 2 + axis[None, :] ** 2) / 2
    shade = 1 - np.float32(studio.vignette) * falloff
    return shade[..., None] * np.asarray(studio.background_rgb, dtype=np.float32)


def _numbered_node(pyrender: Any, number: int, light: Any, pose: np.ndarray) -> Any:
    """A light node with a fixed position in the order of lights.

    pyrender keeps lights in sets, whose order depends on memory addresses; in another order their
    sum is rounded differently, and a pixel may come out one level brighter.
    """

    class NumberedNode(pyrender.Node):
        def __hash__(self) -> int:
            return number

    return NumberedNode(light=light, matrix=pose)


def _material(pyrender: Any, part: Part) -> Any:
    return pyrender.MetallicRoughnessMaterial(
        baseColorFactor=(*part.base_colour, 1.0),
        metallicFactor=part.metallic,
        roughnessFactor=part.roughness,
        doubleSided=True,
    )


def _unit(vector: Sequence[float] | np.ndarray) -> np.ndarray:
    return np.asarray(vector, dtype=float) / np.linalg.norm(vector)


def _looking_along(direction: np.ndarray) -> np.ndarray:
    """Pose (4, 4) whose -z axis points along ``direction``."""
    z = -_unit(direction)
    x = _unit(np.cross((0.0, 1.0, 0.0), z) if abs(z[1]) < 0.99 else (1.0, 0.0, 0.0))
    pose = np.eye(4)
    pose[:3, 0], pose[:3, 1], pose[:3, 2] = x, np.cross(z, x), z
    return pose
