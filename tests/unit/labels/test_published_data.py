"""Objects of the published poses."""

import numpy as np
import pandas as pd
import pytest
import trimesh
from tests.unit.barrett import BARRETT
from tests.unit.settings import PARAMS

from grasptypes.hands import configuration
from grasptypes.labels.label_sources import PUBLISHED
from grasptypes.labels.published_data import REFERENCES, labelled_grasps, lacking_data, own_mesh
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


def test_a_scan_comes_first_and_an_object_that_is_nowhere_is_left_out(own, tmp_path, monkeypatch):
    above = np.eye(4)
    above[2, 3] = 0.3
    rows = [("bar", 0), ("none", 1)]
    table = pd.DataFrame(
        {
            "object": [name for name, _ in rows],
            "grasp_type": "Precision",
            "hand_configuration": [configuration.pack(0, above, np.zeros(4))] * 2,
        }
    )
    monkeypatch.setattr("grasptypes.labels.published_data.read_published", lambda path: table)
    (tmp_path / "scans").mkdir()
    trimesh.creation.box([0.1, 0.1, 0.1]).export(tmp_path / "scans" / "bar.stl")
    for folder, height_m in ((tmp_path / "scans", 0.2), (tmp_path, 0.02)):
        environment = {PUBLISHED: "table.csv", REFERENCES: str(folder)}
        grasps = labelled_grasps(environment, BARRETT, own.parents[1], 2.0, PARAMS.grasp_types)
        assert grasps.objects.tolist() == ["bar"]
        # The palm faces away: its lowest point is 82.9 mm below its frame.
        assert grasps.measures.palm_gap_m[0] == pytest.approx(0.3 - 0.0829 - height_m, abs=2e-3)


def test_lacking_data_are_named_with_their_source(tmp_path):
    assert lacking_data({PUBLISHED: str(tmp_path), REFERENCES: str(tmp_path)}) == ""
    line = lacking_data({PUBLISHED: str(tmp_path), REFERENCES: "/nowhere"})
    assert line.startswith("GRASPTYPES_REFERENCE_MESHES=/nowhere names nothing, get a folder")
    assert PUBLISHED in lacking_data({})
