"""Cameras of the contact pictures; no OpenGL is needed."""

import numpy as np
import pytest

from grasptypes.renders.contact_pictures import look_at, studio_of

RENDERS = {
    "size_px": 256,
    "field_of_view_rad": 0.6,
    "fill": 0.9,
    "min_distance_radii": 2.0,
    "colour_randomisation": 1.0,
    "ambient": 0.4,
    "lights": [{"intensity": 2.0, "direction": [0.0, 0.0, -1.0]}],
    "background_rgb": [200, 200, 200],
    "vignette": 0.0,
    "ground_elevation_rad": 0.4,
    "shadow_strength": 0.5,
    "shadow_softness_px": 6.0,
    "shadow_fading": 4.0,
    "shadow_points": 100,
    "png_compression": 6,
    "views": 100,
}


def test_studio_is_plain():
    studio = studio_of(RENDERS, 64)
    assert (studio.size_px, studio.shadow_strength, studio.colour_randomisation) == (64, 0.0, 0.0)


@pytest.mark.parametrize("azimuth_rad", [0.0, 1.0, 4.0])
def test_camera_is_upright_and_frames_the_object(azimuth_rad):
    points = np.random.default_rng(0).uniform(-0.1, 0.2, (200, 3))
    studio = studio_of(RENDERS, 64)
    pose = look_at(points, azimuth_rad, 0.4, studio)
    assert pose[:3, :3] @ pose[:3, :3].T == pytest.approx(np.eye(3))
    assert np.linalg.det(pose[:3, :3]) == pytest.approx(1.0)
    assert pose[2, 0] == 0.0
    assert pose[2, 1] > 0.0
    seen = (points - pose[:3, 3]) @ pose[:3, :3]
    reach = np.abs(seen[:, :2] / seen[:, 2:]).max() / np.tan(studio.field_of_view_rad / 2)
    assert reach == pytest.approx(studio.fill)
