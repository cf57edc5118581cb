"""Taking hand configurations apart and putting them together again."""

import numpy as np
import pytest
from tests.unit.barrett import BARRETT

from grasptypes.hands import configuration

NUMBERS = np.array([3, 0, -1, 0, 0.1, 1, 0, 0, 0.2, 0, 0, 1, 0.3, 0.5, 1.0, 1.1, 1.2])


def test_unpack_reads_the_pose_row_by_row() -> None:
    hand = configuration.unpack(NUMBERS)
    assert hand.rank_index == 3
    np.testing.assert_array_equal(hand.T_object_hand[:3, 3], [0.1, 0.2, 0.3])
    np.testing.assert_array_equal(hand.T_object_hand @ [1, 0, 0, 0], [0, 1, 0, 0])
    np.testing.assert_array_equal(hand.T_object_hand[3], [0, 0, 0, 1])
    assert dict(zip(BARRETT.dof_names, hand.dofs, strict=True))["finger_3"] == 1.2


def test_wrong_length_is_refused() -> None:
    with pytest.raises(ValueError, match=r"more than 13 numbers, not shape \(4, 13\)"):
        configuration.unpack(np.zeros((4, 13)))


def test_pack_undoes_unpack_for_any_number_of_degrees_of_freedom() -> None:
    for count in (1, 4, 9):
        numbers = np.concatenate([NUMBERS[:13], np.arange(count) / 10])
        hand = configuration.unpack(np.tile(numbers, (2, 1)))
        assert hand.dofs.shape == (2, count)
        np.testing.assert_array_equal(configuration.pack(*hand), np.tile(numbers, (2, 1)))
