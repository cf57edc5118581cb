"""Forward kinematics of the BarrettHand, batched, in GraspIt!'s `Barrett` frame.

The origin of the frame is on the palm, +z is the palm normal (the approach), finger 3 is at
y = -50 mm. Chains and their order are GraspIt!'s, as used by the published hand poses; limits are
those of the real hand (BH8-28x), which GraspIt! overstates by four degrees per finger.

Each link frame is at the joint that carries the link and turns with it: z is the joint axis
(positive angles close the finger or open the spread), x points along the link to the next joint,
and y is the grasping side of a finger link.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]

DOF_NAMES = ("spread", "finger_1", "finger_2", "finger_3")
JOINT_NAMES = (
    "spread_1",
    "spread_2",
    "proximal_1",
    "proximal_2",
    "proximal_3",
    "distal_1",
    "distal_2",
    "distal_3",
)
LINK_NAMES = ("palm", "knuckle_1", "knuckle_2", *JOINT_NAMES[2:])

# Ranges of the real hand: Barrett's 28x page (spread 180, finger base 140, fingertip 48 degrees).
DOF_LIMITS_RAD = np.radians([[0.0, 180.0], [0.0, 140.0], [0.0, 140.0], [0.0, 140.0]])
JOINT_LIMITS_RAD = np.radians([[0.0, 180.0]] * 2 + [[0.0, 140.0]] * 3 + [[0.0, 48.0]] * 3)

# libbarrett, GraspIt! and OpenRAVE: the fingertip turns a third of the finger base while coupled.
DISTAL_RATIO = 1.0 / 3.0

# GraspIt!'s Barrett chains. The manual prints the last length as 50 mm, GraspIt! uses 55 mm.
KNUCKLE_LENGTH_M = 0.050
PROXIMAL_LENGTH_M = 0.070
DISTAL_LENGTH_M = 0.055
BASE_OFFSET_M = 0.025
BASE_DEPTH_M = -0.001
SPREAD_REST_RAD = np.radians(90.0)
PROXIMAL_REST_RAD = np.radians(5.0)
DISTAL_REST_RAD = np.radians(40.0)


class Joint(NamedTuple):
    """A revolute joint about the z axis of its child's frame."""

    name: str
    parent: str
    child: str
    T_parent_rest: Array
    """(4, 4) the child's frame in the parent's at angle zero, metres."""


def transform(
    *, x: float = 0.0, y: float = 0.0, z: float = 0.0, axis: str = "z", angle_rad: float = 0.0
) -> Array:
    """A translation (metres) after a rotation about one coordinate axis, as a (4, 4) matrix."""
    first, second = {"x": (1, 2), "y": (2, 0), "z": (0, 1)}[axis]
    matrix = np.eye(4)
    matrix[[first, second], [first, second]] = np.cos(angle_rad)
    matrix[first, second] = -np.sin(angle_rad)
    matrix[second, first] = np.sin(angle_rad)
    matrix[:3, 3] = x, y, z
    return matrix


def _joints() -> tuple[Joint, ...]:
    half_turn, quarter_turn = np.pi, np.pi / 2
    spread = transform(angle_rad=SPREAD_REST_RAD)
    proximal = transform(angle_rad=PROXIMAL_REST_RAD)
    base_1 = transform(x=BASE_OFFSET_M, z=BASE_DEPTH_M, axis="y", angle_rad=half_turn)
    base_2 = transform(x=-BASE_OFFSET_M, z=BASE_DEPTH_M)
    base_3 = transform(y=-KNUCKLE_LENGTH_M, z=BASE_DEPTH_M, axis="y", angle_rad=-quarter_turn)
    mount_1 = transform(x=KNUCKLE_LENGTH_M, axis="x", angle_rad=-quarter_turn)
    mount_2 = transform(x=KNUCKLE_LENGTH_M, axis="x", angle_rad=quarter_turn)
    mount_3 = base_3 @ transform(angle_rad=-quarter_turn)
    distal = transform(x=PROXIMAL_LENGTH_M) @ transform(angle_rad=DISTAL_REST_RAD)
    return (
        Joint("spread_1", "palm", "knuckle_1", base_1 @ spread),
        Joint("spread_2", "palm", "knuckle_2", base_2 @ spread),
        Joint("proximal_1", "knuckle_1", "proximal_1", mount_1 @ proximal),
        Joint("proximal_2", "knuckle_2", "proximal_2", mount_2 @ proximal),
        Joint("proximal_3", "palm", "proximal_3", mount_3 @ proximal),
        *(Joint(f"distal_{i}", f"proximal_{i}", f"distal_{i}", distal) for i in (1, 2, 3)),
    )


