"""Pictures of a hand on its own: with every preshape, open, half closed and closed."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from grasptypes.hands.checking import preshapes
from grasptypes.hands.hand import Hand
from grasptypes.hands.states import HandStates
from grasptypes.renders.contact_pictures import look_at, plain
from grasptypes.renders.gallery import hand_parts
from grasptypes.renders.renderer import Camera, png_bytes
from grasptypes.reports.sheets import Group, Tile, sheet
from grasptypes.settings.params import Params

# Share of the way from open to the limit of each finger's first joint.
CLOSED = {"open": 0.0, "half closed": 0.5, "closed": 1.0}
AZIMUTHS_RAD = (0.0, np.pi / 2)


def draw_hand(hand: Hand, params: Params) -> bytes:
    """PNG of a hand: a row for each preshape, from two sides."""
    camera_settings = plain(params.renders, params.gallery.size_px)
    groups = []
    with Camera(camera_settings) as camera:
        for preshape in preshapes(hand):
            tiles = [
                Tile(_picture(hand, preshape, share, azimuth_rad, camera), name)
                for name, share in CLOSED.items()
                for azimuth_rad in AZIMUTHS_RAD
            ]
            named = zip(hand.preshape, preshape, strict=True)
            groups.append(Group(", ".join(f"{name} {value:g}" for name, value in named), tiles))
    picture = sheet(groups, len(CLOSED) * len(AZIMUTHS_RAD), params.gallery.tile_px)
    return png_bytes(picture, camera_settings.png_compression)


def _picture(
    hand: Hand, preshape: tuple[float, ...], share: float, azimuth_rad: float, camera: Camera
) -> NDArray[np.uint8]:
    start = np.array([finger.open[0] for finger in hand.fingers])
    limits = hand.dof_limits[len(preshape) :]
    dofs = np.concatenate([preshape, start + share * (limits[:, 1] - start)])
    positions = np.clip(hand.couple(dofs), *hand.joint_limits.T)
    parts = hand_parts(HandStates(hand, np.eye(4)[None], positions[None]))
    scene, node, _ = camera.scene(parts)
    points = np.concatenate([part.vertices for part in parts])
    pose = look_at(points, azimuth_rad, 0.3, camera.settings)
    scene.set_pose(node, pose)
    return camera.compose(camera.shoot(scene), points, pose)
