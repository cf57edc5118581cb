"""Pictures of grasps: the hand on its object, seen from where the fingers show."""

from __future__ import annotations

import numpy as np
import pandas as pd
import trimesh
from numpy.typing import ArrayLike, NDArray

from grasptypes.contact_maps.contact_pictures import look_at
from grasptypes.hand import configuration, kinematics
from grasptypes.hand.visuals import MATERIALS, link_visuals
from grasptypes.renders.renderer import Camera
from grasptypes.renders.scene import Part

Array = NDArray[np.float64]

# How the hand's materials reflect light; their colours are the hand's own.
METALLIC = {"aluminium": 0.6}
ROUGHNESS = {"anodised": 0.45, "aluminium": 0.4, "rubber": 0.9}
# Edges sharper than this stay edges.
CREASE_RAD = 0.6
AZIMUTHS = 24
# What it counts to see a hand from in front, beside seeing it from its side.
FRONT_MERIT = 0.35


def hand_parts(T_object_hand: ArrayLike, joint_angles_rad: ArrayLike) -> list[Part]:
    """What the hand shows, posed in the object's frame.

    Args:
        T_object_hand: (4, 4) metres.
        joint_angles_rad: (8,) in the order of `kinematics.JOINT_NAMES`.
    """
    poses = np.asarray(T_object_hand) @ kinematics.link_poses(joint_angles_rad)
    parts = []
    for pose, link in zip(poses, link_visuals(), strict=True):
        for visual in link:
            mesh = trimesh.Trimesh(visual.vertices_m, visual.faces)
            mesh = trimesh.graph.smooth_shade(mesh, angle=CREASE_RAD).apply_transform(pose)
            parts.append(
                Part(
                    vertices=np.asarray(mesh.vertices),
                    normals=np.asarray(mesh.vertex_normals),
                    faces=np.asarray(mesh.faces),
                    base_colour=np.array(MATERIALS[visual.material][:3]),
                    metallic=METALLIC.get(visual.material, 0.0),
                    roughness=ROUGHNESS[visual.material],
                )
            )
    return parts


def grasp_picture(
    thing: list[Part],
    T_object_hand: Array,
    joint_angles_rad: ArrayLike,
    camera: Camera,
    elevation_rad: float,
) -> NDArray[np.uint8]:
    """A grasp (size, size, 3), seen across the direction in which the fingers close."""
    parts = [*thing, *hand_parts(T_object_hand, joint_angles_rad)]
    scene, node, _ = camera.scene(parts)
    points = np.concatenate([part.vertices for part in parts])
    pose = look_at(points, _azimuth(T_object_hand, elevation_rad), elevation_rad, camera.studio)
    scene.set_pose(node, pose)
    return camera.compose(camera.shoot(scene), points, pose)


def _azimuth(T_object_hand: Array, elevation_rad: float) -> float:
    """Direction around the object's z from which fingers, thumb and what they hold are seen best.

    That is from the hand's side, and rather from in front than over its back.
    """
    angles = np.linspace(-np.pi, np.pi, AZIMUTHS, endpoint=False)
    flat = np.cos(elevation_rad)
    height = np.full(AZIMUTHS, np.sin(elevation_rad))
    views = np.column_stack([flat * np.cos(angles), flat * np.sin(angles), height])
    merit = np.abs(views @ T_object_hand[:3, 0]) + FRONT_MERIT * (views @ T_object_hand[:3, 2])
    return float(angles[merit.argmax()])


def best_grasp(grasps: pd.DataFrame) -> tuple[Array, Array] | None:
    """T_object_hand (4, 4) and angles (8,) of the valid grasp with the lowest energy, if any."""
    valid = grasps[grasps.valid]
    if valid.empty:
        return None
    row = valid.loc[valid.energy.idxmin()]
    hand = configuration.unpack(np.asarray(row.hand_configuration, dtype=np.float64))
    return hand.T_object_hand, np.asarray(row.joint_angles_rad, dtype=np.float64)
