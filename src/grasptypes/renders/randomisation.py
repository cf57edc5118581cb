"""Images of objects as cameras in homes and workshops take them, for training.

Everything that says nothing about the object is drawn at random: viewpoint, lens, light, surfaces,
ground, what is in front, exposure, blur, noise and compression.
"""

from __future__ import annotations

import io
from collections.abc import Iterator, Sequence

import numpy as np
from PIL import Image
from scipy.ndimage import binary_erosion, gaussian_filter
from scipy.spatial.transform import Rotation

from grasptypes.renders.grounds import colour, ground, natural_noise
from grasptypes.renders.renderer import Camera
from grasptypes.renders.scene import Part, ground_light, recolour, surface_points, unit, viewpoints
from grasptypes.seeds import rng
from grasptypes.settings.general import ImageSettings, LensDraws, LightDraws, ViewDraws
from grasptypes.settings.renders import CameraSettings

# A camera pose (4, 4), T_object_camera, and the full angle of its image in rad.
View = tuple[np.ndarray, float]


def random_pictures(
    camera: Camera, parts: Sequence[Part], key: str, seed: int, settings: ImageSettings
) -> Iterator[bytes]:
    """JPEG files of an object; each image depends on the object's name and its own number.

    Args:
        key: name of the object.
        seed: of the workflow.
    """
    points = surface_points(parts, camera.settings.shadow_points, rng("shadow", key, seed))
    vertices = np.concatenate([part.vertices for part in parts])
    studio = _Studio(camera, parts)
    for number in range(settings.views):
        random = rng("random picture", key, number, seed)
        if random.random() < settings.plain:
            pose = viewpoints(vertices, 1, camera.settings, random)[0]
            taken = camera.compose(studio.plain(pose), points, pose)
            yield _jpeg(taken, settings.lens.jpeg_quality[1])
            continue
        view = draw_view(vertices, settings.view, camera.settings, random)
        picture, towards = studio.shot(view, settings.light, random)
        behind = ground(len(picture), settings.ground, random)
        if random.random() < settings.light.shadow:
            behind *= _shadow(points, view, towards, camera.settings)[..., None]
        yield _developed(_composed(picture, behind, settings.lens, random), settings.lens, random)


def _shadow(
    points: np.ndarray, view: View, towards: np.ndarray, settings: CameraSettings
) -> np.ndarray:
    """Share of light (size, size) on the ground, as in `renders` but for the first light."""
    first = settings.lights[0].changed(direction=tuple(towards))
    changed = settings.changed(lights=(first,), field_of_view_rad=view[1])
    return ground_light(points, view[0], changed)


def draw_view(
    vertices: np.ndarray, settings: ViewDraws, camera: CameraSettings, random: np.random.Generator
) -> View:
    """A camera pose and angle that show the object, most of them from above.

    Args:
        vertices: (V, 3) of the object in metres, which rests on its xy plane.
    """
    if random.random() < settings.any_side:
        rotation = Rotation.random(random_state=random)
    else:
        angles = random.uniform(-np.pi, np.pi), np.pi / 2 - random.uniform(*settings.elevation_rad)
        roll = random.uniform(-settings.roll_rad, settings.roll_rad)
        # The camera looks along -z, straight down: roll it, tilt it, turn it about the vertical.
        rotation = Rotation.from_euler("ZXZ", [*angles, roll])
    turn = rotation.as_matrix()
    centre = (vertices.min(axis=0) + vertices.max(axis=0)) / 2
    seen = (vertices - centre) @ turn
    angle_rad = random.uniform(*settings.field_of_view_rad)
    half = np.tan(angle_rad / 2)
    reach = np.abs(seen[:, :2]).max(axis=1) / (half * random.uniform(*settings.fill))
    radius_m = np.linalg.norm(seen, axis=1).max()
    distance_m = max((reach + seen[:, 2]).max(), camera.min_distance_radii * radius_m)
    sideways_m = random.uniform(-1, 1, 2) * settings.shift * half * distance_m
    pose = np.eye(4)
    pose[:3, :3] = turn
    pose[:3, 3] = centre + turn @ [*sideways_m, distance_m]
    return pose, angle_rad


