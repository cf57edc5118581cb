"""The grasp type of a measured grasp: the decision tree of the paper's Figure 2.

Four thresholds decide, each on one length or share that can be measured on any grasp:

- power or precision: does the object lie at the palm, or do the fingers alone carry it?
- small wrap: a hand closed around a diameter this small presses the object to the palm with all
  fingers, whatever the spread: the fingers are one virtual finger, the palm the other;
- virtual fingers: fingers that push within one plane are two that oppose; as soon as a share of
  the push goes across that plane, a third virtual finger acts from there: a sphere;
- large or medium wrap: the distance between the contacts of the opposing fingertips.

See docs/grasp_types.md for the types' names elsewhere.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from grasptypes.hand import kinematics
from grasptypes.hand.parts import DISTAL_HUB_RADIUS_M
from grasptypes.labels.contacts import DISTAL_LINKS, FINGER_LINKS, PALM, Contacts

Array = NDArray[np.float64]

LARGE_WRAP, MEDIUM_WRAP, SMALL_WRAP = "Large Wrap", "Medium Wrap", "Small Wrap"
POWER_SPHERE, PRECISION_SPHERE, PRECISION = "Power Sphere", "Precision Sphere", "Precision"
INVALID = "Invalid"
# Spelled and ordered as the published table; its GraspTypeIndex counts from 1.
GRASP_TYPES = (
    LARGE_WRAP,
    MEDIUM_WRAP,
    SMALL_WRAP,
    POWER_SPHERE,
    PRECISION_SPHERE,
    PRECISION,
    INVALID,
)


class Thresholds(NamedTuple):
    """Where the tree branches."""

    palm_gap_m: float
    """Up to this gap between palm and object a grasp is a power grasp, metres."""
    small_diameter_m: float
    """Up to this enclosed diameter a power grasp is a small wrap, metres."""
    sideways_share: float
    """Above this share of sideways push a third virtual finger acts, 0 to 1."""
    large_span_m: float
    """Above this span between opposing fingertips a wrap is large, metres."""


class Measures(NamedTuple):
    """What is measured on n grasps; every field is (n,)."""

    palm_gap_m: Array
    enclosed_diameter_m: Array
    sideways_share: Array
    span_m: Array


class Label(NamedTuple):
    """A grasp type with its explanation."""

    grasp_type: str
    virtual_fingers: int
    branch: str
    """The decisions in words, with the measured values and the thresholds."""
    margin: float
    """Distance to the nearest threshold passed, as a share of that threshold."""


def measure(contacts: Contacts, joint_angles_rad: ArrayLike) -> Measures:
    """Measure n grasps.

    Args:
        contacts: of n poses.
        joint_angles_rad: (n, 8) in the order of `kinematics.JOINT_NAMES`.
    """
    return Measures(
        contacts.gap_m[:, PALM],
        np.median(enclosed_diameters(joint_angles_rad), axis=1),
        sideways_share(contacts),
        fingertip_span(contacts),
    )


def enclosed_diameters(joint_angles_rad: ArrayLike) -> Array:
    """Diameters (n, 3), metres, of the circle that each finger encloses with the palm.

    The circle touches the palm's plane and the middle lines of both links, less the links' half
    thickness; 0 where nothing is left. With the exterior angles a and b at the finger's two joints,
    the tangents r tan(a/2) and r tan(b/2) fill the proximal link's length.

    Args:
        joint_angles_rad: (n, 8) in the order of `kinematics.JOINT_NAMES`.
    """
    angles = np.asarray(joint_angles_rad, dtype=np.float64)
    base = angles[:, 2:5] + kinematics.PROXIMAL_REST_RAD
    tip = angles[:, 5:8] + kinematics.DISTAL_REST_RAD
    radius = kinematics.PROXIMAL_LENGTH_M / (np.tan(base / 2.0) + np.tan(tip / 2.0))
    return np.maximum(2.0 * (radius - DISTAL_HUB_RADIUS_M), 0.0)


def sideways_share(contacts: Contacts) -> Array:
    """Share (n,) of the fingers' push that goes along the palm's x axis, 0 to 1; 0 without contact.

    At spread 0 the fingers oppose each other in planes of constant x, so this is the push across
    the plane of opposition: mean square of the push's x component, weighted by contact.
    """
    links = list(FINGER_LINKS)
    weight, sideways = contacts.weight[:, links], contacts.push[:, links, 0] ** 2
    total = weight.sum(axis=1)
    share = (weight * sideways).sum(axis=1)
    return np.divide(share, total, out=np.zeros_like(total), where=total > 0)


def fingertip_span(contacts: Contacts) -> Array:
    """Distance (n,), metres, from finger 3's contact to the further one of fingers 1 and 2."""
    first, second, third = (contacts.position_m[:, link] for link in DISTAL_LINKS)
    spans = [np.linalg.norm(third - other, axis=1) for other in (first, second)]
    return np.maximum(*spans)


def classify(measures: Measures, thresholds: Thresholds) -> NDArray[np.int64]:
    """Indices (n,) into `GRASP_TYPES`, 0 to 5: the tree, for all grasps at once."""
    at_palm = measures.palm_gap_m <= thresholds.palm_gap_m
    small = measures.enclosed_diameter_m <= thresholds.small_diameter_m
    three = measures.sideways_share > thresholds.sideways_share
    large = measures.span_m > thresholds.large_span_m
    conditions = [at_palm & small, at_palm & three, at_palm & large, at_palm, three]
    types = [SMALL_WRAP, POWER_SPHERE, LARGE_WRAP, MEDIUM_WRAP, PRECISION_SPHERE]
    indices = [GRASP_TYPES.index(name) for name in types]
    return np.select(conditions, indices, default=GRASP_TYPES.index(PRECISION))


def explain(measures: Measures, thresholds: Thresholds) -> list[Label]:
    """The labels of n grasps, each with its way through the tree."""
    types = classify(measures, thresholds)
    return [
        _explain(GRASP_TYPES[grasp_type], values.tolist(), thresholds)
        for grasp_type, values in zip(types, np.stack(measures, axis=1), strict=True)
    ]


def _explain(grasp_type: str, measured: list[float], thresholds: Thresholds) -> Label:
    """The explanation of one grasp whose type is known, measured in the order of `Measures`."""
    names = ("palm gap", "enclosed diameter", "sideways share", "fingertip span")
    palm, small, sideways, large = zip(names, measured, thresholds, strict=True)
    if grasp_type in (PRECISION, PRECISION_SPHERE):
        kind, passed = "precision", [palm, sideways]
    else:
        kind, passed = "power", [palm, small, sideways, large]
        passed = passed[: {SMALL_WRAP: 2, POWER_SPHERE: 3}.get(grasp_type, 4)]
    steps = [_step(*threshold) for threshold in passed]
    margins = [abs(value - limit) / limit for _, value, limit in passed]
    fingers = 3 if grasp_type in (POWER_SPHERE, PRECISION_SPHERE) else 2
    return Label(grasp_type, fingers, f"{kind}: " + ", ".join(steps), float(min(margins)))


def _step(name: str, value: float, limit: float) -> str:
    sign = ">" if value > limit else "<="
    if name.endswith("share"):
        return f"{name} {value:.3f} {sign} {limit:.3f}"
    return f"{name} {value * 1e3:.1f} mm {sign} {limit * 1e3:.1f} mm"
