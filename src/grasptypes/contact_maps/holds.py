"""How people hold an object for a task, from the roles of its parts, its size and its weight.

P(grip, place | task, object) is proportional to how likely people touch the place (its weight in
the task, and its share of the surface), the prior of the grip on such roles, and how well the grip
fits the place's size and the load that the hand carries there.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from grasptypes.contact_maps.contact_map import MapTask
from grasptypes.contact_maps.hold import STYLE_OF_GRIP, Hold
from grasptypes.contact_maps.placement import HumanHand
from grasptypes.contact_maps.places import GRAVITY_M_S2, HeldObject, Place, find_places
from grasptypes.errors import InputError
from grasptypes.objects.object_geometry import ObjectGeometry
from grasptypes.settings.holds import Fit, HoldTable, Measure, read_hold_table
from grasptypes.settings.tasks import Task, read_tasks

Array = NDArray[np.float64]
# Far beyond any difference that the published labels show.
SMALLEST_FIT, LARGEST_FIT = 1e-3, 1e3
# Cosine of the largest angle at which an axis leads away from something: 60 degrees.
LEADS_AWAY = 0.5
# A cross-section is round if its extents differ by less; directions tried around it.
ROUND, AROUND = 0.8, 8


def object_holds(
    drawn: MapTask, geometry: ObjectGeometry, table: HoldTable | None = None
) -> list[Hold]:
    """The holds of a prepared object for the task of a contact map.

    Args:
        table: default: the table that comes with the package.

    Raises:
        InputError: no part has a role that the task touches.
    """
    held, task = HeldObject.of_geometry(geometry, drawn.points), read_tasks()[drawn.name[1]]
    holds = find_holds(held, task, table or read_hold_table(), drawn.typical_hand())
    if not holds:
        roles = ", ".join(task.touched)
        message = f"has no part that people touch for {drawn.name[1]} (roles: {roles})"
        raise InputError(geometry.name, "", message)
    return holds


def find_holds(held: HeldObject, task: Task, table: HoldTable, hand: HumanHand) -> list[Hold]:
    """The holds of an object for a task, with probabilities that add up to one.

    Args:
        hand: of a typical person, at the object's scale.

    Returns:
        Empty if no part has a role that the task touches.
    """
    holds = [
        Hold(place.parts, _touchable(held, task, place), grip, sides, place.axis, *span, weight)
        for place in find_places(held, task, table, hand.breadth_m)
        for span in [position(held, place, task, table)]
        for grip, weight in grip_weights(held, place, task, table, hand).items()
        for sides in [palm_sides(held, place, grip, hand)]
        if weight > 0 and len(sides)
    ]
    return _frequent(holds, table.rarest)


def _frequent(holds: Sequence[Hold], rarest: float) -> list[Hold]:
    """The holds with grips that a share `rarest` of people or more use, normalised.

    Holds with the same grip are neighbours, so that sessions follow the grips' shares best.
    """
    if not holds:
        return []
    of_grip = dict.fromkeys(STYLE_OF_GRIP, 0.0)
    for hold in holds:
        of_grip[hold.grip] += hold.probability
    total = sum(of_grip.values())
    kept = [hold for hold in holds if of_grip[hold.grip] >= rarest * total]
    kept.sort(key=lambda hold: (hold.grip, hold.part))
    total = sum(hold.probability for hold in kept)
    return [replace(hold, probability=hold.probability / total) for hold in kept]


def _touchable(held: HeldObject, task: Task, place: Place) -> tuple[str, ...]:
    """Parts that a hand at a place may touch: not those that stay free, nor hazardous ones."""
    return tuple(
        name
        for name, part in held.roles.items()
        if name in place.parts
        or not (part and (part.role in task.free or (part.hazardous and task.hazard < 1)))
    )


def grip_weights(
    held: HeldObject, place: Place, task: Task, table: HoldTable, hand: HumanHand
) -> dict[str, float]:
    """The weight of each grip on a place: how likely the place is, times prior, times fit."""
    values = measures(held, place, task, table, hand)
    group = table.groups[place.group]
    return {
        grip: place_weight(place, table)
        * prior
        * task.grips.get(grip, 1.0)
        * fit_factor(values, [fit for fit in table.fits if applies(fit, place.group, grip)])
        for grip, prior in group.grips.items()
    }


def place_weight(place: Place, table: HoldTable) -> float:
    """How likely people hold the object at a place, before the grip counts."""
    return place.weight * float(place.area_share**table.area_power)


def applies(fit: Fit, group: str, grip: str) -> bool:
    """Whether a row of the table is about a grip on a group of roles."""
    return grip in fit.grips and (not fit.groups or group in fit.groups)


def fit_factor(values: dict[Measure, float], fits: Sequence[Fit]) -> float:
    """Product of the factors of some rows."""
    factor = float(np.prod([(max(values[fit.measure] / fit.at, 1.0)) ** fit.power for fit in fits]))
    return float(np.clip(factor, SMALLEST_FIT, LARGEST_FIT))


def measures(
    held: HeldObject, place: Place, task: Task, table: HoldTable, hand: HumanHand
) -> dict[Measure, float]:
    """What the fits depend on; lengths are shares of the hand's length.

    `load_n` is the force that the hand must counter: the weight, and its torque about the hand's
    centre divided by the hand's breadth.
    """
    length, width, thickness = (place.extents_m / hand.length_m).tolist()
    low, high = position(held, place, task, table)
    centre_m = place.middle_m + ((low + high) / 2 - 0.5) * place.extents_m[0] * place.axis
    lever_m = float(np.linalg.norm(held.centre_of_mass_m - centre_m))
    weight_n = held.mass_kg * GRAVITY_M_S2
    return {
        "length": length,
        "width": width,
        "thickness": thickness,
        "compactness": place.compactness,
        "load_n": weight_n * (1 + lever_m / hand.breadth_m),
    }


def position(held: HeldObject, place: Place, task: Task, table: HoldTable) -> tuple[float, float]:
    """Range of the hand's centre along a place's axis, as fractions of its extent.

    A task's range means something only where the axis leads away from what must stay free.
    """
    if table.groups[place.group].held_at == "task" and place.leads_away > LEADS_AWAY:
        return task.position
    start = (place.middle_m @ place.axis) - place.extents_m[0] / 2
    balanced = (held.centre_of_mass_m @ place.axis - start) / place.extents_m[0]
    middle = float(np.clip(balanced, 0.35, 0.65))
    return middle - 0.15, middle + 0.15


def palm_sides(held: HeldObject, place: Place, grip: str, hand: HumanHand) -> Array:
    """Unit vectors (K, 3) from a place to the palm; none if other parts are in the way everywhere.

    A wrap or a pinch comes from beside the axis, a rim grip over the rim, the others from any side.
    """
    axis, wide, thin = place.frame
    if grip == "rim":
        return _rim_side(held, place)
    if place.extents_m[2] > ROUND * place.extents_m[1]:
        angles = np.arange(AROUND) * 2 * np.pi / AROUND
        sides = np.outer(np.cos(angles), wide) + np.outer(np.sin(angles), thin)
    else:
        sides = np.array([wide, -wide, thin, -thin])
    if grip in ("enclose", "tripod"):
        sides = np.vstack([sides, axis, -axis])
    return sides[[not _blocked(held, place, side, hand) for side in sides]]


def _rim_side(held: HeldObject, place: Place) -> Array:
    """The end of the axis (1, 3) where the place's rim is; none (0, 3) if it has no rim."""
    rim = held.points_of([part for part in held.parts_with(["rim"]) if part in place.parts])
    if not rim.any():
        return np.empty((0, 3))
    ahead = (held.points_m[rim].mean(axis=0) - place.middle_m) @ place.axis
    return np.asarray(place.axis * np.sign(ahead))[None]


def _blocked(held: HeldObject, place: Place, side: Array, hand: HumanHand) -> bool:
    """Whether other parts stick out in front of a place, within the palm's breadth, on a side."""
    offset = held.points_m - place.middle_m
    along = offset @ side
    aside_m = np.linalg.norm(offset - along[:, None] * side, axis=1)
    near = aside_m < hand.palm_half_m
    own, others = along[near & place.mask], along[near & ~place.mask]
    top_m = own.max() if len(own) else 0.0
    return bool(len(others) and others.max() > top_m + hand.pad_radius_m / 2)
