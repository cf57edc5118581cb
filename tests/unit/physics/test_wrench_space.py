"""The wrench space of contacts with known answers."""

import numpy as np
import pytest
from tests.unit.barrett import BARRETT

from grasptypes.physics.engine import Contact
from grasptypes.physics.wrench_space import Body, wrench_space

BODY = Body(np.zeros(3), 1.0)
LINKS = BARRETT.link_poses(BARRETT.couple([0.0, 1.0, 1.0, 1.0]))
TORQUES = np.ones(8)
TIPS = (6, 7, 8)


def space(contacts, torques=TORQUES, friction=0.8):
    return wrench_space(contacts, LINKS, BARRETT, torques, BODY, friction, 8)


def around(count):
    """Contacts of the fingertips evenly around the equator of a unit ball."""
    angles = 2.0 * np.pi * np.arange(count) / count
    points = np.column_stack([np.cos(angles), np.sin(angles), np.zeros(count)])
    return [
        Contact(TIPS[index % 3], point, -point, 1.0)
        for index, point in enumerate(points)
    ]  # fmt: skip


def test_three_fingers_around_a_ball_resist_every_wrench() -> None:
    found = space(around(3))
    assert found.epsilon_n > 0.0
    assert found.volume_n6 > 0.0


def test_two_opposite_points_do_not_resist_a_turn_about_their_line() -> None:
    found = space([around(2)[0], around(2)[1]])
    assert found.epsilon_n == pytest.approx(0.0, abs=1e-9)


def test_contacts_without_friction_or_from_one_side_hold_nothing() -> None:
    assert space(around(3), friction=0.0).epsilon_n == 0.0
    assert space([around(3)[0]] * 3).epsilon_n == 0.0


def test_twice_the_torque_bears_twice_the_wrench() -> None:
    once, twice = space(around(3)), space(around(3), 2.0 * TORQUES)
    assert twice.epsilon_n == pytest.approx(2.0 * once.epsilon_n)
    assert twice.volume_n6 == pytest.approx(2.0**6 * once.volume_n6)
