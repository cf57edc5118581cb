"""Images of grasps: the hand on its object, from a viewpoint that shows the fingers."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pandas as pd
import trimesh
from numpy.typing import NDArray

from grasptypes.hands import configuration
from grasptypes.hands.hand import Hand
from grasptypes.hands.links import Visual
from grasptypes.hands.states import HandStates
from grasptypes.renders.contact_pictures import look_at
from grasptypes.renders.gallery_views import best_azimuth, finger_points
from grasptypes.renders.renderer import Camera
from grasptypes.renders.scene import Part, surface_points
from grasptypes.seeds import rng

Array = NDArray[np.float64]

# Reflectance of the hand's materials; their colours are those of the hand model.
METALLIC = {"aluminium": 0.6}
ROUGHNESS = {"anodised": 0.45, "aluminium": 0.4, "rubber": 0.9}
PLASTIC_ROUGHNESS = 0.6
# Edges sharper than this are shaded as edges.
CREASE_RAD = 0.6
# Points that represent an object's surface: 5 per cell on the largest object, the pan.
OBJECT_POINTS = 6000


def hand_parts(state: HandStates) -> list[Part]:
    """The visible parts of one hand, posed in the object frame."""
    return [
        replace(
            part,
            vertices=part.vertices @ pose[:3, :3].T + pose[:3, 3],
            normals=part.normals @ pose[:3, :3].T,
        )
        for pose, link in zip(state.link_poses()[0], _link_parts(state.hand), strict=True)
        for part in link
    ]


@cache
def _link_parts(hand: Hand) -> tuple[tuple[Part, ...], ...]:
    """The parts of each link in its frame, with smooth shading between edges."""
    return tuple(tuple(_part(visual) for visual in link.visuals) for link in hand.links)


def _part(visual: Visual) -> Part:
    mesh = trimesh.Trimesh(visual.vertices_m, visual.faces)
    mesh = trimesh.graph.smooth_shade(mesh, angle=CREASE_RAD)
    return Part(
        vertices=np.asarray(mesh.vertices),
        normals=np.asarray(mesh.vertex_normals),
        faces=np.asarray(mesh.faces),
        base_colour=np.array(visual.rgba[:3]),
        metallic=METALLIC.get(visual.material, 0.0),
        roughness=ROUGHNESS.get(visual.material, PLASTIC_ROUGHNESS),
    )


def grasp_picture(
    thing: list[Part], state: HandStates, camera: Camera, elevation_rad: float
) -> NDArray[np.uint8]:
    """Image (size, size, 3) of a grasp, from where object and fingers are seen best."""
    parts = [*thing, *hand_parts(state)]
    outside = surface_points(thing, OBJECT_POINTS, rng("gallery"))
    hand = finger_points(state)
    azimuth_rad = best_azimuth(outside, *hand, elevation_rad)
    scene, node, _ = camera.scene(parts)
    points = np.concatenate([part.vertices for part in parts])
    pose = look_at(points, azimuth_rad, elevation_rad, camera.settings)
    scene.set_pose(node, pose)
    return camera.compose(camera.shoot(scene), points, pose)


def best_grasp(grasps: pd.DataFrame) -> Any | None:
    """The row of the valid grasp with the lowest energy, if any."""
    valid = grasps[grasps.valid]
    return None if valid.empty else valid.loc[valid.energy.idxmin()]


def state_of(hand: Hand, row: Any) -> HandStates:
    """The hand, as one state, of a row of grasps or attempts."""
    posed = configuration.unpack(np.asarray(row.hand_configuration, dtype=np.float64))
    positions = np.asarray(row.joint_angles_rad, dtype=np.float64)
    return HandStates(hand, posed.T_object_hand[None], positions[None])
