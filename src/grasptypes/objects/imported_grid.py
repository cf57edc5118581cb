"""The distance grid of a user's own mesh, which may be large and have long thin faces."""

from __future__ import annotations

import igl
import numpy as np
from manifold3d import Manifold
from numpy.typing import NDArray
from scipy import sparse

from grasptypes.objects import solids
from grasptypes.objects.distance_grid import DistanceGrid, grid_shape

Array = NDArray[np.float64]

# The boxes around long faces overlap, so that a search for the nearest one visits hundreds. At five
# cells it takes a third of the time; at two or ten, a little more.
EDGE_CELLS = 5


def imported_grid(solid: Manifold, spacing_m: float, margin_m: float) -> DistanceGrid:
    """The distances to a solid, exact up to a margin; beyond it, nodes have a lower bound.

    Most nodes of a large object are that far away, and nothing needs their distances. With a lower
    bound, a hand that moves as far as its distance allows never jumps over the surface.
    """
    vertices, faces = solids.to_mesh(solid.refine_to_length(EDGE_CELLS * spacing_m))
    origin_m = vertices.min(axis=0) - margin_m
    shape = grid_shape(origin_m, vertices.max(axis=0) + margin_m, spacing_m)
    # Nothing is cut off at the margin itself.
    reach_m = margin_m + spacing_m
    values = igl.signed_distance(
        np.ascontiguousarray(np.indices(shape).reshape(3, -1).T * spacing_m + origin_m),
        vertices,
        faces.astype(np.int64),
        igl.SIGNED_DISTANCE_TYPE_PSEUDONORMAL,
        -reach_m,
        reach_m,
    )[0].reshape(shape)
    values = signed_as_connected(values, reach_m, spacing_m)
    return DistanceGrid(values.astype(np.float32), origin_m, float(spacing_m))


def signed_as_connected(values: Array, reach_m: float, spacing_m: float) -> Array:
    """Distances (nx, ny, nz) with the sign that neighbours have with no surface between them.

    The nearest face does not tell the side where faces are degenerate. Two neighbours whose
    distances are together longer than a cell are on the same side; of all nodes that are connected
    like this, the sum of distances decides.

    Args:
        values: signed distances; not a number where they are longer than `reach_m`.
    """
    sizes = np.where(np.isnan(values), reach_m, np.abs(values))
    numbers = np.arange(values.size).reshape(values.shape)
    pairs = []
    for axis in range(3):
        size, number = np.moveaxis(sizes, axis, 0), np.moveaxis(numbers, axis, 0)
        apart = size[1:] + size[:-1] > spacing_m * (1 + 1e-6)
        pairs.append(np.stack([number[1:][apart], number[:-1][apart]]))
    one, other = np.concatenate(pairs, axis=1)
    graph = sparse.coo_array((np.ones(len(one), dtype=bool), (one, other)), (values.size,) * 2)
    group = sparse.csgraph.connected_components(graph, directed=False)[1]
    inside = np.bincount(group, np.nan_to_num(values).reshape(-1)) < 0
    return np.where(inside[group].reshape(values.shape), -sizes, sizes)
