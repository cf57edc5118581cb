"""Places where a hand can hold an object: parts of related roles, with their shape and load."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from grasptypes.contact_maps.placement import SurfacePoints
from grasptypes.objects.object_geometry import ObjectGeometry
from grasptypes.settings.holds import HoldTable
from grasptypes.settings.roles import PartRole
from grasptypes.settings.tasks import Task

Array = NDArray[np.float64]

GRAVITY_M_S2 = 9.81
# Extents that differ by less count as equal.
EQUAL_EXTENTS = 0.9


@dataclass(frozen=True)
class HeldObject:
    """What a person knows about an object before holding it (SI units, the object's frame).

    Attributes:
        points_m, normals: (N, 3) points spread evenly over the surface, and outward normals.
        part_index: (N,) part of each point.
        roles: role of each part by name, in the order of `part_index`; None if unknown.
        mass_kg, centre_of_mass_m: of the object, (3,).
    """

    points_m: Array
    normals: Array
    part_index: NDArray[np.int16]
    roles: Mapping[str, PartRole | None]
    mass_kg: float
    centre_of_mass_m: Array

    @classmethod
    def of_geometry(cls, geometry: ObjectGeometry, points: SurfacePoints) -> HeldObject:
        """A prepared object, seen through points sampled on its surface."""
        known = geometry.properties.roles
        roles = {
            str(name): PartRole.check(known[name]) if name in known else None
            for name in geometry.surface.part_names
        }
        return cls(
            points.points_m,
            points.normals,
            points.part_index,
            roles,
            geometry.properties.mass_kg,
            np.array(geometry.properties.centre_of_mass_m),
        )

    def points_of(self, parts: list[str]) -> NDArray[np.bool_]:
        """Mask (N,) of the points on some parts."""
        names = list(self.roles)
        return np.isin(self.part_index, [names.index(part) for part in parts])

    def parts_with(self, roles: list[str] | tuple[str, ...]) -> list[str]:
        """Names of the parts with one of the roles."""
        return [name for name, part in self.roles.items() if part and part.role in roles]


@dataclass(frozen=True)
class Place:
    """Neighbouring parts of related roles that one hand can hold.

    Attributes:
        group: name of its group in the table of holds.
        parts: names of its parts.
        mask: (N,) which points of the object are on it.
        frame: (3, 3) unit vectors in rows: the axis along which fingers are side by side, pointing
            away from what the task keeps free, then the directions of the larger and of the smaller
            extent across it.
        middle_m: (3,) middle of its extents.
        extents_m: (3,) along the rows of `frame`.
        area_share: its share of the object's surface.
        leads_away: cosine of the angle between the axis and the direction away from what the task
            keeps free, or from the rest of the object; 0 if there is neither.
        weight: how likely people touch it for the task, from its roles and attributes.
    """

    group: str
    parts: tuple[str, ...]
    mask: NDArray[np.bool_]
    frame: Array
    middle_m: Array
    extents_m: Array
    area_share: float
    leads_away: float
    weight: float

    @property
    def axis(self) -> Array:
        """(3,) direction along which fingers are side by side."""
        return np.asarray(self.frame[0])

    @cached_property
    def compactness(self) -> float:
        """Smallest extent divided by the largest: 1 for a ball, near 0 for a rod or a sheet."""
        return float(self.extents_m.min() / self.extents_m.max())


def find_places(held: HeldObject, task: Task, table: HoldTable, breadth_m: float) -> list[Place]:
    """The places of an object that people touch for a task.

    Args:
        breadth_m: of the hand; a place shorter than half of it has no room for two fingers.
    """
    places = []
    for name, group in table.groups.items():
        parts = held.parts_with(group.roles)
        weight = max((_weight(held.roles[part], task) for part in parts), default=0.0)
        if weight > 0:
            parts = [part for part in parts if _weight(held.roles[part], task) > 0]
            mask = held.points_of(parts)
            if mask.any():
                away = _away(held, task, mask)
                frame, middle_m, extents_m = _shape(held.points_m[mask], away, breadth_m)
                place = Place(
                    group=name,
                    parts=tuple(parts),
                    mask=mask,
                    frame=frame,
                    middle_m=middle_m,
                    extents_m=extents_m,
                    area_share=float(mask.mean()),
                    leads_away=float(frame[0] @ away),
                    weight=weight,
                )
                places.append(place)
    return places


def _weight(part: PartRole | None, task: Task) -> float:
    """How likely people touch a part for a task, before its size counts."""
    if part is None:
        return 0.0
    return task.touched.get(part.role, 0.0) * (task.hazard if part.hazardous else 1.0)


def _away(held: HeldObject, task: Task, mask: NDArray[np.bool_]) -> Array:
    """Unit vector (3,) to a place from what must stay free, or from the rest of the object.

    Zero if the place is the whole object.
    """
    free = held.points_of(held.parts_with(task.free)) & ~mask
    front = free if free.any() else ~mask
    if not front.any():
        return np.zeros(3)
    away = held.points_m[mask].mean(axis=0) - held.points_m[front].mean(axis=0)
    return np.asarray(away / max(float(np.linalg.norm(away)), 1e-9))


def _shape(points_m: Array, away: Array, breadth_m: float) -> tuple[Array, Array, Array]:
    """Frame (3, 3), middle (3,) and extents (3,) of a place's points (N, 3)."""
    directions = np.linalg.svd(points_m - points_m.mean(axis=0), full_matrices=False)[2]
    extents = np.ptp(points_m @ directions.T, axis=0)
    axis = _axis_index(extents, breadth_m)
    others = sorted((i for i in range(3) if i != axis), key=lambda i: -extents[i])
    order = [axis, *others]
    frame, extents = directions[order], extents[order]
    # Without a direction away, the sign is that of the largest component.
    ahead = frame[0] @ away or frame[0][np.argmax(np.abs(frame[0]))]
    frame[0] *= np.sign(ahead) or 1.0
    along = points_m @ frame.T
    return frame, (along.min(axis=0) + along.max(axis=0)) / 2 @ frame, extents


def _axis_index(extents: Array, breadth_m: float) -> int:
    """Which extent (3,) the fingers are side by side along.

    That of rotational symmetry if two fingers have room along it, else the longest.
    """
    pairs = [(i, j, 3 - i - j) for i, j in ((0, 1), (0, 2), (1, 2))]
    ratios = [min(extents[i], extents[j]) / max(extents[i], extents[j]) for i, j, _ in pairs]
    rest = pairs[int(np.argmax(ratios))][2]
    symmetric = max(ratios) > EQUAL_EXTENTS and extents[rest] > breadth_m / 2
    return rest if symmetric else int(np.argmax(extents))
