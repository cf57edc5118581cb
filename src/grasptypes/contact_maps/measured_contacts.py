"""Contact maps from a measurement: where people warmed an object, and hands that would do so.

A scan shows where people touch, not how one of them held. Each session therefore lays a person's
hand on the warm region in many ways and takes one, the likelier the better its print agrees.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from grasptypes.contact_maps.affinities import APPROACHES, AXES, STYLE_OF_GRIP, Hold
from grasptypes.contact_maps.contact_map import (
    ContactMap,
    Points,
    Session,
    draw_hand,
    of_sessions,
    opposes,
)
from grasptypes.contact_maps.handprint import Surface, handprint
from grasptypes.contact_maps.placement import place_hand
from grasptypes.errors import InputError
from grasptypes.objects.contact_scan import ContactScan, read_contact_scan
from grasptypes.seeds import rng

Array = NDArray[np.float64]
GRIPS = tuple(STYLE_OF_GRIP)
# Fewer warm points have no longest extent that a hand could lie along.
MIN_WARM_POINTS = 3


def read_probability(
    path: str | Path, metres: float, points: Points, params: Mapping[str, Any]
) -> Array:
    """The probability (N,) of touch that a scan shows at an object's surface points.

    Args:
        path: a PLY as `read_contact_scan` takes it, in the object's frame.
        metres: length of the file's unit, times the object's scale.
        points: of the prepared object.
        params: the `contact_maps` section of params.yaml.

    Raises:
        InputError: the file is no contact map, shows no difference between places, lies elsewhere
            than the object, or shows nothing warm.
    """
    scan, measured = read_contact_scan(path, metres), params["measured"]
    if np.nanmin(scan.intensity) == np.nanmax(scan.intensity):
        raise InputError(
            path, "red", "is the same wherever it is not 0: no place is warmer than another"
        )
    seen = transferred(scan, points.points_m, measured)
    share = float(np.isfinite(seen).mean())
    if share < measured["min_seen_share"]:
        raise InputError(
            path,
            "",
            f"covers {share:.0%} of the object (within {measured['max_gap_m']} m of its vertices); "
            f"{measured['min_seen_share']:.0%} are needed: is it in the object's unit and frame?",
        )
    probability = np.nan_to_num(seen, nan=0.0)
    if (probability >= params["threshold"]).sum() < MIN_WARM_POINTS:
        raise InputError(
            path, "red", f"has almost no warm vertices (probability {params['threshold']} or more)"
        )
    return probability


def transferred(scan: ContactScan, points_m: Array, measured: Mapping[str, float]) -> Array:
    """Probability (N,) at points (N, 3) m of the nearest vertex; NaN where it or none is seen."""
    distance_m, nearest = cKDTree(scan.points_m).query(points_m)
    values = sigmoid(scan.intensity, measured["coldest"], measured["warmest"])[nearest]
    return np.where(distance_m <= measured["max_gap_m"], values, np.nan)


def sigmoid(intensity: Array, coldest: float, warmest: float) -> Array:
    """Map intensities to probabilities by the sigmoid that takes the least to `coldest` and the
    largest to `warmest` (ContactDB's post-processing: 0.05 and 0.95); NaN stays."""
    low, high = np.nanmin(intensity), np.nanmax(intensity)
    ends = np.log([coldest / (1 - coldest), warmest / (1 - warmest)])
    logit = ends[0] + (intensity - low) / (high - low) * (ends[1] - ends[0])
    return 1.0 / (1.0 + np.exp(-logit))


def map_measured_contacts(
    points: Points,
    part_names: Sequence[str],
    probability: Array,
    name: tuple[str, str],
    seed_number: int,
    params: Mapping[str, Any],
    scale: float,
    path: str | Path,
) -> ContactMap:
    """The contact map of a measured probability (N,) and of sessions drawn from it.

    Args:
        name: object and task.
        params: the `contact_maps` section of params.yaml.
        path: where the probability comes from, to be named if nobody can hold the object so.
    """
    people = [
        draw_measured_session(
            points, probability, (*name, number, seed_number), params, scale, path
        )
        for number in range(1, params["sessions"] + 1)
    ]
    return of_sessions(points, part_names, probability, people)


def draw_measured_session(
    points: Points,
    probability: Array,
    key: tuple[str, str, int, int],
    params: Mapping[str, Any],
    scale: float,
    path: str | Path,
    grips: Sequence[str] = GRIPS,
) -> Session:
    """One person's way of holding an object where it was measured to be held.

    Args:
        probability: (N,) of touch.
        key: object, task, session and seed: all that the draw depends on beside the parameters.
        grips: of the affinity table, that the person may choose from.

    Raises:
        InputError: in none of the placements thumb and fingers end up on two sides.
    """
    draw = rng("measured_contacts", *key)
    hand = draw_hand(draw, params, scale)
    warm = probability >= params["threshold"]
    held = Surface(points.points_m, points.normals, warm)
    # Skin also lies beside what is warm, or a palm would agree with a map of fingertips.
    margin_m = cKDTree(points.points_m[warm]).query(points.points_m)[0]
    reached = Surface(points.points_m, points.normals, margin_m <= 2 * hand.pad_radius_m)
    sessions, weights = [], []
    for _ in range(params["measured"]["placements"]):
        hold = _any_hold(draw, grips)
        placement, height = place_hand(held, hold, hand, params["placement"], draw)
        contact = handprint(reached, hold.grip, placement, hand)
        if opposes(points.normals[contact >= params["threshold"]], placement.closing):
            sessions.append(Session(hold, placement, height, hand, contact))
            weights.append(_agreement(contact, probability) ** params["measured"]["sharpness"])
    if not sessions:
        raise InputError(
            path,
            "",
            f"no hand can hold {key[0]} where the map is warm: in "
            f"{params['measured']['placements']} placements thumb and fingers found no "
            "opposing sides",
        )
    shares = np.cumsum(weights)
    return sessions[int(np.searchsorted(shares, draw.uniform(0.0, shares[-1]), side="right"))]


def _any_hold(draw: np.random.Generator, grips: Sequence[str]) -> Hold:
    """Any of the grips from any side, as a row of the affinity table on the whole object."""
    grip, approach, axis = (str(draw.choice(choices)) for choices in (grips, APPROACHES, AXES))
    return Hold((), grip, approach, axis, 0.0, 1.0, 1.0, "measured")


def _agreement(contact: Array, probability: Array) -> float:
    """Cosine between a print and a map: 1 if it covers all that is warm, and no more."""
    return float(contact @ probability / np.linalg.norm(contact) / np.linalg.norm(probability))
