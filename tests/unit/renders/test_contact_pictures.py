"""Cameras of the contact images; no OpenGL is needed."""

import numpy as np
import pytest
from tests.unit.settings import PARAMS

from grasptypes.renders.contact_pictures import look_at, plain

RENDERS = PARAMS.renders


@pytest.mark.parametrize("azimuth_rad", [0.0, 1.0, 4.0])
def test_camera_is_upright_and_frames_the_object(azimuth_rad):
    points = np.random.default_rng(0).uniform(-0.1, 0.2, (200, 3))
    settings = plain(RENDERS, 64)
    pose = look_at(points, azimuth_rad, 0.4, settings)
    assert pose[:3, :3] @ pose[:3, :3].T == pytest.approx(np.eye(3))
    assert np.linalg.det(pose[:3, :3]) == pytest.approx(1.0)
    assert pose[2, 0] == 0.0
    assert pose[2, 1] > 0.0
    seen = (points - pose[:3, 3]) @ pose[:3, :3]
    reach = np.abs(seen[:, :2] / seen[:, 2:]).max() / np.tan(settings.field_of_view_rad / 2)
    assert reach == pytest.approx(settings.fill)
