"""Inverses of rigid transforms."""

import numpy as np
from scipy.spatial.transform import Rotation

from grasptypes.poses import inverse


def test_a_transform_and_its_inverse_cancel_for_any_number_of_transforms():
    T = np.tile(np.eye(4), (3, 2, 1, 1))
    T[..., :3, :3] = Rotation.random(6, np.random.default_rng(0)).as_matrix().reshape(3, 2, 3, 3)
    T[..., :3, 3] = np.random.default_rng(1).normal(size=(3, 2, 3))
    unit = np.broadcast_to(np.eye(4), T.shape)
    np.testing.assert_allclose(T @ inverse(T), unit, atol=1e-12)
    np.testing.assert_allclose(inverse(T) @ T, unit, atol=1e-12)


def test_a_point_comes_back_to_where_it_was():
    T_object_hand = np.array([[0, -1, 0, 0.1], [1, 0, 0, 0.2], [0, 0, 1, 0.3], [0, 0, 0, 1.0]])
    np.testing.assert_allclose(inverse(T_object_hand) @ [0.1, 0.2, 0.3, 1.0], [0, 0, 0, 1])
    np.testing.assert_allclose(inverse(T_object_hand) @ [0.1, 1.2, 0.3, 1.0], [1, 0, 0, 1])
