"""Pictures: the same every time, the object in the middle, the ground around it."""

import io

import numpy as np
import pytest
import trimesh
from PIL import Image

from grasptypes.errors import InputError
from grasptypes.renders.gl_platform import choose_platform
from grasptypes.renders.renderer import Camera
from grasptypes.renders.scene import Part
from grasptypes.settings.renders import CameraSettings

SETTINGS = {
    "size_px": 64,
    "field_of_view_rad": 0.6,
    "fill": 0.8,
    "min_distance_radii": 2.6,
    "colour_randomisation": 0.0,
    "ambient": 0.3,
    "lights": [{"intensity_lux": 3.0, "direction": [0.5, -0.9, -0.7]}],
    "background_rgb": [240, 240, 240],
    "vignette": 0.0,
    "ground_elevation_rad": 0.8,
    "shadow_strength": 0.4,
    "shadow_softness_px": 3,
    "shadow_fading": 3.0,
    "shadow_points": 500,
    "png_compression": 3,
}


def ball(colour):
    mesh = trimesh.creation.icosphere(3, 0.05)
    return Part(mesh.vertices, mesh.vertex_normals, mesh.faces, np.array(colour), 0.0, 0.6)


def pictures(settings, colour=(0.8, 0.05, 0.05), count=2):
    with Camera(CameraSettings.check(settings)) as camera:
        return list(camera.views([ball(colour)], count, "ball", 0).pictures())


def test_the_object_is_in_the_middle_and_the_ground_around_it():
    for picture in pictures(SETTINGS):
        assert picture.shape == (64, 64, 3)
        assert picture.dtype == np.uint8
        red, green, _ = picture[32, 32].astype(int)
        assert red > 2 * green
        np.testing.assert_array_equal(picture[0, 0], [240, 240, 240])


def test_the_shadow_darkens_the_ground_only():
    plain = pictures(SETTINGS | {"shadow_strength": 0.0})[0].astype(int)
    shaded = pictures(SETTINGS)[0].astype(int)
    np.testing.assert_array_equal(shaded[32, 32], plain[32, 32])
    assert (shaded - plain).max() == 0
    assert (shaded - plain).min() < -40


def test_the_same_bytes_again_and_other_views_for_another_seed():
    with Camera(CameraSettings.check(SETTINGS)) as camera:
        first = list(camera.views([ball((0.2, 0.5, 0.2))], 3, "ball", 0).pngs())
        again = list(camera.views([ball((0.2, 0.5, 0.2))], 3, "ball", 0).pngs())
        other = camera.views([ball((0.2, 0.5, 0.2))], 3, "ball", 1).T_object_camera
        poses = camera.views([ball((0.2, 0.5, 0.2))], 3, "ball", 0).T_object_camera
    assert first == again
    assert len(set(first)) == 3
    assert Image.open(io.BytesIO(first[0])).size == (64, 64)
    assert not np.allclose(other, poses)


def test_lights_shine_in_the_order_they_are_stated_in():
    stated = [float(number) for number in range(1, 7)]
    lights = [{"intensity_lux": lux, "direction": [0.5, -0.9, -0.7]} for lux in stated]
    with Camera(CameraSettings.check(SETTINGS | {"lights": lights})) as camera:
        for _ in range(5):
            scene, _, _ = camera.scene([ball((0.8, 0.05, 0.05))])
            assert [node.light.intensity for node in scene.light_nodes] == stated


def test_randomised_colours_differ_from_view_to_view():
    colours = [p[32, 32] for p in pictures(SETTINGS | {"colour_randomisation": 1.0}, count=4)]
    assert np.ptp(np.array(colours, dtype=int), axis=0).max() > 30


def test_an_unknown_platform_is_refused(monkeypatch):
    monkeypatch.setenv("PYOPENGL_PLATFORM", "glx")
    with pytest.raises(InputError, match=r"PYOPENGL_PLATFORM.*egl, osmesa"):
        choose_platform()
