"""A hand's URDF in PyBullet."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from grasptypes.hands.hand import Hand


@contextmanager
def loaded(urdf: Path) -> Iterator[tuple[Any, int, int]]:
    """PyBullet, a client of it, and the body."""
    pybullet = pytest.importorskip("pybullet")
    client = pybullet.connect(pybullet.DIRECT)
    try:
        flags = pybullet.URDF_USE_INERTIA_FROM_FILE
        body = pybullet.loadURDF(str(urdf), useFixedBase=True, flags=flags, physicsClientId=client)
        yield pybullet, client, body
    finally:
        pybullet.disconnect(client)


def bullet_poses(urdf: Path, hand: Hand, positions: np.ndarray) -> np.ndarray:
    """Poses (n, L - 1, 3, 4) of all links but the palm, in the order of the hand's links."""
    found = np.empty((*positions.shape, 3, 4))
    with loaded(urdf) as (pybullet, client, body):
        names = [
            pybullet.getJointInfo(body, j, physicsClientId=client)[1].decode()
            for j in range(pybullet.getNumJoints(body, physicsClientId=client))
        ]
        places = [names.index(name) for name in hand.joint_names]
        for row, sample in enumerate(positions):
            for place, position in zip(places, sample, strict=True):
                pybullet.resetJointState(body, place, position, physicsClientId=client)
            for column, place in enumerate(places):
                state = pybullet.getLinkState(
                    body, place, computeForwardKinematics=True, physicsClientId=client
                )
                rotation = pybullet.getMatrixFromQuaternion(state[5])
                found[row, column, :, :3] = np.reshape(rotation, (3, 3))
                found[row, column, :, 3] = state[4]
    return found
