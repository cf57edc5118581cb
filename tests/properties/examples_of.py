"""Strategies that several properties draw from."""

import numpy as np
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from scipy.spatial.transform import Rotation
from tests.unit.barrett import BARRETT


def numbers(low, high, shape):
    """Arrays of finite numbers."""
    return arrays(np.float64, shape, elements=st.floats(low, high, allow_subnormal=False))


@st.composite
def poses(draw, count=1):
    """Rigid transforms (count, 4, 4), up to a metre away."""
    T = np.tile(np.eye(4), (count, 1, 1))
    T[:, :3, :3] = Rotation.from_rotvec(draw(numbers(-3.0, 3.0, (count, 3)))).as_matrix()
    T[:, :3, 3] = draw(numbers(-1.0, 1.0, (count, 3)))
    return T


@st.composite
def within(draw, limits_rad, count=1):
    """Angles (count, n) within limits (n, 2)."""
    share = draw(numbers(0.0, 1.0, (count, len(limits_rad))))
    return limits_rad[:, 0] + share * (limits_rad[:, 1] - limits_rad[:, 0])


def hands(count=1):
    """Joint angles (count, 8) that the BarrettHand can take."""
    return within(BARRETT.joint_limits, count)
