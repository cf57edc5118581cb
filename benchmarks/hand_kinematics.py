"""Forward kinematics of a hand beside what two physics engines make of its own hand.urdf."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

import mujoco
import numpy as np
import pybullet
from numpy.typing import NDArray
from trimesh.transformations import euler_matrix

from grasptypes.hands.description import HandDescription
from grasptypes.hands.folders import DESCRIPTION, URDF
from grasptypes.hands.hand import Hand
from grasptypes.poses import inverse
from grasptypes.seeds import rng
from grasptypes.yaml_files import read_yaml

Array = NDArray[np.float64]


class Marks(NamedTuple):
    """Points of a hand that its own URDF names: origins of links, and ends of fingers."""

    links: tuple[str, ...]
    tips_m: Array
    """(F, 3) in the frames of `tip_links` of the URDF."""
    tip_links: tuple[int, ...]
    """Indices in `links`."""
    T_palm_hand: Array

    def of(self, T_palm_link: Array) -> Array:
        """(n, L + F, 3) in the hand's frame, of link poses (n, L, 4, 4)."""
        T = inverse(self.T_palm_hand) @ T_palm_link
        tips = T[:, list(self.tip_links)]
        ends = np.einsum("nfij,fj->nfi", tips[..., :3, :3], self.tips_m) + tips[..., :3, 3]
        return np.concatenate([T[..., :3, 3], ends], axis=1)


def kinematics_errors(hand: Hand, number: int) -> tuple[float, float]:
    """Largest distance in metres of a joint or fingertip from where PyBullet and MuJoCo have it.

    The engines load the hand's own hand.urdf, not the one written for physics tests.

    Args:
        number: of random joint vectors within the limits.
    """
    path = Path(hand.folder) / DESCRIPTION
    described = HandDescription.check(read_yaml(path), path)
    palm, fingers = described.palm, described.fingers
    T_palm_hand = np.asarray(euler_matrix(*palm.rpy_rad, "sxyz"))
    T_palm_hand[:3, 3] = palm.xyz_m
    tips = np.array([fingers[finger.name].tip_m for finger in hand.fingers])
    links = tuple(link - 1 for link in hand.tip_links)
    marks = Marks(hand.link_names[1:], tips, links, T_palm_hand)
    low, high = hand.joint_limits.T
    draw = rng("benchmark", "kinematics", path.parent.name)
    positions = draw.uniform(low, high, (number, len(hand.joints)))
    origins = hand.link_poses(positions)[:, 1:, :3, 3]
    own = np.concatenate([origins, hand.fingertips(positions)], axis=1)
    urdf = Path(hand.folder) / URDF
    bullet, other = (
        float(np.linalg.norm(marks.of(poses(urdf, hand, positions)) - own, axis=-1).max())
        for poses in (_bullet_poses, _mujoco_poses)
    )
    return bullet, other


def _bullet_poses(urdf: Path, hand: Hand, positions: Array) -> Array:
    """T_palm_link (n, L - 1, 4, 4) of the URDF's links."""
    client = pybullet.connect(pybullet.DIRECT)
    try:
        body = pybullet.loadURDF(str(urdf), useFixedBase=True, physicsClientId=client)
        count = pybullet.getNumJoints(body, physicsClientId=client)
        infos = [pybullet.getJointInfo(body, j, physicsClientId=client) for j in range(count)]
        joints = {info[1].decode(): info[0] for info in infos}
        links = {info[12].decode(): info[0] for info in infos}
        found = np.empty((len(positions), len(hand.link_names), 4, 4))
        for row, sample in enumerate(positions):
            for name, position in zip(hand.joint_names, sample.tolist(), strict=True):
                pybullet.resetJointState(body, joints[name], position, physicsClientId=client)
            for column, name in enumerate(hand.link_names):
                found[row, column] = _bullet_pose(client, body, links.get(name))
    finally:
        pybullet.disconnect(client)
    return inverse(found[:, :1]) @ found[:, 1:]


def _bullet_pose(client: int, body: int, link: int | None) -> Array:
    """T_root_link; the root, which has no number, is the origin."""
    T = np.eye(4)
    if link is not None:
        state = pybullet.getLinkState(
            body, link, computeForwardKinematics=True, physicsClientId=client
        )
        T[:3, :3] = np.reshape(pybullet.getMatrixFromQuaternion(state[5]), (3, 3))
        T[:3, 3] = state[4]
    return T


def _mujoco_poses(urdf: Path, hand: Hand, positions: Array) -> Array:
    """T_palm_link (n, L - 1, 4, 4) of the URDF's links."""
    spec = mujoco.MjSpec.from_file(str(urdf))
    spec.compiler.fusestatic = False
    for shape in (*spec.geoms, *spec.meshes):
        spec.delete(shape)
    model = spec.compile()
    data = mujoco.MjData(model)
    places = [model.joint(name).qposadr[0] for name in hand.joint_names]
    bodies = [model.body(name).id for name in hand.link_names]
    found = np.zeros((len(positions), len(bodies), 4, 4))
    found[..., 3, 3] = 1.0
    for T, sample in zip(found, positions, strict=True):
        data.qpos[places] = sample
        mujoco.mj_kinematics(model, data)
        T[:, :3, :3] = data.xmat[bodies].reshape(-1, 3, 3)
        T[:, :3, 3] = data.xpos[bodies]
    return inverse(found[:, :1]) @ found[:, 1:]
