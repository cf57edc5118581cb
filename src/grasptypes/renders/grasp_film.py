"""Short animations of grasps: the hand stays, the object moves."""

from __future__ import annotations

import io
from collections.abc import Sequence
from dataclasses import replace
from typing import Protocol

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from grasptypes.hands.hand import Hand
from grasptypes.hands.states import HandStates
from grasptypes.renders.contact_pictures import look_at
from grasptypes.renders.gallery import OBJECT_POINTS, hand_parts
from grasptypes.renders.gallery_views import best_azimuth, finger_points
from grasptypes.renders.renderer import Camera
from grasptypes.renders.scene import Part, surface_points
from grasptypes.seeds import rng

Array = NDArray[np.float64]
COLOURS = 128


class Moment(Protocol):
    """What a frame shows."""

    @property
    def T_hand_object(self) -> Array:
        """(4, 4) the object in the hand."""

    @property
    def joint_positions(self) -> Array:
        """(J,)."""


def film(
    thing: list[Part],
    hand: Hand,
    T_object_hand: Array,
    moments: Sequence[Moment],
    camera: Camera,
    elevation_rad: float,
) -> list[NDArray[np.uint8]]:
    """Images (size, size, 3) of moments, from where object and fingers are seen best at first.

    Args:
        T_object_hand: (4, 4) the hand at the beginning; it stays there.
    """
    first = HandStates(hand, T_object_hand[None], moments[0].joint_positions[None])
    outside = surface_points(thing, OBJECT_POINTS, rng("gallery"))
    azimuth_rad = best_azimuth(outside, *finger_points(first), elevation_rad)
    points = np.concatenate([part.vertices for part in [*thing, *hand_parts(first)]])
    pose = look_at(points, azimuth_rad, elevation_rad, camera.settings)
    pictures = []
    for moment in moments:
        state = HandStates(hand, T_object_hand[None], moment.joint_positions[None])
        parts = [*moved(thing, T_object_hand @ moment.T_hand_object), *hand_parts(state)]
        scene, node, _ = camera.scene(parts)
        scene.set_pose(node, pose)
        shown = np.concatenate([part.vertices for part in parts])
        pictures.append(camera.compose(camera.shoot(scene), shown, pose))
    return pictures


def moved(parts: Sequence[Part], T: Array) -> list[Part]:
    """The parts after a motion (4, 4)."""
    return [
        replace(
            part,
            vertices=part.vertices @ T[:3, :3].T + T[:3, 3],
            normals=part.normals @ T[:3, :3].T,
        )
        for part in parts
    ]


def gif_bytes(pictures: Sequence[NDArray[np.uint8]], frame_s: float, pause_s: float) -> bytes:
    """An animation that repeats, with a pause on the last image."""
    frames = [
        Image.fromarray(picture).quantize(COLOURS, dither=Image.Dither.NONE)
        for picture in pictures
    ]  # fmt: skip
    times_ms = [round(frame_s * 1e3)] * (len(frames) - 1) + [round(pause_s * 1e3)]
    buffer = io.BytesIO()
    frames[0].save(
        buffer, "GIF", save_all=True, append_images=frames[1:], duration=times_ms, loop=0
    )
    return buffer.getvalue()
