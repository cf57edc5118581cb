"""Depth in both encodings, the object's size in it, and what stands out of a plane."""

import json

import numpy as np
import pytest
from PIL import Image
from tests.unit.settings import PARAMS

from grasptypes.errors import InputError
from grasptypes.renders.depth_images import (
    Intrinsics,
    check_camera,
    longest_extent,
    read_depth,
    read_intrinsics,
    standing_in,
)

LIMITS, PHOTOS = PARAMS.predict.depth, PARAMS.predict.photos
CAMERA = Intrinsics((500.0, 500.0), (100.0, 80.0))
BOX = 60, 30, 150, 130


def scene(tilt=0.0):
    """A box of 100 x 40 pixels, 0.5 m away, before a plane at about 0.7 m; where it is."""
    columns = np.arange(200)
    depth_m = np.tile(1 / (1 / 0.7 + tilt * (columns - 100)), (160, 1))
    region = np.zeros((160, 200), dtype=bool)
    region[40:120, 80:130] = True
    depth_m[region] = 0.5
    return depth_m, region


def test_both_encodings_give_metres_and_missing_numbers(tmp_path):
    depth_m, _ = scene()
    depth_m[0, 0] = np.nan
    millimetres = np.nan_to_num(depth_m * 1000).round().astype(np.uint16)
    Image.fromarray(millimetres).save(tmp_path / "d.png")
    np.save(tmp_path / "mm.npy", millimetres)
    np.save(tmp_path / "m.npy", depth_m.astype(np.float32))
    for name in ("d.png", "mm.npy", "m.npy"):
        np.testing.assert_allclose(read_depth(tmp_path / name, PHOTOS), depth_m, atol=5e-4)


def test_infinite_and_zero_distances_are_holes(tmp_path):
    np.save(tmp_path / "m.npy", np.array([[np.inf, 0.0], [0.5, -np.inf]], dtype=np.float32))
    found = read_depth(tmp_path / "m.npy", PHOTOS)
    assert np.isnan(found).tolist() == [[True, True], [False, True]]


def test_the_longest_side_is_measured_in_the_mask_and_in_the_box():
    for tilt in (0.0, 0.001):
        depth_m, region = scene(tilt)
        expected_m = 79 * 0.5 / 500
        found_m = longest_extent(depth_m, region, CAMERA, LIMITS, "d.png")
        assert found_m == pytest.approx(expected_m, rel=0.01)
        boxed = standing_in(depth_m, BOX, LIMITS, "d.png")
        assert np.array_equal(boxed, region)
    depth_m[:, ::3] = np.nan  # holes in every third column
    assert longest_extent(depth_m, region, CAMERA, LIMITS, "d.png") == pytest.approx(
        expected_m, rel=0.02
    )


def test_a_lying_object_is_measured_along_itself():
    depth_m = np.full((160, 200), 0.6)
    rows, columns = np.indices(depth_m.shape)
    along = (columns - 100 + rows - 80) / np.sqrt(2)
    across = (columns - 100 - rows + 80) / np.sqrt(2)
    region = (np.abs(along) < 60) & (np.abs(across) < 10)
    found_m = longest_extent(depth_m, region, CAMERA, LIMITS, "d.png")
    assert found_m == pytest.approx(120 * 0.6 / 500, rel=0.03)


def test_intrinsics_have_three_forms(tmp_path):
    matrix = [[500.0, 0, 100], [0, 510.0, 80], [0, 0, 1]]
    forms = (
        {"fx": 500, "fy": 510, "cx": 100, "cy": 80, "width": 200, "height": 160},
        {"K": np.ravel(matrix).tolist(), "height": 160, "width": 200},
        {"k": matrix, "height": 160, "width": 200},
    )
    path = tmp_path / "K.json"
    for form in forms:
        path.write_text(json.dumps(form))
        assert read_intrinsics(path) == Intrinsics((500.0, 510.0), (100.0, 80.0), (160, 200))
    path.write_text(json.dumps(matrix))
    assert read_intrinsics(path).shape is None
    with pytest.raises(InputError, match="of another camera"):
        check_camera(Intrinsics((500, 500), (320, 80)), path, scene()[0], (160, 200))
