"""The grasp type of a measured grasp: the decision tree of the paper's Figure 2.

Four thresholds decide, each on a length or share that can be measured on any grasp:

- power or precision: is the object at the palm, or do the fingers alone carry it?
- small wrap: a hand closed around such a small diameter presses the object to the palm with all
  fingers, whatever the spread: the fingers are one virtual finger, the palm the other;
- virtual fingers: fingers that push within a plane are two opposing virtual fingers; a push across
  that plane comes from a third one: a sphere;
- large or medium wrap: the distance between the contacts of the opposing fingertips.

See docs/grasp_types.md for the names of the types in other taxonomies.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from grasptypes.hands.hand import PALM, Hand
from grasptypes.hands.states import HandStates
from grasptypes.labels.contacts import Contacts, DistanceField, find_contacts
from grasptypes.settings.grasp_types import (
    ContactSettings,
    LabellingRule,
    Softness,
    Thresholds,
)

Array = NDArray[np.float64]

LARGE_WRAP, MEDIUM_WRAP, SMALL_WRAP = "Large Wrap", "Medium Wrap", "Small Wrap"
POWER_SPHERE, PRECISION_SPHERE, PRECISION = "Power Sphere", "Precision Sphere", "Precision"
INVALID = "Invalid"
# Spelled and ordered as in the published table, where GraspTypeIndex starts at 1.
TYPES = (LARGE_WRAP, MEDIUM_WRAP, SMALL_WRAP, POWER_SPHERE, PRECISION_SPHERE, PRECISION)
GRASP_TYPES = (*TYPES, INVALID)
SPHERES = (POWER_SPHERE, PRECISION_SPHERE)
# The largest diameter that is measured: no limit of a grip's shape is larger.
WIDEST_M = 1.0


class Measures(NamedTuple):
    """Measures of n grasps; every field is (n,)."""

    palm_gap_m: Array
    enclosed_diameter_m: Array
    sideways_share: Array
    span_m: Array

    def select(self, chosen: NDArray[np.bool_]) -> Measures:
        """The grasps where `chosen` (n,) holds."""
        return Measures(*(values[chosen] for values in self))


class Question(NamedTuple):
    """Is a measure above its threshold? `below` and `above` are what follows."""

    measure: int
    """Index into `Measures` and `Thresholds`."""
    name: str
    below: Question | str
    above: Question | str

    def amount(self, value: float) -> str:
        """A value of the measure with its unit."""
        return f"{value:.3f}" if self.name.endswith("share") else f"{value * 1e3:.1f} mm"


TREE = Question(
    0,
    "palm gap",
    below=Question(
        1,
        "enclosed diameter",
        below=SMALL_WRAP,
        above=Question(
            2,
            "sideways share",
            below=Question(3, "fingertip span", below=MEDIUM_WRAP, above=LARGE_WRAP),
            above=POWER_SPHERE,
        ),
    ),
    above=Question(2, "sideways share", below=PRECISION, above=PRECISION_SPHERE),
)


def ways(node: Question | str = TREE) -> dict[str, list[tuple[Question, bool]]]:
    """The questions on the path to each type, left to right, and whether the path is above."""
    if isinstance(node, str):
        return {node: []}
    return {
        name: [(node, above), *way]
        for above, child in ((False, node.below), (True, node.above))
        for name, way in ways(child).items()
    }


WAYS = ways()


class Label(NamedTuple):
    """A grasp type with its explanation."""

    grasp_type: str
    virtual_fingers: int
    branch: str
    """The decisions in words, with the measured values and the thresholds."""
    margin: float
    """Distance to the nearest threshold on the path, as a share of that threshold."""


def measure(field: DistanceField, hands: HandStates, settings: ContactSettings) -> Measures:
    """Measure n grasps of an object whose signed distance is known."""
    contacts = find_contacts(field, hands, settings)
    return Measures(
        contacts.gap_m[:, PALM],
        np.median(enclosed_diameters(hands.hand, hands.joint_positions), axis=1),
        sideways_share(hands.hand, contacts),
        fingertip_span(hands.hand, contacts),
    )


def enclosed_diameters(hand: Hand, joint_positions: ArrayLike) -> Array:
    """Diameters (n, F), metres, of the circle that each finger encloses with the palm.

    The circle touches the palm plane and the centre lines of the links, minus half the thickness of
    the finger; 0 if nothing is left. With the exterior angles a, b, ... at the finger's joints, the
    tangents r tan(a/2) and r tan(b/2) add up to the length of the link between them; with several
    such links, the sums add up. A finger with a single joint encloses what fits between its tip and
    the palm's axis on both sides.

    Args:
        joint_positions: (n, J) rad, prismatic joints m.
    """
    positions = np.asarray(joint_positions, dtype=np.float64)
    diameters = np.empty((len(positions), len(hand.fingers)))
    for column, finger in enumerate(hand.fingers):
        if len(finger.joints) == 1:
            tip = hand.fingertips(positions)[:, column]
            radius = np.linalg.norm(tip[:, :2], axis=1)
        else:
            bends = positions[:, list(finger.joints)] + finger.bend_rad
            tangents = np.tan(bends / 2.0)
            lengths = [
                float(np.linalg.norm(hand.joints[joint].T_parent_rest[:3, 3]))
                for joint in finger.joints[1:]
            ]
            tangent = (tangents[:, :-1] + tangents[:, 1:]).sum(axis=1)
            # Without a circle, the finger is straight in the palm plane, or beyond half a turn.
            other = np.where(bends.sum(axis=1) > 0.0, 0.0, WIDEST_M)
            radius = np.divide(sum(lengths), tangent, out=other, where=tangent > 0.0)
        diameters[:, column] = np.clip(2.0 * (radius - finger.half_thickness_m), 0.0, WIDEST_M)
    return diameters


def sideways_share(hand: Hand, contacts: Contacts) -> Array:
    """Share (n,) of the fingers' push along the palm's x axis, 0 to 1; 0 without contact.

    Without spread the fingers oppose each other in planes of constant x, so this is the push across
    the plane of opposition: mean square of the push's x component, weighted by contact.
    """
    links = list(hand.finger_links)
    weight, sideways = contacts.weight[:, links], contacts.push[:, links, 0] ** 2
    total = weight.sum(axis=1)
    share = (weight * sideways).sum(axis=1)
    return np.asarray(np.divide(share, total, out=np.zeros_like(total), where=total > 0))


def fingertip_span(hand: Hand, contacts: Contacts) -> Array:
    """Distance (n,), metres, from a thumb's contact to the farthest one of the other fingers."""
    tips: dict[bool, list[Array]] = {True: [], False: []}
    for finger in hand.fingers:
        tips[finger.thumb].append(contacts.position_m[:, finger.links[-1]])
    spans = [np.linalg.norm(thumb - tip, axis=1) for thumb in tips[True] for tip in tips[False]]
    return np.asarray(np.max(spans, axis=0))


