"""Solids whose section is carried along a path."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from manifold3d import Manifold
from numpy.typing import NDArray

from grasptypes.kinds import sections
from grasptypes.kinds.curves import curve, outline
from grasptypes.kinds.solid_description import Swept
from grasptypes.objects import solids

Array = NDArray[np.float64]

SCALE_SAMPLES = 17


def sweep(given: Swept) -> Manifold:
    """The solid; raises ValueError if a curve cannot be drawn."""
    path = curve(given.path, given.smooth, given.closed, dimensions=3)
    share = np.linspace(0, 1, len(path))
    scales = np.ones((len(path), 2))
    if given.scales is not None:
        length = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(path, axis=0), axis=1))])
        share = length / length[-1]
        rows = [(at, *sizes) for at, *sizes in given.scales]
        table = np.array([(row[0], row[1], row[-1]) for row in rows])
        extra = table[(table[:, 0] > 0) & (table[:, 0] < 1), 0]
        extra = np.concatenate([extra, np.linspace(table[0, 0], table[-1, 0], SCALE_SAMPLES)])
        finer = np.unique(np.concatenate([share, extra]))
        path = np.column_stack([np.interp(finer, share, path[:, axis]) for axis in range(3)])
        scales = sections.monotone_curve(
            table[:, 0], table[:, 1:], np.clip(finer, *table[[0, -1], 0])
        )
    figure = outline(given.section)
    right, above = _frames(path, given.up, given.closed)
    flat = figure[None] * scales[:, None]
    rings = path[:, None] + flat[..., :1] * right[:, None] + flat[..., 1:] * above[:, None]
    return _closed_loft(rings) if given.closed else solids.loft(rings)


def _frames(path: Array, up: Sequence[float] | None, closed: bool) -> tuple[Array, Array]:
    """Unit vectors (K, 3) of a section's axes along a path."""
    if closed:
        tangents = np.roll(path, -1, axis=0) - np.roll(path, 1, axis=0)
    else:
        tangents = np.gradient(path, axis=0)
    tangents /= np.linalg.norm(tangents, axis=1, keepdims=True)
    if up is not None:
        right = np.cross(np.asarray(up, dtype=np.float64), tangents)
        right /= np.linalg.norm(right, axis=1, keepdims=True)
        return right, np.cross(tangents, right)
    # Each frame is the one before it, turned as the tangent turns (no twist).
    right = np.empty_like(path)
    start = np.eye(3)[np.argmin(np.abs(tangents[0]))]
    right[0] = start - tangents[0] * (start @ tangents[0])
    for index in range(1, len(path)):
        right[index] = right[index - 1] - tangents[index] * (right[index - 1] @ tangents[index])
    right /= np.linalg.norm(right, axis=1, keepdims=True)
    return right, np.cross(tangents, right)


def _closed_loft(rings: Array) -> Manifold:
    """Skin rings (K, N, 3), the last joined to the first."""
    count, size = rings.shape[:2]
    here = np.arange(count)[:, None] * size + np.arange(size)
    right = np.arange(count)[:, None] * size + (np.arange(size) + 1) % size
    ahead, corner = np.roll(here, -1, axis=0), np.roll(right, -1, axis=0)
    faces = np.concatenate(
        [np.stack([here, right, corner], -1), np.stack([here, corner, ahead], -1)]
    )
    return solids.from_mesh(rings.reshape(-1, 3), faces.reshape(-1, 3))
