"""Which grasp is shown, and where its hand stands."""

import numpy as np
import pandas as pd
from tests.unit.barrett import BARRETT

from grasptypes.hands import configuration
from grasptypes.hands.states import HandStates
from grasptypes.renders.gallery import best_grasp, hand_parts, state_of

ANGLES = BARRETT.couple(np.radians([[30.0, 60.0, 60.0, 60.0]]))[0]


def grasp(energy, valid, height_m):
    T_object_hand = np.eye(4)
    T_object_hand[2, 3] = height_m
    numbers = configuration.pack(0, T_object_hand, ANGLES[[0, 2, 3, 4]])
    return {
        "energy": energy,
        "valid": valid,
        "hand_configuration": numbers.tolist(),
        "joint_angles_rad": ANGLES.tolist(),
    }


def test_the_best_grasp_is_the_valid_one_of_lowest_energy():
    grasps = pd.DataFrame([grasp(3, True, 0.3), grasp(1, False, 0.1), grasp(2, True, 0.2)])
    state = state_of(BARRETT, best_grasp(grasps))
    assert state.hand is BARRETT
    assert state.T_object_hand[:, 2, 3] == [0.2]
    np.testing.assert_allclose(state.joint_positions, [ANGLES])
    assert best_grasp(grasps[~grasps.valid]) is None


def test_parts_of_the_hand_move_with_it():
    T = np.eye(4)
    T[:3, 3] = [0.1, 0.2, 0.3]
    poses = np.stack([np.eye(4), T])[:, None]
    here, there = (hand_parts(HandStates(BARRETT, pose, ANGLES[None])) for pose in poses)
    assert len(here) == sum(len(link.visuals) for link in BARRETT.links)
    for first, second in zip(here, there, strict=True):
        np.testing.assert_allclose(second.vertices, first.vertices + T[:3, 3], atol=1e-9)
        np.testing.assert_allclose(np.linalg.norm(first.normals, axis=1), 1.0, atol=1e-6)
