"""Contact maps from a measurement: where people warmed an object, and hands that match it.

A scan shows where people touched, not how each of them held the object. Each session therefore
places a person's hand on the warm region in many ways and draws one of them, weighted by how well
its handprint agrees with the map.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from grasptypes.contact_maps.contact_map import ContactMap, MapTask, Session, of_sessions
from grasptypes.contact_maps.hold import STYLE_OF_GRIP, Hold
from grasptypes.contact_maps.placement import HeldSurface
from grasptypes.errors import InputError
from grasptypes.objects.contact_scan import ContactScan, read_contact_scan
from grasptypes.seeds import rng
from grasptypes.settings.contact_maps import MeasuredMapSettings

Array = NDArray[np.float64]
GRIPS = tuple(STYLE_OF_GRIP)
SIDES = np.array([sign * axis for axis in np.eye(3) for sign in (1.0, -1.0)])
# Fewer warm points do not define a longest extent.
MIN_WARM_POINTS = 3


def read_probability(path: str | Path, unit_m: float, task: MapTask) -> Array:
    """Touch probability (N,) at an object's surface points according to a scan.

    Args:
        path: a PLY for `read_contact_scan`, in the object's frame.
        unit_m: length of the file's unit; the file has the size of the object before scaling.

    Raises:
        InputError: the file is not a contact map, has no contrast, does not match the object's
            position, or shows nothing warm.
    """
    scan, measured = read_contact_scan(path, task.scale * unit_m), task.settings.measured
    if np.nanmin(scan.intensity) == np.nanmax(scan.intensity):
        raise InputError(path, "red", "is the same wherever it is not 0: no place is warmer")
    seen = transferred(scan, task.points.points_m, measured)
    share = float(np.isfinite(seen).mean())
    if share < measured.min_seen_share:
        raise InputError(
            path,
            "",
            f"covers {share:.0%} of the object (within {measured.max_gap_m} m of its vertices); "
            f"{measured.min_seen_share:.0%} are needed: is it in the object's unit and frame?",
        )
    probability = np.nan_to_num(seen, nan=0.0)
    threshold = task.settings.threshold
    if (probability >= threshold).sum() < MIN_WARM_POINTS:
        said = f"has almost no warm vertices (probability {threshold} or more)"
        raise InputError(path, "red", said)
    return probability


def transferred(scan: ContactScan, points_m: Array, measured: MeasuredMapSettings) -> Array:
    """Probability (N,) of the vertex nearest to points (N, 3) m; NaN if unseen or too far away."""
    distance_m, nearest = cKDTree(scan.points_m).query(points_m)
    values = sigmoid(scan.intensity, measured.coldest, measured.warmest)[nearest]
    return np.where(distance_m <= measured.max_gap_m, values, np.nan)


def sigmoid(intensity: Array, coldest: float, warmest: float) -> Array:
    """Map intensities to probabilities by the sigmoid that maps the minimum to `coldest` and the
    maximum to `warmest` (ContactDB's post-processing: 0.05 and 0.95); NaN stays NaN."""
    low, high = np.nanmin(intensity), np.nanmax(intensity)
    ends = np.log([coldest / (1 - coldest), warmest / (1 - warmest)])
    logit = ends[0] + (intensity - low) / (high - low) * (ends[1] - ends[0])
    return np.asarray(1.0 / (1.0 + np.exp(-logit)))


def map_measured_contacts(task: MapTask, probability: Array, path: str | Path) -> ContactMap:
    """Contact map from a measured probability (N,) and sessions drawn from it.

    Args:
        path: source of the probability, for errors.

    Raises:
        InputError: a session has no placement with thumb and fingers on opposing sides.
    """
    people = []
    for number in range(1, task.settings.sessions + 1):
        person = draw_measured_session(task, probability, number)
        if person is None:
            count = task.settings.measured.placements
            raise InputError(
                path,
                "",
                f"no hand can hold {task.name[0]} where the map is warm: in {count} "
                "placements thumb and fingers found no opposing sides",
            )
        people.append(person)
    return of_sessions(task, probability, people)


def draw_measured_session(
    task: MapTask, probability: Array, number: int, grips: Sequence[str] = GRIPS
) -> Session | None:
    """One person's way of holding an object where a measured map is warm.

    Args:
        probability: (N,) touch probability.
        grips: grips to choose from.

    Returns:
        None if thumb and fingers find no opposing sides in any placement.
    """
    points, settings = task.points, task.settings
    draw = rng("measured_contacts", *task.key(number))
    hand = task.draw_hand(draw)
    warm = probability >= settings.threshold
    held = HeldSurface(points.points_m, points.normals, warm)
    # The print may extend beyond the warm region; otherwise a palm would match a map of fingertips.
    margin_m = cKDTree(points.points_m[warm]).query(points.points_m)[0]
    reached = HeldSurface(points.points_m, points.normals, margin_m <= 2 * hand.pad_radius_m)
    sessions, weights = [], []
    for _ in range(settings.measured.placements):
        hold = _any_hold(draw, grips)
        if session := task.try_hold(held, hold, hand, draw, reached):
            sessions.append(session)
            agreement = _agreement(session.contact, probability)
            weights.append(agreement**settings.measured.sharpness)
    if not sessions:
        return None
    shares = np.cumsum(weights)
    return sessions[int(np.searchsorted(shares, draw.uniform(0.0, shares[-1]), side="right"))]


def _any_hold(draw: np.random.Generator, grips: Sequence[str]) -> Hold:
    """A random grip on the whole object, from a random side of a random axis."""
    grip = str(draw.choice(grips))
    # Any side of the axis is one more choice, and so is the longest extent as the axis.
    side, axis = int(draw.integers(-1, len(SIDES))), int(draw.integers(-1, 3))
    return Hold(
        parts=(),
        touchable=(),
        grip=grip,
        sides=None if side < 0 else SIDES[side][None],
        axis=None if axis < 0 else np.eye(3)[axis],
        low=0.0,
        high=1.0,
        probability=1.0,
    )


def _agreement(contact: Array, probability: Array) -> float:
    """Cosine similarity of a handprint and a map: 1 if it covers exactly the warm region."""
    return float(contact @ probability / np.linalg.norm(contact) / np.linalg.norm(probability))
