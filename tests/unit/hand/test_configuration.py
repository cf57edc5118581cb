"""Taking hand configurations apart and putting them together again."""

import numpy as np
import pytest

from grasptypes.hand import configuration, kinematics

NUMBERS = np.array([3, 0, -1, 0, 0.1, 1, 0, 0, 0.2, 0, 0, 1, 0.3, 0.5, 1.0, 1.1, 1.2])


def test_unpack_reads_the_pose_row_by_row() -> None:
    hand = configuration.unpack(NUMBERS)
    assert hand.rank_index == 3
    np.testing.assert_array_equal(hand.T_object_hand[:3, 3], [0.1, 0.2, 0.3])
    np.testing.assert_array_equal(hand.T_object_hand @ [1, 0, 0, 0], [0, 1, 0, 0])
    np.testing.assert_array_equal(hand.T_object_hand[3], [0, 0, 0, 1])
    assert dict(zip(kinematics.DOF_NAMES, hand.dofs_rad, strict=True))["finger_3"] == 1.2


def test_wrong_length_is_refused() -> None:
    with pytest.raises(ValueError, match="17"):
        configuration.unpack(np.zeros((4, 16)))