JOINTS = _joints()


def couple(dofs_rad: ArrayLike) -> Array:
    """All eight joint angles of a hand whose fingertips are coupled to their finger bases.

    Args:
        dofs_rad: (..., 4) spread, F1, F2, F3 in radians.

    Returns:
        (..., 8) angles in the order of `JOINT_NAMES`. For a finger released by the TorqueSwitch,
        only the distal angle differs: it is between the coupled angle and the upper limit in
        `JOINT_LIMITS_RAD`.
    """
    dofs_rad = np.asarray(dofs_rad, dtype=np.float64)
    spread, fingers = dofs_rad[..., :1], dofs_rad[..., 1:]
    return np.concatenate([spread, spread, fingers, fingers * DISTAL_RATIO], axis=-1)


def link_poses(joint_angles_rad: ArrayLike) -> Array:
    """Poses of all links in the hand's frame.

    Args:
        joint_angles_rad: (..., 8) in the order of `JOINT_NAMES`, radians.

    Returns:
        T_hand_link (..., 9, 4, 4) in the order of `LINK_NAMES`, metres. Column 2 of a pose is the
        joint axis and column 3 a point on it, as needed for a Jacobian.
    """
    angles = np.asarray(joint_angles_rad, dtype=np.float64)
    cosine, sine = np.cos(angles), np.sin(angles)
    poses = np.empty((*angles.shape[:-1], len(LINK_NAMES), 4, 4))
    poses[..., 0, :, :] = np.eye(4)
    for index, joint in enumerate(JOINTS):
        parent = poses[..., LINK_NAMES.index(joint.parent), :, :]
        rest = parent @ joint.T_parent_rest
        child = poses[..., LINK_NAMES.index(joint.child), :, :]
        c, s = cosine[..., index, None], sine[..., index, None]
        child[..., 0] = rest[..., 0] * c + rest[..., 1] * s
        child[..., 1] = rest[..., 1] * c - rest[..., 0] * s
        child[..., 2:] = rest[..., 2:]
    return poses


def fingertips(joint_angles_rad: ArrayLike) -> Array:
    """Ends of the three distal chains in the hand's frame: (..., 8) radians to (..., 3, 3) m."""
    distal = link_poses(joint_angles_rad)[..., -3:, :, :]
    return distal[..., :3, 3] + DISTAL_LENGTH_M * distal[..., :3, 0]


def lag(joint_angles_rad: ArrayLike) -> Array:
    """How far each fingertip is behind the angle coupled to its finger's base, radians.

    Args:
        joint_angles_rad: (..., 8) in the order of `JOINT_NAMES`.

    Returns:
        (..., 3), negative where the TorqueSwitch has let the tip move ahead.
    """
    angles = np.asarray(joint_angles_rad, dtype=np.float64)
    return DISTAL_RATIO * angles[..., 2:5] - angles[..., 5:8]


def beyond_limits(
    angles_rad: ArrayLike, limits_rad: ArrayLike, tolerance_rad: float
) -> NDArray[np.bool_]:
    """Which angles (..., n) lie outside limits (n, 2) by more than a tolerance, all radians."""
    limits = np.asarray(limits_rad, dtype=np.float64)
    angles = np.asarray(angles_rad, dtype=np.float64)
    return (angles < limits[:, 0] - tolerance_rad) | (angles > limits[:, 1] + tolerance_rad)
