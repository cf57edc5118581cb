"""Objects of the published poses."""

import numpy as np
import pytest
import trimesh

from grasptypes.labels.published_data import REFERENCES, lacking_data
from grasptypes.labels.published_objects import object_distances, own_mesh
from grasptypes.labels.published_source import PUBLISHED
from grasptypes.objects.object_files import Surface, write_surface
from grasptypes.settings.grasp_types import ModelFrame


@pytest.fixture
def own(tmp_path):
    """A bar of 0.2 x 0.04 x 0.02 m away from the origin, as a prepared object."""
    bar = trimesh.creation.box([0.2, 0.04, 0.02])
    bar.apply_translation([0.5, 0.5, 0.5])
    path = tmp_path / "own" / "bar" / "surface.npz"
    path.parent.mkdir(parents=True)
    index = np.zeros(len(bar.vertices), dtype=np.int16)
    names = np.array(["bar"])
    write_surface(path, Surface(np.array(bar.vertices), np.array(bar.faces), index, names))
    return path


def test_own_models_stand_on_the_ground_above_the_origin(own):
    mesh = own_mesh(own, None)
    np.testing.assert_allclose(mesh.bounds, [[-0.1, -0.02, 0], [0.1, 0.02, 0.02]], atol=1e-12)


def test_own_models_are_turned_before_and_shifted_after(own):
    frame = ModelFrame(rotation=[[0, -1, 0], [1, 0, 0], [0, 0, 1]], shift_m=[0.0, 0.01, 0.0])
    mesh = own_mesh(own, frame)
    np.testing.assert_allclose(mesh.bounds, [[-0.02, -0.09, 0], [0.02, 0.11, 0.02]], atol=1e-12)


def test_reference_comes_first_and_what_is_nowhere_is_left_out(own, tmp_path):
    box = trimesh.creation.box([0.1, 0.1, 0.1])
    (tmp_path / "scans").mkdir()
    box.export(tmp_path / "scans" / "bar.stl")
    names, own_folder = ["bar", "none"], own.parents[1]
    found = object_distances(names, tmp_path / "scans", own_folder, 2.0, {})
    assert list(found) == ["bar"]
    assert np.ptp(found["bar"].vertices_m, axis=0) == pytest.approx([0.2, 0.2, 0.2])
    found = object_distances(names, tmp_path, own_folder, 2.0, {})
    assert np.ptp(found["bar"].vertices_m, axis=0) == pytest.approx([0.2, 0.04, 0.02])


def test_lacking_data_are_named_with_their_source(tmp_path):
    assert lacking_data({PUBLISHED: str(tmp_path), REFERENCES: str(tmp_path)}) == ""
    line = lacking_data({PUBLISHED: str(tmp_path), REFERENCES: "/nowhere"})
    assert line.startswith("GRASPTYPES_REFERENCE_MESHES=/nowhere names nothing, get a folder")
    assert PUBLISHED in lacking_data({})
