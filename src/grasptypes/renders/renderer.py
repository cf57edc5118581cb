"""Rendering of objects; the only module that imports pyrender and OpenGL.

A process that also uses torch must import torchvision before it creates a :class:`Camera`: Mesa and
torch's compiler each load an LLVM, and the process crashes if torch's is loaded second.
"""

from __future__ import annotations

import io
import logging
import os
from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from typing import TYPE_CHECKING, Any

import numpy as np
from PIL import Image

from grasptypes.renders.gl_platform import PLATFORM_VARIABLE, choose_platform
from grasptypes.renders.scene import Part, ground_light, recolour, surface_points, unit, viewpoints
from grasptypes.seeds import rng
from grasptypes.settings.renders import CameraSettings

if TYPE_CHECKING:
    import pyrender

LOGGER = logging.getLogger("grasptypes")


class Camera:
    """An off-screen OpenGL context, used for any number of objects.

    The context, the shader programs and the scene of an object are created once and reused for all
    its views: only poses and colours change between images.
    """

    def __init__(self, settings: CameraSettings) -> None:
        self.platform = choose_platform()
        # PyOpenGL reads the variable only at its first import.
        os.environ[PLATFORM_VARIABLE] = self.platform
        import pyrender

        self._pyrender = pyrender
        self.settings = settings
        self._renderer = pyrender.OffscreenRenderer(settings.size_px, settings.size_px)
        self._background = _background(settings)
        LOGGER.info("rendering through %s", self.platform)

    def __enter__(self) -> Camera:
        return self

    def __exit__(self, *_: object) -> None:
        self._renderer.delete()

    def views(self, parts: Sequence[Part], count: int, key: str, seed: int) -> Views:
        """``count`` random views of an object; the same ones for the same ``key`` and ``seed``."""
        vertices = np.concatenate([part.vertices for part in parts])
        T_object_camera = viewpoints(vertices, count, self.settings, rng("viewpoints", key, seed))
        return Views(self, parts, T_object_camera, key, seed)

    def scene(self, parts: Sequence[Part]) -> tuple[pyrender.Scene, pyrender.Node, list[Any]]:
        """The object, lit by lights that travel with the camera: scene, camera node, materials."""
        pyrender, settings = self._pyrender, self.settings
        scene = pyrender.Scene(bg_color=(0, 0, 0, 0), ambient_light=(settings.ambient,) * 3)
        materials = [_material(pyrender, part) for part in parts]
        primitives = [
            pyrender.Primitive(
                part.vertices,
                part.normals,
                color_0=part.tints,
                indices=part.faces,
                material=material,
            )
            for part, material in zip(parts, materials, strict=True)
        ]
        scene.add(pyrender.Mesh(primitives))
        diagonal_m = float(scene.scale)
        lens = pyrender.PerspectiveCamera(
            settings.field_of_view_rad, znear=diagonal_m / 50, zfar=diagonal_m * 50, aspectRatio=1.0
        )
        camera = scene.add(lens)
        for number, light in enumerate(settings.lights):
            lamp = pyrender.DirectionalLight(intensity=light.intensity_lux)
            pose = _looking_along(np.array(light.direction))
            scene.add_node(_numbered_node(pyrender, number, lamp, pose), parent_node=camera)
        return scene, camera, materials

    def shoot(self, scene: pyrender.Scene) -> np.ndarray:
        """Image of the scene on black: (size, size, 4) uint8, alpha is the coverage."""
        colour: np.ndarray
        colour, depth_m = self._renderer.render(scene, self._pyrender.RenderFlags.RGBA)
        if colour.shape[-1] == 4:
            return colour
        # With OSMesa, pyrender gives neither alpha nor anti-aliasing.
        return np.dstack([colour, np.where(depth_m > 0, 255, 0).astype(np.uint8)])

    def compose(
        self, picture: np.ndarray, points: np.ndarray, T_object_camera: np.ndarray
    ) -> np.ndarray:
        """Compose an image of :meth:`shoot` with the ground and shadow: (size, size, 3) uint8."""
        ground = (255 - picture[..., 3]) * np.float32(1 / 255)
        if self.settings.shadow_strength > 0:
            ground *= ground_light(points, T_object_camera, self.settings)
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
        level = self._camera.settings.png_compression
        return self._finished(lambda *view: png_bytes(self._camera.compose(*view), level))

    def _finished(self, finish: Any) -> Iterator[Any]:
        """Run ``finish`` on each image while the next view is drawn."""
        count = self._camera.settings.shadow_points
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
        amount = self._camera.settings.colour_randomisation
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


def _background(settings: CameraSettings) -> np.ndarray:
    """(size, size, 3) float32: the empty ground, darker towards the corners."""
    axis = np.linspace(-1, 1, settings.size_px, dtype=np.float32)
    falloff = (axis[:, None] ** 2 + axis[None, :] ** 2) / 2
    shade = 1 - np.float32(settings.vignette) * falloff
    return shade[..., None] * np.asarray(settings.background_rgb, dtype=np.float32)


def _numbered_node(pyrender: Any, number: int, light: Any, pose: np.ndarray) -> Any:
    """A light node with a fixed position in the order of lights.

    pyrender keeps lights in sets, whose order depends on memory addresses; in another order their
    sum is rounded differently, and a pixel may come out one level brighter.
    """

    base: type[Any] = pyrender.Node

    class NumberedNode(base):  # type: ignore[misc]
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


def _looking_along(direction: np.ndarray) -> np.ndarray:
    """Pose (4, 4) whose -z axis points along ``direction``."""
    z = -unit(direction)
    x = unit(np.cross((0.0, 1.0, 0.0), z) if abs(z[1]) < 0.99 else (1.0, 0.0, 0.0))
    pose = np.eye(4)
    pose[:3, 0], pose[:3, 1], pose[:3, 2] = x, np.cross(z, x), z
    return pose
