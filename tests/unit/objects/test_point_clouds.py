"""Points of three formats, and the surface around them."""

import numpy as np
import pytest
import trimesh
from tests.unit.settings import PARAMS

from grasptypes.errors import InputError
from grasptypes.objects.point_clouds import PCD_READER, extents, is_cloud, read_cloud, wrapped

SETTINGS = PARAMS.predict.clouds
CAN = trimesh.creation.cylinder(0.03, 0.12, sections=48)
POINTS = np.asarray(trimesh.sample.sample_surface(CAN, 3000, seed=0)[0])


def test_points_come_back_in_metres_without_those_that_are_missing(tmp_path):
    trimesh.PointCloud(1000 * POINTS).export(tmp_path / "can.ply")
    np.save(tmp_path / "can.npy", np.vstack([1000 * POINTS, [np.nan] * 3]))
    for name in ("can.ply", "can.npy"):
        assert is_cloud(tmp_path / name)
        np.testing.assert_allclose(read_cloud(tmp_path / name, "mm", SETTINGS), POINTS, atol=1e-6)
    CAN.export(tmp_path / "mesh.ply")
    assert not is_cloud(tmp_path / "mesh.ply")


def test_a_pcd_file_needs_its_reader(tmp_path):
    path = tmp_path / "can.pcd"
    try:
        pypcd4 = pytest.importorskip(PCD_READER)
    except pytest.skip.Exception:
        path.touch()
        with pytest.raises(InputError, match="pip install pypcd4"):
            read_cloud(path, "m", SETTINGS)
        return
    pypcd4.PointCloud.from_xyz_points(POINTS.astype(np.float32)).save(path)
    np.testing.assert_allclose(read_cloud(path, "m", SETTINGS), POINTS, atol=1e-6)


def test_the_surface_is_closed_and_little_larger_than_the_points():
    mesh = wrapped(POINTS, SETTINGS)
    assert mesh.is_watertight
    assert mesh.convex_hull.volume > CAN.volume
    assert (mesh.extents < CAN.extents + 0.02).all()


def test_extents_do_not_depend_on_the_pose():
    turned = trimesh.transformations.random_rotation_matrix(np.array([0.3, 0.5, 0.7]))[:3, :3]
    assert extents(POINTS @ turned.T) == pytest.approx((0.12, 0.06, 0.06), rel=0.03)
