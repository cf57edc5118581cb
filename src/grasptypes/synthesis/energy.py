"""ContactGrasp's energy of a grasp (Brahmbhatt et al. 2019, section IV), for many grasps at once.

Points that the person touched attract the hand, the other points repel it. Lengths are in metres;
the weights are ContactGrasp's, so energies are of the same kind as the published ones.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from grasptypes.compiled import compiled
from grasptypes.poses import inverse
from grasptypes.settings.synthesis import EnergySettings
from grasptypes.synthesis.candidates import Demonstration
from grasptypes.synthesis.fields import Field, distance, field_at, slope
from grasptypes.synthesis.hand_model import HandModel
from grasptypes.synthesis.posed_links import moved, overlap
from grasptypes.synthesis.scene import GraspScene

Array = NDArray[np.float64]

TERMS = ("attraction", "repulsion", "thumb", "penetration", "self_collision")
# Gaps beyond this are only bounded from below, since the distance of a remote link does not matter.
FAR_M = 0.005


class Targets(NamedTuple):
    """Points of the object that attract or repel the hand."""

    points: Array
    """(m, 3) metres, object frame; attracting points first."""
    normals: Array
    """(m, 3) outward unit vectors."""
    attracting: int
    """Number of attracting points."""


class Closeness(NamedTuple):
    """Distances of the links of n hands to the object and to each other."""

    gaps_m: Array
    """(n, L) smallest signed distance of each link's points to the object, or a lower bound for a
    remote link."""
    self_depth_m: Array
    """(n,) penetration depth between links of different fingers, or a finger and the palm."""

    @property
    def penetration_m(self) -> Array:
        """(n,) depth of the deepest hand point in the object, 0 or more."""
        return np.asarray(np.maximum(-self.gaps_m.min(axis=1), 0.0))


def draw_targets(
    demonstration: Demonstration, settings: EnergySettings, draw: np.random.Generator
) -> Targets:
    """Choose a session's attracting and repelling points among the demonstration's.

    If no point counts as touched, the points with the strongest contact attract.
    """
    contact = demonstration.contact
    touched = contact >= min(settings.contact_threshold, contact.max())
    attracting = draw.permutation(np.flatnonzero(touched))[: settings.attraction_points]
    repelling = draw.permutation(np.flatnonzero(~touched))[: settings.repulsion_points]
    index = np.concatenate([attracting, repelling])
    return Targets(
        np.ascontiguousarray(demonstration.points_m[index], dtype=np.float64),
        np.ascontiguousarray(demonstration.normals[index], dtype=np.float64),
        len(attracting),
    )


def closeness(scene: GraspScene, link_poses: Array) -> Closeness:
    """Distances of hands with links at (n, L, 4, 4) in the object's frame."""
    return Closeness(*_closeness(scene.model, scene.field, link_poses))


def energies(
    model: HandModel,
    link_poses: Array,
    close: Closeness,
    targets: Targets,
    settings: EnergySettings,
) -> Array:
    """The terms of each grasp's energy; their sum is the energy, lower is better.

    Args:
        link_poses: (n, L, 4, 4) links in the object frame.
        close: closeness of the same hands.

    Returns:
        (n, 5) in the order of `TERMS`.
    """
    terms = np.empty((len(link_poses), len(TERMS)))
    reach = settings.range_m, settings.repulsion_offset_m
    contact = _contact_terms(model, inverse(link_poses), targets, *reach)
    count = len(targets.points)
    terms[:, 0] = settings.attraction_weight * contact[:, 0] / count
    terms[:, 1] = -settings.repulsion_weight * contact[:, 1] / count
    terms[:, 2] = settings.thumb_weight * contact[:, 2]
    terms[:, 3] = settings.penetration_weight * close.penetration_m
    terms[:, 4] = settings.self_collision_weight * close.self_depth_m
    return terms


@compiled()
def _contact_terms(
    model: HandModel, T_link_object: Array, targets: Targets, range_m: float, offset_m: float
) -> Array:
    """(n, 3): sums of attracting and repelling distances, and the thumb's smallest distance."""
    points, attracting = targets.points, targets.attracting
    result = np.zeros((len(T_link_object), 3))
    for n in range(len(T_link_object)):
        thumb = range_m
        for m in range(len(points)):
            nearest, link = range_m, -1
            for candidate in range(len(model.radii)):
                x, y, z = moved(T_link_object[n, candidate], points, m)
                cx, cy, cz = model.centres[candidate]
                # The thumb's term needs its distance even if another link is closer.
                of_thumb = model.is_thumb[candidate] and m < attracting
                bound = model.radii[candidate] + (max(nearest, thumb) if of_thumb else nearest)
                if (x - cx) ** 2 + (y - cy) ** 2 + (z - cz) ** 2 > bound * bound:
                    continue
                link_field = field_at(model.grids, model.grid_of_link[candidate])
                gap = distance(link_field, x, y, z)
                if of_thumb:
                    thumb = min(thumb, max(gap, 0.0))
                if gap < nearest:
                    nearest, link = gap, candidate
            if m < attracting:
                result[n, 0] += min(abs(nearest), range_m)
            elif link < 0 or (
                abs(nearest) * _sine(model, link, T_link_object[n, link], targets, m) <= offset_m
            ):
                result[n, 1] += min(abs(nearest), range_m)
        result[n, 2] = thumb
    return result


@compiled()
def _sine(model: HandModel, link: int, pose: Array, targets: Targets, row: int) -> float:
    """Sine of the angle between an object point's normal and the direction to the link."""
    x, y, z = moved(pose, targets.points, row)
    gx, gy, gz, norm = slope(field_at(model.grids, model.grid_of_link[link]), x, y, z)
    along = 0.0
    for axis, g in enumerate((gx, gy, gz)):
        for k in range(3):
            along += pose[axis, k] * targets.normals[row, k] * g / norm
    return math.sqrt(max(1.0 - along * along, 0.0))


@compiled()
def _closeness(model: HandModel, grid: Field, poses: Array) -> tuple[Array, Array]:
    links = len(model.radii)
    gaps = np.full((len(poses), links), np.inf)
    depth = np.zeros(len(poses))
    for n in range(len(poses)):
        for link in range(links):
            cx, cy, cz = moved(poses[n, link], model.centres, link)
            bound = distance(grid, cx, cy, cz) - model.radii[link]
            if bound > FAR_M:
                gaps[n, link] = bound
                continue
            for index in range(model.starts[link], model.starts[link + 1]):
                x, y, z = moved(poses[n, link], model.points, index)
                gaps[n, link] = min(gaps[n, link], distance(grid, x, y, z))
        for link, other in model.pairs:
            depth[n] = max(depth[n], overlap(model, link, poses[n, link], other, poses[n, other]))
    return gaps, depth
