"""Where and in which direction a posed hand pushes against an object, from the signed distance.

The same code is used for the published poses (exact distance to a scan) and for our own grasps
(distance grid): it needs any object with `distance_and_gradient`.

Forces are unknown in both cases. A link near the object is assumed to push with a weight that falls
from 1 at contact to 0 at the reach, because published and synthesized hands end a few millimetres
outside or inside the surface. Its direction is between the inward surface normal and the direction
in which its finger closes: joint torque acts along the latter, and friction allows it.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple, Protocol

import igl
import numpy as np
import trimesh
from numpy.typing import ArrayLike, NDArray

from grasptypes.hands.hand import Hand
from grasptypes.hands.states import HandStates
from grasptypes.hands.surface import surface_points
from grasptypes.settings.grasp_types import ContactSettings

Array = NDArray[np.float64]

# Closer than this, the step to the nearest point is too short to define a direction.
TOUCH_M = 1e-3


class DistanceField(Protocol):
    """Signed distance to an object, negative inside, like `distance_grid.DistanceGrid`."""

    def distance_and_gradient(self, points_m: ArrayLike) -> tuple[Array, Array]:
        """Distances (...) in metres of points (..., 3), and directions (..., 3) out of it."""
        ...


@dataclass(frozen=True)
class MeshDistance:
    """Exact signed distance to a mesh, which need not be closed.

    Attributes:
        vertices_m: (V, 3) metres, object frame.
        faces: (F, 3).
    """

    vertices_m: Array
    faces: NDArray[np.int64]

    @classmethod
    def of(cls, mesh: trimesh.Trimesh) -> MeshDistance:
        """The distance to a mesh in metres."""
        vertices = np.ascontiguousarray(mesh.vertices, dtype=np.float64)
        return cls(vertices, np.ascontiguousarray(mesh.faces, dtype=np.int64))

    def distance_and_gradient(self, points_m: ArrayLike) -> tuple[Array, Array]:
        """Distances (...) in metres and unit directions (..., 3) out of the mesh.

        Points with a winding number above one half are inside.
        """
        points = np.asarray(points_m, dtype=np.float64)
        flat = np.ascontiguousarray(points.reshape(-1, 3))
        unsigned = igl.SIGNED_DISTANCE_TYPE_UNSIGNED
        apart, face, nearest = igl.signed_distance(flat, self.vertices_m, self.faces, unsigned)[:3]
        inside = np.abs(igl.fast_winding_number(self.vertices_m, self.faces, flat)) > 0.5
        distance = np.where(inside, -apart, apart)
        far = apart > TOUCH_M
        direction = _face_normals(self.vertices_m, self.faces[face])
        direction[far] = (flat - nearest)[far] / distance[far, None]
        return distance.reshape(points.shape[:-1]), direction.reshape(points.shape)


def _face_normals(vertices: Array, faces: NDArray[np.int64]) -> Array:
    a, b, c = (vertices[faces[:, corner]] for corner in range(3))
    return unit(np.cross(b - a, c - a))


class Contacts(NamedTuple):
    """The contact of each of L links in the order of `Hand.links`; n poses, hand frame, metres."""

    gap_m: Array
    """(n, L) signed distance between link and object, negative if they overlap."""
    position_m: Array
    """(n, L, 3) centre of the object's points next to the link."""
    normal: Array
    """(n, L, 3) mean outward unit normals there."""
    push: Array
    """(n, L, 3) unit vectors in which the links push the object."""
    weight: Array
    """(n, L) how much a link counts as pushing, 0 to 1."""


def find_contacts(field: DistanceField, hands: HandStates, settings: ContactSettings) -> Contacts:
    """Measure the contacts of n hands posed at an object whose signed distance is known."""
    hand, T_object_hand = hands.hand, hands.T_object_hand
    T_hand_link = hand.link_poses(hands.joint_positions)
    surface = surface_points(hand, settings.surface_spacing_m)
    on_hand = _apply(T_hand_link[:, surface.link_index], surface.points_m)
    distance, outward = field.distance_and_gradient(_apply(T_object_hand[:, None], on_hand))
    outward = np.einsum("nji,npj->npi", T_object_hand[:, :3, :3], outward)
    on_object = on_hand - distance[..., None] * outward
    gap, share = _patches(len(hand.links), distance, surface.link_index, settings.patch_depth_m)
    position, normal = share @ on_object, unit(share @ outward)
    push = unit(settings.closing_weight * closing_directions(hand, T_hand_link, position) - normal)
    weight = np.clip(1.0 - gap / settings.reach_m, 0.0, 1.0)
    return Contacts(gap, position, normal, push, weight)


def closing_directions(hand: Hand, T_hand_link: Array, position_m: Array) -> Array:
    """Unit vectors (n, L, 3) in which points (n, L, 3) on the links move as the fingers close.

    Zero for links that do not close. All links of a finger move with its first joint, because the
    motor drives them together; for a finger whose base has been stopped, this is how it got there,
    not how it would continue.
    """
    directions = np.zeros_like(position_m)
    for finger in hand.fingers:
        base = T_hand_link[:, finger.links[0]]
        for link in finger.links:
            if hand.joints[finger.joints[0]].prismatic:
                directions[:, link] = base[:, :3, 2]
            else:
                away = position_m[:, link] - base[:, :3, 3]
                directions[:, link] = np.cross(base[:, :3, 2], away)
    return unit(directions)


def unit(vectors: Array) -> Array:
    """Vectors (..., d) at unit length; zero stays zero."""
    length = np.linalg.norm(vectors, axis=-1, keepdims=True)
    return np.asarray(np.divide(vectors, length, out=np.zeros_like(vectors), where=length > 0))


def _patches(
    links: int, distance: Array, link_index: NDArray[np.int64], depth_m: float
) -> tuple[Array, Array]:
    """Each link's gap (n, L) and the weights of the hand's points in its contact (n, L, p).

    A single nearest point would jump between the edges of a link, depending on the sampling.
    """
    gap = np.empty((len(distance), links))
    share = np.zeros((len(distance), links, distance.shape[1]))
    for link in range(links):
        points = link_index == link
        gap[:, link] = distance[:, points].min(axis=1)
        share[:, link, points] = np.exp((gap[:, link, None] - distance[:, points]) / depth_m)
    return gap, share / share.sum(axis=2, keepdims=True)


def _apply(T: Array, points: Array) -> Array:
    applied: Array = np.einsum("...ij,...j->...i", T[..., :3, :3], points) + T[..., :3, 3]
    return applied
