"""One grasp, and its grasp type with the reason."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import RigidTransform

from grasptypes.hand.states import HandStates
from grasptypes.labels.contacts import DistanceField
from grasptypes.labels.grasp_type import Label, explain, measure
from grasptypes.settings.grasp_types import GraspTypeSettings


class GraspedObject(Protocol):
    """What a label needs to know of an object."""

    @property
    def distance_grid(self) -> DistanceField:
        """Signed distance in the object's frame."""
        ...


@dataclass(frozen=True)
class Grasp:
    """A hand at an object.

    Attributes:
        T_object_hand: the palm's frame of `hand.kinematics` in the object's, metres.
        joint_angles_rad: (8,) in the order of `kinematics.JOINT_NAMES`.
        object: what is grasped.
        task: what for.
        grasp_type: one of `grasp_type.GRASP_TYPES`; empty if it is not known.
        reason: why physics or geometry rejected the grasp; empty if neither has.
    """

    T_object_hand: RigidTransform
    joint_angles_rad: NDArray[np.float64]
    object: GraspedObject
    task: str = ""
    grasp_type: str = ""
    reason: str = ""


def label(grasp: Grasp, settings: GraspTypeSettings) -> Label:
    """The grasp type by the rule with its explanation, whatever physics says.

    Raises:
        ValueError: not eight joint angles, or not a single pose.
    """
    pose = grasp.T_object_hand.as_matrix()
    angles = np.asarray(grasp.joint_angles_rad, dtype=np.float64)
    if pose.shape != (4, 4) or angles.shape != (8,):
        raise ValueError(
            f"a grasp has one pose and 8 joint angles, not {pose.shape[:-2]} and {angles.shape}"
        )
    hands = HandStates(pose[None], angles[None])
    (found,) = explain(
        measure(grasp.object.distance_grid, hands, settings.contacts), settings.thresholds
    )
    return found