class _Studio:
    """The scene of one object, whose camera, lights and materials change between images."""

    def __init__(self, camera: Camera, parts: Sequence[Part]) -> None:
        self._camera, self._parts = camera, parts
        self._scene, self._node, self._materials = camera.scene(parts)
        self._lights = sorted(self._scene.light_nodes, key=hash)

    def plain(self, T_object_camera: np.ndarray) -> np.ndarray:
        """Image (size, size, 4) in the light of `renders`, in the object's colours."""
        given = [light.intensity_lux for light in self._camera.settings.lights]
        towards = [np.array(light.direction) for light in self._camera.settings.lights]
        self._light(given, towards, self._camera.settings.ambient)
        self._cover(self._parts, 1.0)
        return self._shoot((T_object_camera, self._camera.settings.field_of_view_rad))

    def shot(
        self, view: View, settings: LightDraws, random: np.random.Generator
    ) -> tuple[np.ndarray, np.ndarray]:
        """Image (size, size, 4) in random light, and the direction (3,) of the first light."""
        lights = self._camera.settings.lights
        given = [light.intensity_lux * _between(settings.strength, random) for light in lights]
        spread = random.normal(0, settings.spread, (len(lights), 3))
        spread[:, 1] = -np.abs(spread[:, 1])  # from above
        towards = [unit(unit(light.direction) + s) for light, s in zip(lights, spread, strict=True)]
        self._light(given, towards, random.uniform(*settings.ambient))
        if random.random() < settings.colours:
            surfaces = recolour(self._parts, random.uniform(0, settings.moved), random)
            self._cover(surfaces, _between(settings.roughness, random))
        else:
            self._uncoloured(colour(random) / 255)
        return self._shoot(view), towards[0]

    def _light(
        self, strengths: Sequence[float], towards: Sequence[np.ndarray], ambient: float
    ) -> None:
        self._scene.ambient_light = (ambient,) * 3
        for node, strength, direction in zip(self._lights, strengths, towards, strict=True):
            node.light.intensity = strength
            pose = np.eye(4)
            turn, _ = Rotation.align_vectors([unit(direction)], [[0.0, 0.0, -1.0]])
            pose[:3, :3] = turn.as_matrix()
            self._scene.set_pose(node, pose)

    def _cover(self, parts: Sequence[Part], roughness: float) -> None:
        for material, part in zip(self._materials, parts, strict=True):
            material.baseColorFactor = (*part.base_colour, 1.0)
            material.metallicFactor = part.metallic
            material.roughnessFactor = min(1.0, part.roughness * roughness)

    def _uncoloured(self, rgb: np.ndarray) -> None:
        """All parts of one material, like a scan or a print."""
        for material in self._materials:
            material.baseColorFactor = (*(rgb**2.2), 1.0)
            material.metallicFactor, material.roughnessFactor = 0.0, 0.7

    def _shoot(self, view: View) -> np.ndarray:
        pose, angle_rad = view
        self._node.camera.yfov = angle_rad
        self._scene.set_pose(self._node, pose)
        return self._camera.shoot(self._scene)


def _composed(
    picture: np.ndarray, behind: np.ndarray, settings: LensDraws, random: np.random.Generator
) -> np.ndarray:
    """The object before its ground, and sometimes behind something: (size, size, 3) float32.

    Args:
        picture: (size, size, 4) uint8 on black, whose alpha is the coverage.
        behind: (size, size, 3) the ground, levels of 255.
    """
    coverage = picture[..., 3:] * np.float32(1 / 255)
    whole = picture[..., :3] + behind * (1 - coverage)
    if random.random() < settings.hidden:
        size_px = len(picture)
        cover = cover_of(coverage[..., 0] > 0.5, settings, random)
        before = np.tile(colour(random), (size_px, size_px, 1))
        before += random.uniform(0, 25) * natural_noise(size_px, 1.2, random)[..., None]
        whole = np.where(cover[..., None], before, whole)
    return np.asarray(whole, dtype=np.float32)


def cover_of(shown: np.ndarray, settings: LensDraws, random: np.random.Generator) -> np.ndarray:
    """Where an ellipse on the edge of the object is (size, size); nowhere if it hides too much.

    Args:
        shown: (size, size) where the object is.
    """
    size_px = len(shown)
    rows, columns = np.nonzero(shown & ~binary_erosion(shown))
    if not len(rows):
        return np.zeros_like(shown)
    place = random.integers(len(rows))
    down, across = np.ogrid[:size_px, :size_px]
    angle = random.uniform(0, np.pi)
    first, second = size_px * random.uniform(*settings.cover, 2)
    x, y = across - columns[place], down - rows[place]
    along, beside = x * np.cos(angle) + y * np.sin(angle), y * np.cos(angle) - x * np.sin(angle)
    cover = (along / first) ** 2 + (beside / second) ** 2 < 1
    hidden = (cover & shown).sum() / shown.sum()
    return np.asarray(cover & (hidden <= settings.most_hidden))


def _developed(whole: np.ndarray, settings: LensDraws, random: np.random.Generator) -> bytes:
    """The JPEG file of an image (size, size, 3) float32, exposed, blurred and noisy."""
    balance = np.exp(random.normal(0, settings.white_balance, 3))
    levels = whole * balance * _between(settings.exposure, random) / 255
    levels = np.clip(levels, 0, 1) ** _between(settings.contrast, random)
    blur_px = random.uniform(*settings.blur_px)
    levels = gaussian_filter(levels, (blur_px, blur_px, 0))
    levels += random.normal(0, random.uniform(*settings.noise) / 255, levels.shape)
    quality = int(random.integers(*settings.jpeg_quality, endpoint=True))
    return _jpeg((np.clip(levels, 0, 1) * 255 + 0.5).astype(np.uint8), quality)


def _jpeg(picture: np.ndarray, quality: int) -> bytes:
    buffer = io.BytesIO()
    Image.fromarray(picture).save(buffer, "JPEG", quality=quality)
    return buffer.getvalue()


def _between(limits: tuple[float, float], random: np.random.Generator) -> float:
    """A factor between two limits, uniform in its logarithm."""
    return float(np.exp(random.uniform(*np.log(limits))))
