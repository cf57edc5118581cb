"""Mass, centre of mass and inertia of solids and thin shells."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]

# Quadrature on a tetrahedron, exact to degree 2: four points, one near each corner.
_NEAR, _FAR = (5 + 3 * 5**0.5) / 20, (5 - 5**0.5) / 20


@dataclass(frozen=True)
class PointMasses:
    """Weighted points with exactly the mass, centre of mass and inertia of a body.

    Attributes:
        points_m: (N, 3).
        masses_kg: (N,), negative for negative signed volumes.
    """

    points_m: Array
    masses_kg: Array


def solid_masses(vertices: ArrayLike, faces: ArrayLike, density_kg_m3: float) -> PointMasses:
    """Spread the mass of a closed mesh (V, 3), (F, 3) over signed tetrahedra to the origin."""
    corners = np.asarray(vertices, dtype=np.float64)[np.asarray(faces)]
    volumes = np.einsum("fi,fi->f", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])) / 6
    tetrahedra = np.concatenate([corners, np.zeros((len(corners), 1, 3))], axis=1)
    weights = np.full((4, 4), _FAR) + (_NEAR - _FAR) * np.eye(4)
    return PointMasses(
        (weights @ tetrahedra).reshape(-1, 3), np.repeat(density_kg_m3 * volumes / 4, 4)
    )


def shell_masses(vertices: ArrayLike, faces: ArrayLike, mass_kg_m2: ArrayLike) -> PointMasses:
    """Spread an areal density, one number or (F,), over the faces of a mesh (V, 3), (F, 3)."""
    corners = np.asarray(vertices, dtype=np.float64)[np.asarray(faces)]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    masses = np.asarray(mass_kg_m2) * np.linalg.norm(normals, axis=1) / 2
    midpoints = (corners + np.roll(corners, -1, axis=1)) / 2
    return PointMasses(midpoints.reshape(-1, 3), np.repeat(masses / 3, 3))


def together(bodies: list[PointMasses]) -> PointMasses:
    """Join bodies that do not overlap."""
    return PointMasses(
        np.concatenate([body.points_m for body in bodies]),
        np.concatenate([body.masses_kg for body in bodies]),
    )


def mass_properties(body: PointMasses) -> tuple[float, Array, Array]:
    """Return mass (kg), centre of mass (3,) in m and inertia (3, 3) in kg m2 about it."""
    mass_kg = float(body.masses_kg.sum())
    centre_m = body.masses_kg @ body.points_m / mass_kg
    arms = body.points_m - centre_m
    second = np.einsum("n,ni,nj->ij", body.masses_kg, arms, arms)
    return mass_kg, centre_m, np.trace(second) * np.eye(3) - second
