"""Images of a hand that uses an object or hands it over."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
import pandas as pd
import trimesh
from numpy.typing import ArrayLike, NDArray
from scipy.spatial import cKDTree
from scipy.spatial.transform import Rotation

from grasptypes.errors import InputError
from grasptypes.hands.hand import Hand
from grasptypes.hands.states import HandStates
from grasptypes.objects.object_files import Surface
from grasptypes.renders.gallery import CREASE_RAD, hand_parts, state_of
from grasptypes.renders.gallery_views import finger_points
from grasptypes.renders.grasp_film import moved
from grasptypes.renders.randomisation import draw_view
from grasptypes.renders.renderer import Camera, Views
from grasptypes.renders.scene import Part, unit
from grasptypes.seeds import rng
from grasptypes.settings.demonstrations import (
    DEMONSTRATIONS,
    Body,
    SceneSettings,
    Use,
    read_demonstrations,
)

Array = NDArray[np.float64]

# Vertices this close to the outermost one of a part belong to the place where it acts.
END_M = 0.003
ROUGHNESS = 0.7
# Of an object's vertices, which are 3 mm apart, every tenth tells how near a hand is.
OBJECT_STEP = 10


@dataclass(frozen=True)
class Shown:
    """An object with what is needed to show it in hands.

    Attributes:
        name: of the object.
        parts: visible parts, object frame.
        surface: with the parts' names.
        hand: that of the grasps.
    """

    name: str
    parts: Sequence[Part]
    surface: Surface
    hand: Hand


def scenes(
    shown: Shown, grasps: pd.DataFrame, task: str, settings: SceneSettings, alone: bool = False
) -> list[list[Part]]:
    """Scenes (z up) of an object at a task, one per grasp.

    Args:
        grasps: valid ones.
        alone: without the second hand or the bodies that the task needs.
    """
    if task == "handoff":
        return handovers(shown, grasps, settings, alone)
    return uses(shown, grasps, settings, task, alone)


def uses(
    shown: Shown,
    grasps: pd.DataFrame,
    settings: SceneSettings,
    task: str = "use",
    alone: bool = False,
) -> list[list[Part]]:
    """Scenes (z up) of an object in use, one per grasp; hands that touch the bodies least first.

    Args:
        grasps: valid ones.
        task: any but `handoff`.
        alone: without the bodies.

    Raises:
        InputError: the table does not say how the object is used, or names a part it lacks.
    """
    table = read_demonstrations()
    use = table.use_of(shown.name, task)
    action = table.actions[use.action]
    found = []
    for row in grasps.itertuples():
        state = state_of(shown.hand, row)
        T_world_object = _placed(shown, use, action.acts, state)
        points = _points(state) @ T_world_object[:3, :3].T + T_world_object[:3, 3]
        inside = sum(_inside(body, points).mean() for body in action.bodies)
        scene = moved([*shown.parts, *hand_parts(state)], T_world_object)
        bodies = [] if alone else map(body_part, action.bodies)
        found.append((inside, [*scene, *bodies]))
    return _first(found, settings.grasps)


def handovers(
    shown: Shown, grasps: pd.DataFrame, settings: SceneSettings, alone: bool = False
) -> list[list[Part]]:
    """Scenes (z up) of an object that a second, open hand is about to take, one per grasp.

    The second hand approaches for another grasp of the object, that which is farthest from the
    first hand; it comes as near as the settings say.

    Args:
        grasps: valid ones.
        alone: without the second hand.
    """
    rows = list(grasps.itertuples())
    givers = [_points(state_of(shown.hand, row)) for row in rows]
    takers = [_points(_open(shown.hand, row)) for row in rows]
    found = []
    for row, giver in zip(rows, givers, strict=True):
        away = [taker.mean(axis=0) - giver.mean(axis=0) for taker in takers]
        best = int(np.argmax(np.linalg.norm(away, axis=1)))
        across = unit(away[best])
        kept_away = np.concatenate([giver, shown.surface.vertices[::OBJECT_STEP]])
        gap_m = float(cKDTree(takers[best]).query(kept_away)[0].min())
        nearer = np.eye(4)
        nearer[:3, 3] = -max(gap_m - settings.handover_m, 0) * across
        T_world_object = np.eye(4)
        T_world_object[:3, :3] = _upright(across)
        taker = moved(hand_parts(_open(shown.hand, rows[best])), nearer)
        giving = hand_parts(state_of(shown.hand, row))
        parts = [*shown.parts, *giving, *([] if alone else taker)]
        found.append((-gap_m, moved(parts, T_world_object)))
    return _first(found, settings.grasps)


def _first(found: list[tuple[float, list[Part]]], most: int) -> list[list[Part]]:
    """The scenes with the lowest numbers.

    Raises:
        InputError: there is none.
    """
    if not found:
        raise InputError("data/grasps", "", "no valid grasp to show")
    return [scene for _, scene in sorted(found, key=lambda one: one[0])[:most]]


def pictures(
    scenes: Sequence[Sequence[Part]],
    camera: Camera,
    draws: tuple[str, int],
    settings: SceneSettings,
) -> Iterator[bytes]:
    """PNG files of the scenes in turn, each from a random side.

    Args:
        draws: a name and the workflow's seed, which determine the views.
    """
    for number in range(settings.views):
        parts, name = scenes[number % len(scenes)], f"{draws[0]} {number}"
        vertices = np.concatenate([part.vertices for part in parts])
        random = rng("demonstration", name, draws[1])
        pose, _ = draw_view(vertices, settings.view, camera.settings, random)
        yield from Views(camera, parts, pose[None], name, draws[1]).pngs()


def body_part(body: Body) -> Part:
    """A body as it is rendered."""
    make = {
        "ball": lambda: trimesh.creation.icosphere(subdivisions=3, radius=0.5),
        "box": lambda: trimesh.creation.box((1, 1, 1)),
        "cylinder": lambda: trimesh.creation.cylinder(radius=0.5, height=1, sections=48),
    }
    mesh = make[body.shape]().apply_scale(body.size_m)
    mesh = trimesh.graph.smooth_shade(mesh, angle=CREASE_RAD)
    part = Part(
        np.asarray(mesh.vertices),
        np.asarray(mesh.vertex_normals),
        np.asarray(mesh.faces),
        np.array(body.rgb),
        0.0,
        ROUGHNESS,
    )
    return moved([part], _pose(body))[0]


def _pose(body: Body) -> Array:
    pose = np.eye(4)
    pose[:3, :3] = Rotation.from_euler("xyz", body.turn_deg, degrees=True).as_matrix()
    pose[:3, 3] = body.at_m
    return pose


def _inside(body: Body, points: Array) -> NDArray[np.bool_]:
    """Which points (N, 3) are in a body."""
    pose = _pose(body)
    own = np.abs((points - pose[:3, 3]) @ pose[:3, :3]) / (np.array(body.size_m) / 2)
    inside = {
        "ball": np.linalg.norm(own, axis=1),
        "box": own.max(axis=1),
        "cylinder": np.maximum(np.linalg.norm(own[:, :2], axis=1), own[:, 2]),
    }
    return np.asarray(inside[body.shape] < 1)


def _placed(shown: Shown, use: Use, acts: str, state: HandStates) -> Array:
    """T_world_object (4, 4) that puts the acting end of a used object at 0."""
    ahead, up = np.array(use.ahead), np.array(use.up)
    if use.round:
        hand = _points(state).mean(axis=0)
        angle = np.arctan2(-hand[1], -hand[0]) - np.arctan2(ahead[1], ahead[0])
        turn = Rotation.from_rotvec([0, 0, angle]).as_matrix()
        ahead, up = turn @ ahead, turn @ up
    ahead, up = unit(ahead), unit(up - (up @ unit(ahead)) * unit(ahead))
    surface = shown.surface
    names = list(surface.part_names)
    if use.part and use.part not in names:
        message = f"'{use.part}' is not a part: {', '.join(names)}"
        raise InputError(DEMONSTRATIONS, f"uses.{shown.name}.part", message)
    chosen = [names.index(use.part)] if use.part else range(len(names))
    points = surface.vertices[np.isin(surface.part_index, chosen)]
    along = points @ (ahead if acts == "ahead" else -up)
    T_world_object = np.eye(4)
    T_world_object[:3, :3] = [ahead, np.cross(up, ahead), up]
    end = points[along > along.max() - END_M].mean(axis=0)
    T_world_object[:3, 3] = -T_world_object[:3, :3] @ end
    return T_world_object


def _upright(across: ArrayLike) -> Array:
    """R_world_object (3, 3) that lays a direction along x, the z axis as high as it can be."""
    x = unit(across)
    other = np.eye(3)[2] if abs(x[2]) < 0.9 else np.eye(3)[0]
    z = unit(other - (other @ x) * x)
    return np.array([x, np.cross(z, x), z])


def _points(state: HandStates) -> Array:
    """Points (N, 3) on one hand, object frame."""
    return np.concatenate(finger_points(state))


def _open(hand: Hand, row: object) -> HandStates:
    """The open hand before a grasp."""
    pose = np.eye(4)
    pose[:3] = np.reshape(row.pregrasp_pose, (3, 4))  # type: ignore[attr-defined]
    joints = np.asarray(row.pregrasp_joints, dtype=np.float64)  # type: ignore[attr-defined]
    return HandStates(hand, pose[None], joints[None])
