"""The comparison gives the known figures of known shapes."""

import numpy as np
import pytest
import trimesh

from grasptypes.objects.shape_comparison import compare, inside, sample_surface


def box(*shift_m):
    mesh = trimesh.creation.box((0.04, 0.04, 0.04))
    mesh.apply_translation(shift_m or (0, 0, 0))
    return mesh


def test_a_shape_equals_itself():
    figures = compare(box(), box(), 2000, 50_000)
    assert figures["chamfer_mm"] == pytest.approx(0, abs=1e-6)
    assert figures["iou"] == 1.0


def test_shifted_box_loses_the_expected_overlap():
    assert compare(box(), box(0.01, 0, 0), 500, 100_000)["iou"] == pytest.approx(3 / 5, abs=0.01)


def test_nested_balls_are_apart_by_the_difference_of_radii():
    inner = trimesh.creation.icosphere(subdivisions=4, radius=0.03)
    outer = trimesh.creation.icosphere(subdivisions=4, radius=0.032)
    figures = compare(inner, outer, 5000, 200_000)
    assert figures["chamfer_mm"] == pytest.approx(2.0, abs=0.05)
    assert figures["chamfer_p95_mm"] == pytest.approx(2.0, abs=0.1)
    assert figures["iou"] == pytest.approx((30 / 32) ** 3, abs=0.01)


def test_scan_with_a_hole_or_inside_out_still_has_an_inside():
    mesh = trimesh.creation.icosphere(subdivisions=4, radius=0.03)
    holed = trimesh.Trimesh(mesh.vertices, mesh.faces[20:])
    turned = trimesh.Trimesh(mesh.vertices, mesh.faces[:, ::-1], process=False)
    points = np.array([[0.0, 0.0, 0.0], [0.05, 0.0, 0.0]])
    assert inside(holed, points).tolist() == [True, False]
    assert inside(turned, points).tolist() == [True, False]


def test_buried_faces_are_no_surface():
    pair = trimesh.util.concatenate([box(), box(0.02, 0, 0)])
    samples = sample_surface(pair, 4000)
    assert not inside(box(), samples * 0.99)[samples[:, 0] > 0.021].any()
    assert (np.abs(samples[:, 1:]).max(axis=1) < 0.0199)[np.abs(samples[:, 0]) < 0.0199].sum() == 0


def test_comparison_repeats_to_the_last_bit():
    assert compare(box(), box(0.003, 0, 0), 500, 20_000) == compare(
        box(), box(0.003, 0, 0), 500, 20_000
    )
