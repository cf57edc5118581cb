"""Contact maps from a measurement: where people warmed an object, and hands that would do so.

A scan shows where people touch, not how one of them held. Each session therefore lays a person's
hand on the warm region in many ways and takes one, the likelier the better its print agrees.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from grasptypes.contact_maps.affinities import APPROACHES, AXES, STYLE_OF_GRIP, AffinityRow
from grasptypes.contact_maps.contact_map import ContactMap, MapTask, Session, of_sessions
from grasptypes.contact_maps.handprint import HeldSurface, handprint
from grasptypes.contact_maps.placement import place_hand
from grasptypes.errors import InputError
from grasptypes.objects.contact_scan import ContactScan, read_contact_scan
from grasptypes.seeds import rng
from grasptypes.settings.contact_maps import MeasuredMapSettings

Array = NDArray[np.float64]
GRIPS = tuple(STYLE_OF_GRIP)
# Fewer warm points have no longest extent that a hand could lie along.
MIN_WARM_POINTS = 3


def read_probability(path: str | Path, unit_m: float, task: MapTask) -> Array:
    """The probability (N,) of touch that a scan shows at an object's surface points.

    Args:
        path: a PLY as `read_contact_scan` takes it, in the object's frame.
        unit_m: length of the file's unit; the file has the size of the object before scaling.

    Raises:
        InputError: the file is no contact map, shows no difference between places, lies elsewhere
            than the object, or shows nothing warm.
    """
    scan, measured = read_contact_scan(path, task.scale * unit_m), task.settings.measured
    if np.nanmin(scan.intensity) == np.nanmax(scan.intensity):
        raise InputError(path, "red", "is the same wherever it is not 0: nothing is warmer")
    seen = transferred(scan, task.points.points_m, measured)
    share = float(np.isfinite(seen).mean())
    if share < measured.min_seen_share:
        raise InputError(
            path,
            "",
            f"shows {share:.0%} of the object (its vertices and {measured.max_gap_m} m around), "
            f"{measured.min_seen_share:.0%} are needed: is it in the object's unit and frame?",
        )
    probability = np.nan_to_num(seen, nan=0.0)
    threshold = task.settings.threshold
    if (probability >= threshold).sum() < MIN_WARM_POINTS:
        raise InputError(path, "red", f"is warm (probability {threshold} or more) almost nowhere")
    return probability


def transferred(scan: ContactScan, points_m: Array, measured: MeasuredMapSettings) -> Array:
    """Probability (N,) at points (N, 3) m of the nearest vertex; NaN where it or none is seen."""
    distance_m, nearest = cKDTree(scan.points_m).query(points_m)
    values = sigmoid(scan.intensity, measured.coldest, measured.warmest)[nearest]
    return np.where(distance_m <= measured.max_gap_m, values, np.nan)


def sigmoid(intensity: Array, coldest: float, warmest: float) -> Array:
    """Map intensities to probabilities by the sigmoid that takes the least to `coldest` and the
    largest to `warmest` (ContactDB's post-processing: 0.05 and 0.95); NaN stays."""
    low, high = np.nanmin(intensity), np.nanmax(intensity)
    ends = np.log([coldest / (1 - coldest), warmest / (1 - warmest)])
    logit = ends[0] + (intensity - low) / (high - low) * (ends[1] - ends[0])
    return 1.0 / (1.0 + np.exp(-logit))


def map_measured_contacts(task: MapTask, probability: Array, path: str | Path) -> ContactMap:
    """The contact map of a measured probability (N,) and of sessions drawn from it.

    Args:
        path: where the probability comes from.

    Raises:
        InputError: in none of a session's placements thumb and fingers end up on two sides.
    """
    people = []
    for number in range(1, task.settings.sessions + 1):
        person = draw_measured_session(task, probability, number)
        if person is None:
            count = task.settings.measured.placements
            raise InputError(
                path,
                "",
                f"no hand can hold {task.name[0]} where it is to be touched: in {count} "
                "placements thumb and fingers found no two sides",
            )
        people.append(person)
    return of_sessions(task, probability, people)


def draw_measured_session(
    task: MapTask, probability: Array, number: int, grips: Sequence[str] = GRIPS
) -> Session | None:
    """One person's way of holding an object where it was measured to be held.

    Args:
        probability: (N,) of touch.
        grips: of the affinity table, that the person may choose from.

    Returns:
        None if thumb and fingers end up on two sides in none of the placements.
    """
    points, settings = task.points, task.settings
    draw = rng("measured_contacts", *task.key(number))
    hand = task.draw_hand(draw)
    warm = probability >= settings.threshold
    held = HeldSurface(points.points_m, points.normals, warm)
    # Skin also lies beside what is warm, or a palm would agree with a map of fingertips.
    margin_m = cKDTree(points.points_m[warm]).query(points.points_m)[0]
    reached = HeldSurface(points.points_m, points.normals, margin_m <= 2 * hand.pad_radius_m)
    sessions, weights = [], []
    for _ in range(settings.measured.placements):
        row = _any_row(draw, grips)
        placement, height = place_hand(held, row, hand, settings.placement, draw)
        contact = handprint(reached, row.grip, placement, hand)
        if task.opposes(contact, placement.closing):
            sessions.append(Session(row, placement, height, hand, contact))
            weights.append(_agreement(contact, probability) ** settings.measured.sharpness)
    if not sessions:
        return None
    shares = np.cumsum(weights)
    return sessions[int(np.searchsorted(shares, draw.uniform(0.0, shares[-1]), side="right"))]


def _any_row(draw: np.random.Generator, grips: Sequence[str]) -> AffinityRow:
    """Any of the grips from any side, as a row of the affinity table on the whole object."""
    grip, approach, axis = (str(draw.choice(choices)) for choices in (grips, APPROACHES, AXES))
    return AffinityRow((), grip, approach, axis, 0.0, 1.0, 1.0, "measured")


def _agreement(contact: Array, probability: Array) -> float:
    """Cosine between a print and a map: 1 if it covers all that is warm, and no more."""
    return float(contact @ probability / np.linalg.norm(contact) / np.linalg.norm(probability))