def thresholds_of(rule: LabellingRule, hand: Hand) -> Thresholds:
    """The thresholds of a hand: lengths grow with its fingers, shares do not."""
    ratio = hand.finger_length_m / rule.finger_length_m
    lengths = ("palm_gap_m", "small_diameter_m", "large_span_m")
    scaled = {name: getattr(rule.thresholds, name) * ratio for name in lengths}
    if hand.grips.sideways_share is not None:
        scaled["sideways_share"] = hand.grips.sideways_share
    return rule.thresholds.changed(**scaled)


def limits(settings: Thresholds | Softness) -> Array:
    """The four numbers (4,) of the settings, in the order of `Measures`."""
    return np.array([value for _, value in settings])


def type_chances(above: Array) -> Array:
    """Probabilities (6, n) of `TYPES` for n grasps.

    Args:
        above: (4, n) in the order of `Measures`, the probability that each is above its threshold;
            0 or 1 if known.
    """
    chances = []
    for name in TYPES:
        chance = np.ones(above.shape[1])
        for question, is_above in WAYS[name]:
            chance = chance * (above[question.measure] if is_above else 1 - above[question.measure])
        chances.append(chance)
    return np.stack(chances)


def classify(measures: Measures, thresholds: ArrayLike) -> NDArray[np.int64]:
    """Indices (n,) into `TYPES` of n grasps, with thresholds (4,) in the order of `Measures`."""
    above = np.stack(measures) > np.asarray(thresholds)[:, None]
    return np.asarray(type_chances(above.astype(np.float64)).argmax(axis=0))


def explain(measures: Measures, thresholds: Thresholds) -> list[Label]:
    """The labels of n grasps, each with its path through the tree."""
    at = limits(thresholds).tolist()
    measured = np.stack(measures, axis=1).tolist()
    types = classify(measures, at).tolist()
    return [_label(TYPES[index], values, at) for index, values in zip(types, measured, strict=True)]


def _label(grasp_type: str, measured: list[float], thresholds: list[float]) -> Label:
    (_, precision), *_ = way = WAYS[grasp_type]
    steps, margins = [], []
    for question, above in way:
        value, limit = measured[question.measure], thresholds[question.measure]
        sign = ">" if above else "<="
        steps.append(f"{question.name} {question.amount(value)} {sign} {question.amount(limit)}")
        margins.append(abs(value - limit) / limit)
    branch = f"{'precision' if precision else 'power'}: {', '.join(steps)}"
    return Label(grasp_type, virtual_fingers(grasp_type), branch, min(margins))


def virtual_fingers(grasp_type: str) -> int:
    """Number of virtual fingers of a grasp type: three for spheres, otherwise two."""
    return 3 if grasp_type in SPHERES else 2
