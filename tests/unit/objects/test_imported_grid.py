"""The grid of a user's mesh is that of any object up to the margin, and bounded beyond."""

import numpy as np
import pytest
import trimesh

from grasptypes.objects import solids
from grasptypes.objects.distance_grid import DistanceGrid
from grasptypes.objects.imported_grid import imported_grid, signed_as_connected

SPACING_M, MARGIN_M = 0.004, 0.012


@pytest.fixture(scope="module")
def grids():
    """The grid of a large ball as an object's and as an imported one's."""
    ball = trimesh.creation.icosphere(subdivisions=3, radius=0.05)
    found = imported_grid(solids.from_mesh(ball.vertices, ball.faces), SPACING_M, MARGIN_M)
    return DistanceGrid.from_mesh(ball.vertices, ball.faces, SPACING_M, MARGIN_M), found


def test_distances_are_exact_up_to_the_margin(grids):
    exact, found = grids
    near = np.abs(exact.values) <= MARGIN_M
    assert found.values[near] == pytest.approx(exact.values[near], abs=1e-8)
    assert found.origin_m == pytest.approx(exact.origin_m)


def test_distances_beyond_are_lower_bounds(grids):
    exact, found = grids
    far = np.abs(exact.values) > MARGIN_M + SPACING_M
    assert set(np.sign(exact.values[far])) == {-1, 1}
    assert (np.sign(found.values) == np.sign(exact.values)).all()
    assert found.values[far] == pytest.approx(
        np.sign(exact.values[far]) * (MARGIN_M + SPACING_M), abs=1e-8
    )


def test_nodes_take_the_side_of_their_neighbours(grids):
    exact, _ = grids
    reach_m = MARGIN_M + SPACING_M
    wrong = exact.values.astype(np.float64)
    flipped = tuple(np.argwhere(np.abs(wrong) > SPACING_M)[::7].T)
    wrong[flipped] *= -1
    wrong[np.abs(wrong) > reach_m] = np.nan
    capped = np.clip(exact.values.astype(np.float64), -reach_m, reach_m)
    assert (signed_as_connected(wrong, reach_m, SPACING_M) == capped).all()
