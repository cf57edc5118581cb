"""Randomised pictures: the same every time, each different, and the object always in sight."""

import io

import numpy as np
import pytest
import trimesh
from PIL import Image
from tests.unit.renders.test_renderer import SETTINGS
from tests.unit.settings import PARAMS

from grasptypes.renders.grounds import ground, natural_noise
from grasptypes.renders.randomisation import cover_of, draw_view, random_pictures
from grasptypes.renders.renderer import Camera
from grasptypes.renders.scene import Part
from grasptypes.seeds import rng
from grasptypes.settings.renders import CameraSettings

IMAGES = PARAMS.general.images.changed(views=4)
VIEW = IMAGES.view


def taken(key="box"):
    mesh = trimesh.creation.box((0.1, 0.04, 0.02))
    part = Part(mesh.vertices, mesh.vertex_normals, mesh.faces, np.array([0.7, 0.1, 0.1]), 0.0, 0.6)
    with Camera(CameraSettings.check(SETTINGS)) as camera:
        files = list(random_pictures(camera, [part], key, 0, IMAGES))
    return files


def test_pictures_repeat_and_differ():
    files = taken()
    assert files == taken()
    assert len(set(files)) == IMAGES.views
    assert set(files).isdisjoint(taken("other"))
    assert np.asarray(Image.open(io.BytesIO(files[0]))).shape == (64, 64, 3)


def test_the_camera_looks_from_above_and_sees_the_whole_object():
    vertices = trimesh.creation.box((0.1, 0.04, 0.02)).vertices
    settings = VIEW.changed(any_side=0.0, fill=(0.8, 0.8), shift=0.0)
    for number in range(20):
        pose, angle_rad = draw_view(
            vertices, settings, CameraSettings.check(SETTINGS), rng("view", number)
        )
        seen = (vertices - pose[:3, 3]) @ pose[:3, :3]
        assert (seen[:, 2] < 0).all()
        reach = np.abs(seen[:, :2] / seen[:, 2:]).max() / np.tan(angle_rad / 2)
        assert reach < 0.8 + 1e-9
        low, high = settings.elevation_rad
        assert low <= np.arcsin(pose[2, 2]) <= high


@pytest.mark.parametrize("share", ["gradient", "noise", "pattern", "plain"])
def test_grounds_are_levels(share):
    shares = {name: float(name == share) for name in ("gradient", "noise", "pattern")}
    picture = ground(32, IMAGES.ground.changed(**shares), rng("ground"))
    assert picture.shape == (32, 32, 3)
    assert picture.dtype == np.float32
    assert picture.min() >= 0
    assert picture.max() <= 255
    assert (np.ptp(picture, axis=(0, 1)).max() == 0) == (share == "plain")


def test_steep_noise_is_smoother():
    flat, steep = (natural_noise(64, exponent, rng("noise")) for exponent in (0.5, 2.0))
    assert np.abs(np.diff(steep)).mean() < 0.5 * np.abs(np.diff(flat)).mean()


def test_covers_hide_a_part_of_the_object():
    shown = np.zeros((64, 64), dtype=bool)
    shown[20:44, 20:44] = True
    hidden = [(cover_of(shown, IMAGES.lens, rng(n)) & shown).sum() / shown.sum() for n in range(20)]
    assert max(hidden) <= IMAGES.lens.most_hidden
    assert np.mean(hidden) > 0
    assert not cover_of(np.zeros_like(shown), IMAGES.lens, rng(0)).any()
