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

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from grasptypes.hand import kinematics
from grasptypes.hand.parts import DISTAL_HUB_RADIUS_M
from grasptypes.labels.contacts import DISTAL_LINKS, FINGER_LINKS, PALM, Contacts
from grasptypes.settings.grasp_types import Thresholds

Array = NDArray[np.float64]

LARGE_WRAP, MEDIUM_WRAP, SMALL_WRAP = "Large Wrap", "Medium Wrap", "Small Wrap"
POWER_SPHERE, PRECISION_SPHERE, PRECISION = "Power Sphere", "Precision Sphere", "Precision"
INVALID = "Invalid"
# Spelled and ordered as in the published table, where GraspTypeIndex starts at 1.
GRASP_TYPES = (
    LARGE_WRAP,
    MEDIUM_WRAP,
    SMALL_WRAP,
    POWER_SPHERE,
    PRECISION_SPHERE,
    PRECISION,
    INVALID,
)


class Branch(NamedTuple):
    """A question of the tree: is a measure above its threshold?"""

    measure: str
    """A field of `Measures`."""
    threshold: str
    """A field of `Thresholds`."""
    name: str
    below: Branch | str
    """What follows if it is not: another question or a grasp type."""
    above: Branch | str


_SPHERE_OR_WRAP = Branch(
    "sideways_share",
    "sideways_share",
    "sideways share",
    below=Branch("span_m", "large_span_m", "fingertip span", MEDIUM_WRAP, LARGE_WRAP),
    above=POWER_SPHERE,
)
TREE = Branch(
    "palm_gap_m",
    "palm_gap_m",
    "palm gap",
    below=Branch(
        "enclosed_diameter_m",
        "small_diameter_m",
        "enclosed diameter",
        below=SMALL_WRAP,
        above=_SPHERE_OR_WRAP,
    ),
    above=Branch("sideways_share", "sideways_share", "sideways share", PRECISION, PRECISION_SPHERE),
)


def virtual_fingers(grasp_type: str) -> int:
    """Number of virtual fingers of a grasp type: three for spheres, otherwise two."""
    return 3 if grasp_type in (POWER_SPHERE, PRECISION_SPHERE) else 2


def leaves(branch: Branch | str = TREE) -> list[str]:
    """The grasp types below a branch, from left to right."""
    if isinstance(branch, str):
        return [branch]
    return leaves(branch.below) + leaves(branch.above)


class Measures(NamedTuple):
    """Measures of n grasps; every field is (n,)."""

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
    """Distance to the nearest threshold on the path, as a share of that threshold."""


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

    The circle touches the palm plane and the centre lines of both links, minus half the thickness
    of the links; 0 if nothing is left. With the exterior angles a and b at the finger's two joints,
    the tangents r tan(a/2) and r tan(b/2) add up to the length of the proximal link.

    Args:
        joint_angles_rad: (n, 8) in the order of `kinematics.JOINT_NAMES`.
    """
    angles = np.asarray(joint_angles_rad, dtype=np.float64)
    base = angles[:, 2:5] + kinematics.PROXIMAL_REST_RAD
    tip = angles[:, 5:8] + kinematics.DISTAL_REST_RAD
    radius = kinematics.PROXIMAL_LENGTH_M / (np.tan(base / 2.0) + np.tan(tip / 2.0))
    return np.maximum(2.0 * (radius - DISTAL_HUB_RADIUS_M), 0.0)


def sideways_share(contacts: Contacts) -> Array:
    """Share (n,) of the fingers' push along the palm's x axis, 0 to 1; 0 without contact.

    At spread 0 the fingers oppose each other in planes of constant x, so this is the push across
    the plane of opposition: mean square of the push's x component, weighted by contact.
    """
    links = list(FINGER_LINKS)
    weight, sideways = contacts.weight[:, links], contacts.push[:, links, 0] ** 2
    total = weight.sum(axis=1)
    share = (weight * sideways).sum(axis=1)
    return np.divide(share, total, out=np.zeros_like(total), where=total > 0)


def fingertip_span(contacts: Contacts) -> Array:
    """Distance (n,), metres, from finger 3's contact to the farther one of fingers 1 and 2."""
    first, second, third = (contacts.position_m[:, link] for link in DISTAL_LINKS)
    spans = [np.linalg.norm(third - other, axis=1) for other in (first, second)]
    return np.maximum(*spans)


def type_chances(above: Mapping[str, Array]) -> Array:
    """Probabilities (6, n) of the first six `GRASP_TYPES` for n grasps.

    Args:
        above: by measure, the probability (n,) that it is above its threshold; 0 or 1 if known.
    """
    chances: dict[str, Array] = {}

    def follow(branch: Branch | str, chance: Array | float) -> None:
        """Distribute a probability over the leaves below a branch."""
        if isinstance(branch, str):
            chances[branch] = np.asarray(chance)
            return
        follow(branch.below, chance * (1 - above[branch.measure]))
        follow(branch.above, chance * above[branch.measure])

    follow(TREE, 1.0)
    return np.stack([chances[name] for name in GRASP_TYPES[:-1]])


def classify(measures: Measures, thresholds: Thresholds) -> NDArray[np.int64]:
    """Apply the tree: indices (n,) into `GRASP_TYPES`, 0 to 5."""
    limits = measure_limits(thresholds)
    above = {
        name: (values > limits[name]).astype(np.float64)
        for name, values in measures._asdict().items()
    }
    return type_chances(above).argmax(axis=0)


def measure_limits(thresholds: Thresholds, branch: Branch | str = TREE) -> dict[str, float]:
    """The threshold of each of `Measures` at and below a branch."""
    if isinstance(branch, str):
        return {}
    below = measure_limits(thresholds, branch.below) | measure_limits(thresholds, branch.above)
    return {branch.measure: getattr(thresholds, branch.threshold)} | below


def explain(measures: Measures, thresholds: Thresholds) -> list[Label]:
    """The labels of n grasps, each with its path through the tree."""
    columns = {name: values.tolist() for name, values in measures._asdict().items()}
    rows = zip(*columns.values(), strict=True)
    return [_explain(dict(zip(columns, row, strict=True)), thresholds) for row in rows]


def _explain(measured: Mapping[str, float], thresholds: Thresholds) -> Label:
    """The label of one grasp."""
    branch: Branch | str = TREE
    steps, margins = [], []
    while isinstance(branch, Branch):
        value, limit = measured[branch.measure], getattr(thresholds, branch.threshold)
        sign = ">" if value > limit else "<="
        amounts = amount(branch.measure, value), amount(branch.measure, limit)
        steps.append(f"{branch.name} {amounts[0]} {sign} {amounts[1]}")
        margins.append(abs(value - limit) / limit)
        branch = branch.above if value > limit else branch.below
    kind = "power" if branch in leaves(TREE.below) else "precision"
    way = f"{kind}: " + ", ".join(steps)
    return Label(branch, virtual_fingers(branch), way, float(min(margins)))


def amount(measure: str, value: float) -> str:
    """A value of one of `Measures` as text, with its unit."""
    return f"{value:.3f}" if measure.endswith("share") else f"{value * 1e3:.1f} mm"
