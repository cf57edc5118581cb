"""A grasp as one object."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pandas as pd
from numpy.typing import NDArray
from scipy.spatial.transform import RigidTransform

from grasptypes.hands import configuration
from grasptypes.hands.hand import Hand
from grasptypes.hands.states import HandStates
from grasptypes.labels.dataset import VALID
from grasptypes.labels.grasp_type import Label, explain, measure, thresholds_of
from grasptypes.objects.object_geometry import ObjectGeometry
from grasptypes.settings.grasp_types import GraspTypeSettings
from grasptypes.settings.params import checkout_params

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Grasp:
    """A hand at an object.

    Attributes:
        object: the object.
        task: the task.
        hand: the hand that holds it.
        T_object_hand: the hand's frame in the object's, metres.
        joint_positions: (J,) in the order of `Hand.joints`; rad, prismatic joints m.
        grasp_type: one of `GRASP_TYPES`; `Invalid` if the physics test rejects the grasp.
        reason: `valid`, or why the physics test rejects it.
        energy: energy of the search; lower is better.
    """

    object: ObjectGeometry
    task: str
    hand: Hand
    T_object_hand: RigidTransform
    joint_positions: Array
    grasp_type: str
    reason: str
    energy: float


def grasps_of(table: pd.DataFrame, geometry: ObjectGeometry, hand: Hand) -> list[Grasp]:
    """The grasps of one object in a table of `dataset.label_grasps`, in order."""
    return [
        Grasp(
            object=geometry,
            task=row.task,
            hand=hand,
            T_object_hand=RigidTransform(
                configuration.unpack(row.hand_configuration).T_object_hand, normalize=False
            ),
            joint_positions=np.array(row.joint_angles_rad, dtype=np.float64),
            grasp_type=row.grasp_type,
            reason=VALID if row.valid else row.reason,
            energy=float(row.energy),
        )
        for row in table.itertuples()
    ]


def label(grasp: Grasp, settings: GraspTypeSettings | None = None) -> Label:
    """The grasp type by the rule, regardless of the physics test, with its explanation.

    Args:
        settings: settings of the rule; default: from params.yaml in the current folder, else those
            that come with the package.

    Raises:
        InputError: params.yaml is invalid.
    """
    rule = settings or checkout_params().grasp_types
    poses, positions = grasp.T_object_hand.as_matrix()[None], grasp.joint_positions[None]
    states = HandStates(grasp.hand, poses, positions)
    measures = measure(grasp.object.distance_grid, states, rule.contacts)
    return explain(measures, thresholds_of(rule, grasp.hand))[0]
