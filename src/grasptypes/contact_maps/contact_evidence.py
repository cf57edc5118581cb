"""Evidence for the affinity table: where the published hand poses hold the objects.

A pose is replayed on its object; the points of the hand's surface that are close to the object are
its contact. The parts, and the position of the contact along the object, come from our model.
"""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

import numpy as np
import pandas as pd
import pandera.pandas as pa
import trimesh
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from grasptypes.contact_maps.affinities import SIDES
from grasptypes.hands import configuration
from grasptypes.hands.hand import PALM, Hand
from grasptypes.hands.surface import surface_points
from grasptypes.labels.replay import read_reference_mesh
from grasptypes.objects.distance_grid import signed_distance
from grasptypes.objects.object_files import Surface
from grasptypes.settings.contact_maps import ContactEvidenceSettings

Array = NDArray[np.float64]

# The grip of the affinity table for each published label (Figure 2 of the paper).
GRIP_OF_TYPE = {
    "Large Wrap": "wrap",
    "Medium Wrap": "wrap",
    "Small Wrap": "wrap",
    "Power Sphere": "enclose",
    "Precision Sphere": "tripod",
    "Precision": "pinch",
}

_SHARE = pa.Check.in_range(0, 1)
_GRIP = pa.Column(str, pa.Check.isin(sorted(set(GRIP_OF_TYPE.values()))))
_SIDE, _AXIS = pa.Column(str, pa.Check.isin(SIDES)), pa.Column(str, pa.Check.isin(["x", "y", "z"]))
# Position of the contact in the object's bounding box.
POSITION = ("contact_x", "contact_y", "contact_z")
_POSITION = {name: pa.Column(float, _SHARE) for name in POSITION}
EVIDENCE_SCHEMA = pa.DataFrameSchema(
    {
        **{"object": pa.Column(str), "task": pa.Column(str), "session": pa.Column(int)},
        **{"grip": _GRIP, "part": pa.Column(str), "palm_side": _SIDE},
        "palm_side_cosine": pa.Column(float, pa.Check.in_range(0.57, 1.0)),
        **{"axis": _AXIS, "palm_gap_mm": pa.Column(float, pa.Check.ge(0)), **_POSITION},
        "spread_deg": pa.Column(float),
    },
    strict=True,
    ordered=True,
)
PATTERN_SCHEMA = pa.DataFrameSchema(
    {
        **{"class": pa.Column(str), "task": pa.Column(str), "grip": _GRIP},
        **{"n": pa.Column(int, pa.Check.ge(1)), "share": pa.Column(float, _SHARE)},
    },
    strict=True,
    unique=["class", "task", "grip"],
)
SUMMARY_SCHEMA = pa.DataFrameSchema(
    {
        **{"object": pa.Column(str), "task": pa.Column(str), "grip": pa.Column(str)},
        **{"palm_side": _SIDE, "axis": _AXIS, "n": pa.Column(int, pa.Check.ge(1))},
        **{"share": pa.Column(float, _SHARE), "palm_touches": pa.Column(float, _SHARE)},
        **{"palm_gap_mm": pa.Column(float, pa.Check.ge(0)), **_POSITION},
        **{"spread_deg": pa.Column(float), "part": pa.Column(str)},
    },
    strict=True,
    ordered=True,
)

# Objects with published poses, by what is held. The grips of a class are the pattern for objects
# without poses.
CLASSES = {
    "vessels": ("bowl", "mug", "utah_teapot", "water_bottle", "wine_glass"),
    "compact": ("apple", "banana", "cell_phone", "stapler"),
    "handles": ("flashlight", "hammer", "scissors", "toothbrush"),
}
# A palm this close supports the object: median gaps are 1 to 8 mm in power grasps, 55 to 59 in
# precision grasps.
PALM_CARRIES_MM = 15.0


class PartPoints(NamedTuple):
    """Points (N, 3) on our object, metres, with part indices (N,) and the parts' names."""

    points_m: Array
    part_index: NDArray[np.int16]
    part_names: list[str]


def object_evidence(
    grasps: pd.DataFrame,
    hand: Hand,
    surface: Surface,
    scan: Path,
    scale: float,
    settings: ContactEvidenceSettings,
) -> list[dict[str, str | int | float]]:
    """Evidence of all published grasps of one object.

    Args:
        grasps: rows of `published.read_published` with a configuration and a valid label.
        hand: the hand of their poses.
        surface: our model, in metres at the grasped scale.
        scan: mesh of the real object at scale 1; if there is none, our model is used.
    """
    mesh = trimesh.Trimesh(surface.vertices, surface.faces, process=False)
    ours_m = np.asarray(surface.vertices) - _standing_origin(mesh)
    mesh.apply_translation(-_standing_origin(mesh))
    if scan.is_file():
        mesh = read_reference_mesh(scan, scale)
    names = [str(part) for part in surface.part_names]
    ours = PartPoints(ours_m, surface.part_index, names)
    lengths = settings.hand_spacing_m, settings.touch_m
    return [session_evidence(grasp, hand, mesh, ours, *lengths) for _, grasp in grasps.iterrows()]


