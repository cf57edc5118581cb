"""What a point looks like to one who does not know the object: numbers from its shape alone.

None of them depends on where the object lies or how it is turned. Lengths count both in metres,
since hands have a size, and relative to the object's length.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.distance import cdist

from grasptypes.settings.segmentation import DescriptorSettings

Array = NDArray[np.float64]

# Lengths below this are noise.
SMALLEST_M = 1e-4


@dataclass(frozen=True)
class Cloud:
    """Points spread evenly over an object's surface, in its principal frame.

    Attributes:
        points_m, normals: (M, 3).
        extents_m: (3,) along the principal axes, the longest first.
        axes: (3, 3) these axes in rows, in the frame in which the points were given.
        middle_m: (3,) the middle of the extents, in that frame.
    """

    points_m: Array
    normals: Array
    extents_m: Array
    axes: Array
    middle_m: Array

    @classmethod
    def of_points(cls, points_m: Array, normals: Array, count: int) -> Cloud:
        """At most `count` of some points (N, 3), in any order, with outward normals (N, 3).

        Of the two directions of each axis, the one counts towards which the points have the longer
        tail.
        """
        points_m, normals = points_m[:count], normals[:count]
        mean_m = points_m.mean(axis=0)
        axes = np.linalg.svd(points_m - mean_m, full_matrices=False)[2]
        placed = (points_m - mean_m) @ axes.T
        longest = np.argsort(-np.ptp(placed, axis=0), kind="stable")
        axes, placed = axes[longest], placed[:, longest]
        signs = np.where((placed**3).sum(axis=0) < 0, -1.0, 1.0)
        axes, placed = axes * signs[:, None], placed * signs
        middle = (placed.min(axis=0) + placed.max(axis=0)) / 2
        return cls(
            placed - middle, normals @ axes.T, np.ptp(placed, axis=0), axes, mean_m + middle @ axes
        )

    @property
    def length_m(self) -> float:
        """The longest extent."""
        return float(self.extents_m[0])


def describe_points(
    cloud: Cloud, points_m: Array, normals: Array, settings: DescriptorSettings
) -> NDArray[np.float32]:
    """Descriptors (n, D) of points (n, 3) with normals (n, 3), in the frame of the given cloud."""
    points, normals = (points_m - cloud.middle_m) @ cloud.axes.T, normals @ cloud.axes.T
    distance = cdist(points, cloud.points_m)
    # Of the vectors to the cloud's points, what lies along the normal, and what lies beside it.
    height = normals @ cloud.points_m.T - np.einsum("nj,nj->n", normals, points)[:, None]
    beside = np.sqrt(np.clip(distance**2 - height**2, 0, None))
    length = cloud.length_m
    columns = [
        np.log(np.broadcast_to(np.clip(cloud.extents_m, SMALLEST_M, None), (len(points), 3))),
        _balls(distance, height, settings.spacing_m, length),
        _spin_image(beside, height, length, settings.spin_bins),
        *(_spin_image(beside, height, radius, settings.spin_bins) for radius in settings.radii_m),
        *(_spread(cloud, points, normals, distance, radius) for radius in settings.radii_m),
        _spread(cloud, points, normals, distance, settings.local_share * length),
        _place(cloud, points, normals),
        _profile(cloud, points, settings.stations),
    ]
    return np.concatenate(columns, axis=1).astype(np.float32)


def _balls(distance: Array, height: Array, spacing_m: float, length_m: float) -> Array:
    """Logarithms (n, 4) of the radii of the largest balls inside and outside, touching at a point.

    A ball that is tangent to the surface reaches another point if its radius is d^2 / (2 h): the
    medial axis transform. Points nearer than the spacing are on the same face.
    """
    radii = []
    for side in (-height, height):
        reached = (side > SMALLEST_M) & (distance > spacing_m)
        radius = np.where(reached, distance**2 / (2 * np.where(reached, side, 1.0)), length_m).min(
            axis=1
        )
        radii.append(np.clip(radius, SMALLEST_M, length_m))
    inside, outside = radii
    both = np.stack([inside, outside, inside / length_m, outside / length_m], axis=1)
    return np.asarray(np.log(both))


def _spin_image(beside: Array, height: Array, reach_m: float, bins: int) -> Array:
    """Spin images (n, 2 bins^2): where the surface is, beside a point's normal and along it
    (Johnson 1997).

    Square roots of shares, so that rare places count.
    """
    column = np.floor(beside / reach_m * bins).astype(np.intp)
    row = np.floor((height / reach_m + 1) * bins).astype(np.intp)
    inside = (column < bins) & (row >= 0) & (row < 2 * bins)
    cells = 2 * bins * bins
    at = (np.arange(len(beside))[:, None] * cells + row * bins + column)[inside]
    counts = np.bincount(at, minlength=len(beside) * cells).reshape(len(beside), cells)
    return np.asarray(np.sqrt(counts / beside.shape[1]))


def _spread(cloud: Cloud, points: Array, normals: Array, distance: Array, radius_m: float) -> Array:
    """How the surface within a radius spreads (n, 5): extents, agreement of normals, area."""
    near = (distance < radius_m).astype(float)
    count = np.maximum(near.sum(axis=1), 1)
    mean = near @ cloud.points_m / count[:, None]
    outer = np.einsum("mi,mj->mij", cloud.points_m, cloud.points_m).reshape(-1, 9)
    covariance = (near @ outer / count[:, None]).reshape(-1, 3, 3) - np.einsum(
        "ni,nj->nij", mean, mean
    )
    extents = np.sqrt(np.clip(np.linalg.eigvalsh(covariance), 0, None)) / radius_m
    agreement = np.einsum("nj,nj->n", near @ cloud.normals / count[:, None], normals)
    share = np.sqrt(count / len(cloud.points_m))
    return np.column_stack([extents, agreement, share])


def _place(cloud: Cloud, points: Array, normals: Array) -> Array:
    """Where a point is in the object (n, 11): along the axes, and which way it faces."""
    half = np.clip(cloud.extents_m / 2, SMALLEST_M, None)
    shares = points / half
    radius = np.linalg.norm(points, axis=1)
    outward = np.einsum("nj,nj->n", points, normals) / np.clip(radius, SMALLEST_M, None)
    from_axis = np.linalg.norm(points[:, 1:], axis=1) / cloud.length_m
    return np.column_stack(
        [shares, np.abs(shares), np.abs(normals), outward, from_axis],
    )


def _profile(cloud: Cloud, points: Array, stations: int) -> Array:
    """The object's width at stations along it, from the end nearest to a point (n, 2 stations)."""
    along = (cloud.points_m[:, 0] / cloud.length_m + 0.5) * stations
    station = np.clip(along.astype(int), 0, stations - 1)
    wide = np.linalg.norm(cloud.points_m[:, 1:], axis=1)
    count = np.bincount(station, minlength=stations)
    mean = np.bincount(station, wide, minlength=stations) / np.maximum(count, 1)
    share = count / len(along)
    whole = np.concatenate([mean / cloud.length_m, np.sqrt(share)])
    flipped = np.concatenate([mean[::-1] / cloud.length_m, np.sqrt(share[::-1])])
    return np.where((points[:, 0] > 0)[:, None], flipped, whole)
