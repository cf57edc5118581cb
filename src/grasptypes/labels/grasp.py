"""A grasp as one object."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pandas as pd
from numpy.typing import NDArray
from scipy.spatial.transform import RigidTransform

from grasptypes.hand import configuration
from grasptypes.hand.states import HandStates
from grasptypes.labels.dataset import VALID
from grasptypes.labels.grasp_type import Label, explain, measure
from grasptypes.objects.object_geometry import ObjectGeometry
from grasptypes.settings.grasp_types import GraspTypeSettings
from grasptypes.settings.params import read_params

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Grasp:
    """A hand at an object.

    Attributes:
        object: the object.
        task: the task.
        T_object_hand: the palm's frame of `hand.kinematics` in the object's, metres.
        joint_angles_rad: (8,) in the order of `kinematics.JOINT_NAMES`.
        grasp_type: one of `GRASP_TYPES`; `Invalid` if the physics test rejects the grasp.
        reason: `valid`, or why the physics test rejects it.
        energy: energy of the search; lower is better.
    """

    object: ObjectGeometry
    task: str
    T_object_hand: RigidTransform
    joint_angles_rad: Array
    grasp_type: str
    reason: str
    energy: float


def grasps_of(table: pd.DataFrame, geometry: ObjectGeometry) -> list[Grasp]:
    """The grasps of one object in a table of `dataset.label_grasps`, in order."""
    return [
        Grasp(
            object=geometry,
            task=row.task,
            T_object_hand=RigidTransform(
                configuration.unpack(row.hand_configuration).T_object_hand, normalize=False
            ),
            joint_angles_rad=np.array(row.joint_angles_rad, dtype=np.float64),
            grasp_type=row.grasp_type,
            reason=VALID if row.valid else row.reason,
            energy=float(row.energy),
        )
        for row in table.itertuples()
    ]


def label(grasp: Grasp, settings: GraspTypeSettings | None = None) -> Label:
    """The grasp type by the rule, regardless of the physics test, with its explanation.

    Args:
        settings: settings of the rule; by default those in params.yaml in the current folder.

    Raises:
        InputError: there are neither settings nor a params.yaml.
    """
    rule = settings or read_params("params.yaml").grasp_types
    hand = HandStates(grasp.T_object_hand.as_matrix()[None], grasp.joint_angles_rad[None])
    measures = measure(grasp.object.distance_grid, hand, rule.contacts)
    return explain(measures, rule.thresholds)[0]
