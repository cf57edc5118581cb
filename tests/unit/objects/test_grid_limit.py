"""A large object's distance grid gets coarser, and says so."""

import pytest
import trimesh
from tests.unit.settings import PARAMS

from grasptypes.objects.loading import load_object

OBJECTS = PARAMS.objects.changed(
    resolution=PARAMS.objects.resolution.changed(surface_edge_m=0.02, grid_spacing_m=0.004)
)


@pytest.mark.parametrize(("nodes", "spacing_mm"), [(25_000, 4.0), (5_000, 7.0)])
def test_a_grid_with_too_many_nodes_gets_coarser(tmp_path, nodes, spacing_mm):
    trimesh.creation.box((0.06, 0.06, 0.06)).export(tmp_path / "box.stl")
    limits = OBJECTS.import_.changed(max_grid_nodes=nodes)
    box = load_object(tmp_path / "box.stl", settings=OBJECTS.changed(import_=limits))
    grid = box.distance_grid
    assert grid.values.size <= nodes
    assert 1e3 * grid.spacing_m == pytest.approx(spacing_mm)
    assert grid.distance([0.0, 0.0, 0.0]) == pytest.approx(-0.03, abs=0.004)
    assert grid.distance([0.05, 0.0, 0.0]) == pytest.approx(0.02, abs=0.001)
    expected = ["spaced the distance grid at 7.0 mm, as the object is large"]
    assert box.properties.repairs == (expected if spacing_mm > 4 else [])
