"""The free numbers of the table of holds, fitted to published labels.

The grips' priors and the exponents of the fits are chosen so that the table's shares of grasp types
are likely given the published counts, and close to what is expected without labels: no preference
between grips, and the exponents that the reasons in the table suggest. Objects are predicted with
numbers fitted without them and without their relatives.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import minimize
from scipy.special import expit, softmax

from grasptypes.contact_maps.hold import GRIP_OF_TYPE
from grasptypes.contact_maps.holds import applies, measures, palm_sides, place_weight
from grasptypes.contact_maps.placement import HumanHand
from grasptypes.contact_maps.places import HeldObject, Place, find_places
from grasptypes.settings.grasp_types import Softness, Thresholds
from grasptypes.settings.holds import HoldFitSettings, HoldTable
from grasptypes.settings.tasks import Task

Array = NDArray[np.float64]
TYPES = tuple(GRIP_OF_TYPE)
WRAPS = 3
# Share of the place's middle in which its girth is measured, and slices of it.
MIDDLE, SLICES = 0.7, 5


@dataclass(frozen=True)
class Parameter:
    """A free number of the table of holds.

    Attributes:
        key: in the table.
        in_table: its value there.
        logarithmic: whether its natural logarithm is fitted.
        expected, sd: mean and standard deviation of what is fitted, without any labels.
    """

    key: str
    in_table: float
    logarithmic: bool
    expected: float
    sd: float


@dataclass(frozen=True)
class Problem:
    """The holds of one object for one task, as functions of the free numbers.

    Attributes:
        features: (H, P) derivative of each hold's log weight by each free number.
        offset: (H,) the rest of the log weight.
        types: (H, 6) share of each grasp type among grasps with this hold.
        grips: (H,) names.
    """

    features: Array
    offset: Array
    types: Array
    grips: NDArray[np.str_]

    def hold_shares(self, values: Array) -> Array:
        """Shares (H,) of the holds for values (P,) of the free numbers."""
        return np.asarray(softmax(self.features @ values + self.offset))

    def type_shares(self, values: Array, rarest: float) -> Array:
        """Shares (6,) of the grasp types, without grips rarer than `rarest`."""
        shares = self.hold_shares(values)
        common = [shares[self.grips == grip].sum() >= rarest for grip in self.grips]
        shares = np.where(common, shares, 0.0)
        return np.asarray(shares @ self.types / shares.sum())


def free_parameters(table: HoldTable, settings: HoldFitSettings) -> list[Parameter]:
    """The free numbers: log priors of the fitted groups, and exponents of the fits."""
    priors = [
        Parameter(f"groups.{name}.grips.{grip}", prior, True, 0.0, settings.prior_sd)
        for name, group in table.groups.items()
        if group.fitted
        for grip, prior in group.grips.items()
    ]
    powers = [
        Parameter(f"fits.{index}.power", fit.power, False, fit.expected, settings.power_sd)
        for index, fit in enumerate(table.fits)
    ]
    return priors + powers


def hold_problem(
    held: HeldObject,
    task: Task,
    table: HoldTable,
    hand: HumanHand,
    rule: tuple[Thresholds, Softness],
) -> Problem:
    """The holds of an object for a task as functions of the free numbers.

    Args:
        hand: of a typical person, at the object's scale.
        rule: thresholds between small, medium and large wraps, and widths of the transitions.
    """
    features, offset, types, grips = [], [], [], []
    for place in find_places(held, task, table, hand.breadth_m):
        values = measures(held, place, task, table, hand)
        wraps = wrap_shares(girth_m(held, place, hand), *rule)
        group = table.groups[place.group]
        for grip, prior in group.grips.items():
            if not len(palm_sides(held, place, grip, hand)):
                continue
            row = [float(n == place.group and g == grip) for n, g in _fitted_priors(table)]
            for fit in table.fits:
                size = np.log(max(values[fit.measure] / fit.at, 1.0))
                row.append(float(size) if applies(fit, place.group, grip) else 0.0)
            features.append(row)
            known = place_weight(place, table) * task.grips.get(grip, 1.0)
            offset.append(np.log(max(known * (1.0 if group.fitted else prior), 1e-12)))
            types.append(_types_of(grip, wraps))
            grips.append(grip)
    return Problem(np.array(features), np.array(offset), np.array(types), np.array(grips))


def _fitted_priors(table: HoldTable) -> list[tuple[str, str]]:
    return [(n, grip) for n, group in table.groups.items() if group.fitted for grip in group.grips]


def _types_of(grip: str, wraps: Array) -> Array:
    """Shares (6,) of the grasp types of a grip; a rim grip is a Precision grasp."""
    if grip == "wrap":
        return np.concatenate([wraps, np.zeros(len(TYPES) - WRAPS)])
    kinds = [GRIP_OF_TYPE[name] == ("pinch" if grip == "rim" else grip) for name in TYPES]
    return np.array(kinds, dtype=float)


def girth_m(held: HeldObject, place: Place, hand: HumanHand) -> float:
    """Diameter that a fist around a place encloses: the geometric mean of the extents across it.

    If other parts are beside the place all along it, such as a mug's wall behind its handle, a fist
    encloses them too.
    """
    offset = (held.points_m - place.middle_m) @ place.frame.T
    along = offset[:, 0] / place.extents_m[0]
    level = np.floor((along / MIDDLE + 0.5) * SLICES)
    near = (np.abs(offset[:, 1:]) < hand.finger_reach_m).all(axis=1)
    beside = {int(n) for n in level[near & ~place.mask] if 0 <= n < SLICES}
    middle = np.abs(along) < MIDDLE / 2
    chosen = middle & near if len(beside) == SLICES else middle & place.mask
    extents = np.ptp(offset[chosen, 1:], axis=0) if chosen.any() else place.extents_m[1:]
    return float(np.sqrt(np.prod(extents)))


def wrap_shares(diameter_m: float, thresholds: Thresholds, softness: Softness) -> Array:
    """Shares (3,) of large, medium and small wraps around a diameter."""
    size = np.log(diameter_m)
    small = expit((np.log(thresholds.small_diameter_m) - size) / softness.small_diameter_m)
    large = expit((size - np.log(thresholds.large_span_m)) / softness.large_span_m)
    return np.array([large * (1 - small), (1 - large) * (1 - small), small])


def fit_parameters(
    parameters: Sequence[Parameter],
    problems: Sequence[Problem],
    counts: Array,
    settings: HoldFitSettings,
) -> Array:
    """The most probable values (P,) of the free numbers given published counts (N, 6)."""
    expected = np.array([parameter.expected for parameter in parameters])
    sd = np.array([parameter.sd for parameter in parameters])
    shares = counts / counts.sum(axis=1, keepdims=True)

    def loss(values: Array) -> tuple[float, Array]:
        """Negative log posterior and its gradient (P,)."""
        deviation = (values - expected) / sd
        total, gradient = float((deviation**2).sum()) / 2, deviation / sd
        for problem, share in zip(problems, shares, strict=True):
            holds = problem.hold_shares(values)
            even = settings.label_noise / len(TYPES)
            chance = (1 - settings.label_noise) * holds @ problem.types + even
            total -= settings.grasps * float(share @ np.log(chance))
            slope = -settings.grasps * (1 - settings.label_noise) * problem.types @ (share / chance)
            gradient = gradient + problem.features.T @ (holds * (slope - holds @ slope))
        return total, gradient

    return np.asarray(minimize(loss, expected, jac=True, method="L-BFGS-B").x)


def relatives_of(name: str, relatives: Sequence[Sequence[str]]) -> set[str]:
    """An object and those that are left out with it."""
    return {name}.union(*(group for group in relatives if name in group))


def leave_out_relatives(
    parameters: Sequence[Parameter],
    problems: Mapping[tuple[str, str], Problem],
    counts: Mapping[tuple[str, str], Array],
    fitted_on: Sequence[str],
    settings: HoldFitSettings,
) -> dict[str, Array]:
    """Values (P,) of the free numbers for each object, fitted without it and its relatives.

    Args:
        problems: by object and task.
        counts: (6,) published counts by object and task.
        fitted_on: objects whose labels may be used at all.
    """
    fitted = {}
    for name in dict.fromkeys(name for name, _ in problems):
        out = relatives_of(name, settings.relatives)
        used = [key for key in problems if key[0] in fitted_on and key[0] not in out]
        known = np.array([counts[key] for key in used])
        fitted[name] = fit_parameters(parameters, [problems[key] for key in used], known, settings)
    return fitted