def session_evidence(
    grasp: pd.Series,
    hand: Hand,
    mesh: trimesh.Trimesh,
    ours: PartPoints,
    spacing_m: float,
    touch_m: float,
) -> dict[str, str | int | float]:
    """One row of evidence: how one published grasp holds its object.

    Args:
        grasp: a row of `published.read_published` with a configuration and a valid label.
        hand: the hand of its pose.
        mesh: the object of the pose, metres, in the pose's frame.
        ours: our model of the same object in the same frame.
        spacing_m: distance between neighbouring points on the hand.
        touch_m: largest distance that counts as touching.
    """
    posed = configuration.unpack(grasp.hand_configuration)
    poses = posed.T_object_hand @ hand.link_poses(hand.couple(posed.dofs))
    surface = surface_points(hand, spacing_m)
    T = poses[surface.link_index]
    points = np.einsum("pij,pj->pi", T[:, :3, :3], surface.points_m) + T[:, :3, 3]
    distance_m = signed_distance(points, mesh.vertices, mesh.faces)
    # A pose that touches nothing is classified by what it is closest to.
    touching = distance_m < max(touch_m, distance_m.min() + touch_m / 2)
    _, nearest = cKDTree(ours.points_m).query(points[touching])
    side, cosine = _nearest_side(-posed.T_object_hand[:3, 2])
    height = _relative(ours.points_m[nearest], ours.points_m)
    palm = surface.link_index == PALM
    return {
        "object": grasp.object,
        "task": grasp.task,
        "session": int(grasp.session),
        "grip": GRIP_OF_TYPE[grasp.grasp_type],
        "part": _touched_parts(ours, nearest),
        "palm_side": side,
        "palm_side_cosine": round(cosine, 3),
        "axis": _nearest_side(posed.T_object_hand[:3, 0])[0][1],
        "palm_gap_mm": round(1e3 * max(float(distance_m[palm].min()), 0.0), 1),
        **{name: round(float(share), 3) for name, share in zip(POSITION, height, strict=True)},
        "spread_deg": round(float(np.degrees(posed.dofs[0])), 1),
    }


def summarise(evidence: pd.DataFrame) -> pd.DataFrame:
    """Grasps by object, task, grip and palm side: number, position, and most frequent part.

    Args:
        evidence: rows of :func:`session_evidence`.
    """
    keys = ["object", "task", "grip", "palm_side", "axis"]
    groups = evidence.groupby(keys, sort=True)
    table = groups.agg(
        n=("session", "size"),
        palm_touches=("palm_gap_mm", lambda gap: (gap < PALM_CARRIES_MM).mean()),
        **{name: (name, "median") for name in ("palm_gap_mm", *POSITION, "spread_deg")},
        part=("part", lambda parts: parts.value_counts().index[0]),
    )
    share = table.n / table.groupby(["object", "task"]).n.transform("sum")
    table.insert(1, "share", share.round(3))
    return table.round(3).reset_index()


def pattern(grasps: pd.DataFrame) -> pd.DataFrame:
    """Share of each grip by class of object and task, among all published grasps with a type.

    Args:
        grasps: the table of `published.read_published`.

    Returns:
        class, task, grip, n, share: the pattern for objects without poses.
    """
    class_of = {name: kind for kind, names in CLASSES.items() for name in names}
    labelled = grasps.assign(
        **{"class": grasps.object.map(class_of), "grip": grasps.grasp_type.map(GRIP_OF_TYPE)}
    ).dropna(subset=["class", "grip"])
    table = labelled.groupby(["class", "task", "grip"], sort=True).size().rename("n").reset_index()
    share = table.n / table.groupby(["class", "task"]).n.transform("sum")
    return table.assign(share=share.round(3))


def _standing_origin(mesh: trimesh.Trimesh) -> Array:
    """Origin (3,) of the frame of the published poses: on the ground below the object's centre."""
    low, high = mesh.bounds
    return np.array([*(low[:2] + high[:2]) / 2, low[2]])


def _nearest_side(direction: Array) -> tuple[str, float]:
    axis = int(np.argmax(np.abs(direction)))
    return f"{'+' if direction[axis] > 0 else '-'}{'xyz'[axis]}", float(abs(direction[axis]))


def _relative(points: Array, body: Array) -> Array:
    """Mean position (3,) of points in the bounding box of a body, 0 to 1 along each axis."""
    low, high = body.min(axis=0), body.max(axis=0)
    return np.asarray(np.clip((points.mean(axis=0) - low) / (high - low), 0.0, 1.0))


def _touched_parts(ours: PartPoints, nearest: NDArray[np.int64]) -> str:
    """Names of the parts with at least a fifth of the contact, the most touched first."""
    counts = np.bincount(ours.part_index[nearest], minlength=len(ours.part_names))
    order = np.argsort(-counts, kind="stable")
    return "+".join(ours.part_names[i] for i in order if counts[i] >= 0.2 * counts.sum())
