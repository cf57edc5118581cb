"""Replay of hand poses: gaps and depths known beforehand, the published frame, limits, input."""

import os
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
import trimesh
from tests.unit.barrett import BARRETT

from grasptypes.errors import InputError
from grasptypes.hands import configuration
from grasptypes.hands.surface import surface_points
from grasptypes.labels import replay
from grasptypes.labels.published import read_published
from grasptypes.objects.distance_grid import signed_distance
from grasptypes.settings.grasp_types import ReplaySettings

SETTINGS = ReplaySettings(
    object_scale=1.0, surface_spacing_m=0.004, limit_tolerance_rad=1e-3, limit_tolerance_m=1e-6
)
# An open hand above the ground, its palm facing down.
DOWN = np.diag([1.0, -1.0, -1.0, 1.0])
OPEN_RAD = np.zeros(4)


def above(height_m: float, dofs: np.ndarray = OPEN_RAD) -> np.ndarray:
    pose = DOWN.copy()
    pose[2, 3] = height_m
    return configuration.pack(0, pose, dofs)[None]


@pytest.fixture
def plate() -> trimesh.Trimesh:
    """A thin round plate, 40 mm across, its top at z = 0, which only the palm can meet."""
    plate = trimesh.creation.cylinder(0.020, 0.010)
    plate.apply_translation([0, 0, -0.005])
    return plate


def test_gap_is_the_distance_of_palm_and_plate(plate: trimesh.Trimesh) -> None:
    fit = replay.fit_hands(BARRETT, above(0.012), plate, 0.004)
    np.testing.assert_allclose(fit.gap_m, 0.012, atol=1e-4)
    np.testing.assert_array_equal(fit.penetration_m, 0.0)
    assert fit.link_distance_m[0].argmin() == 0


def test_penetration_is_the_depth_and_leaves_no_gap(plate: trimesh.Trimesh) -> None:
    fit = replay.fit_hands(BARRETT, above(-0.003), plate, 0.004)
    np.testing.assert_array_equal(fit.gap_m, 0.0)
    np.testing.assert_allclose(fit.penetration_m, 0.003, atol=1e-4)


def test_needle_between_the_hands_points_is_noticed() -> None:
    points = surface_points(BARRETT, 0.004)
    x, y = points.points_m[(points.link_index == 0) & (points.points_m[:, 2] == 0.0)][3, :2]
    needle = trimesh.creation.cone(0.0003, 0.03)
    needle.apply_translation([x + 0.002, -y + 0.001, -0.03])
    fit = replay.fit_hands(BARRETT, above(-0.002), needle, 0.004)
    assert fit.gap_m[0] == 0.0
    np.testing.assert_allclose(fit.depth_m, 0.002, atol=2e-4)


def test_open_scan_still_has_an_inside(plate: trimesh.Trimesh) -> None:
    plate.update_faces(np.arange(len(plate.faces)) != 3)
    assert not plate.is_watertight
    distances = signed_distance(
        np.array([[0, 0, -0.005], [0, 0, 0.005]]), plate.vertices, plate.faces
    )
    np.testing.assert_allclose(distances, [-0.005, 0.005], atol=1e-9)


def test_reference_mesh_stands_on_the_origin(tmp_path: Path) -> None:
    box = trimesh.creation.box(bounds=[[-0.1, 0.2, 0.3], [0.1, 0.3, 0.5]])
    box.export(tmp_path / "box.stl")
    mesh = replay.read_reference_mesh(tmp_path / "box.stl", 1.15)
    np.testing.assert_allclose(mesh.bounds, np.array([[-0.1, -0.05, 0], [0.1, 0.05, 0.2]]) * 1.15)


def test_file_that_is_no_mesh_is_named(tmp_path: Path) -> None:
    path = tmp_path / "box.stl"
    path.write_text("solid\nendsolid\n")
    with pytest.raises(InputError, match=r"box\.stl"):
        replay.read_reference_mesh(path, 1.0)


def test_table_has_a_row_an_object_with_mesh_and_counts_limits(
    tmp_path: Path, plate: trimesh.Trimesh
) -> None:
    plate.export(tmp_path / "plate.stl")
    beyond = np.radians([185, 0, 0, 0])
    numbers = [above(0.012)[0], above(0.014, beyond)[0], None, above(0.014)[0]]
    published = pd.DataFrame({"object": ["plate"] * 3 + ["unknown"], "hand_configuration": numbers})
    table = replay.replay(published, BARRETT, {"plate": tmp_path / "plate.stl"}, SETTINGS)
    replay.REPLAY_SCHEMA.validate(table)
    assert table.object.tolist() == ["plate"]
    assert table.n.tolist() == [2]
    assert table.beyond_limits.tolist() == [1]
    # The plate stands on the origin here, so that its top is at 10 mm.
    assert table.gap_median_mm[0] == pytest.approx(3.0, abs=0.1)


@pytest.mark.skipif(
    not {"GRASPTYPES_PUBLISHED_CSV", "GRASPTYPES_REFERENCE_MESHES"} <= set(os.environ),
    reason="GRASPTYPES_PUBLISHED_CSV or GRASPTYPES_REFERENCE_MESHES is not set",
)
def test_published_teapot_poses_lie_on_the_teapot_and_only_in_their_own_frame() -> None:
    table = read_published(os.environ["GRASPTYPES_PUBLISHED_CSV"])
    rows = table[(table.object == "utah_teapot") & table.hand_configuration.notna()]
    numbers = np.stack(rows.hand_configuration.tolist())
    path = Path(os.environ["GRASPTYPES_REFERENCE_MESHES"]) / "utah_teapot.stl"
    mesh = replay.read_reference_mesh(path, 1.15)
    standing = replay.fit_hands(BARRETT, numbers, mesh, 0.008)
    mesh.apply_translation(-mesh.bounds.mean(axis=0))
    centred = replay.fit_hands(BARRETT, numbers, mesh, 0.008)
    assert np.median(standing.gap_m) <= 0.002
    assert np.median(standing.penetration_m) < 0.010
    assert np.median(centred.penetration_m) > 0.015
