"""A good grasp holds, a bad one drops, and a test's result is its own."""

import numpy as np
import pytest
from synthesis_cases import ball_object, closed, palm_at
from tests.unit.barrett import BARRETT, COUPLING
from tests.unit.settings import PARAMS

from grasptypes.physics.engines import engine
from grasptypes.physics.holding import hold
from grasptypes.physics.loads import TaskLoad
from grasptypes.poses import inverse

SETTINGS = PARAMS.physics.test.changed(shake=False)
# Long enough to tell what is held from what is not.
STILL = SETTINGS.changed(hold_time_s=0.3)


def grasp(height, spread):
    T = palm_at(height)
    return T[0], closed(T, spread)[0]


GOOD, OTHER, SLIPPING = grasp(0.0305, 0.0), grasp(0.06, 0.8), grasp(0.105, 0.0)


def bytes_of(held):
    numbers = [held.moved_m, held.turned_rad, *(contact.force_n for contact in held.contacts)]
    return (
        held.T_object_hand.tobytes() + held.joint_positions.tobytes() + np.array(numbers).tobytes()
    )


@pytest.fixture
def body(tmp_path):
    return ball_object(tmp_path)


def test_an_enclosed_ball_is_held_with_forces_that_carry_it(body) -> None:
    with engine("pybullet", BARRETT, body, SETTINGS) as world:
        held = hold(world, *GOOD)
    assert not held.dropped
    assert held.moved_m < 0.003
    assert len({contact.link for contact in held.contacts}) >= 3
    for contact in held.contacts:
        assert np.linalg.norm(contact.point_m) == pytest.approx(0.03, abs=0.002)
        assert contact.normal @ contact.point_m < 0
    assert max(contact.force_n for contact in held.contacts) > 1.0


def test_fingertips_hold_a_ball_where_it_is_and_stay_coupled(body) -> None:
    T, angles = grasp(0.09, 0.0)
    with engine("pybullet", BARRETT, body, SETTINGS) as world:
        held = hold(world, T, angles)
    assert not held.dropped
    assert held.T_object_hand[2, 3] == pytest.approx(0.09, abs=0.005)
    lag = held.joint_positions[2:5] * COUPLING - held.joint_positions[5:]
    np.testing.assert_allclose(lag, 0.0, atol=0.012)


def test_a_base_that_is_stopped_lets_its_tip_go_on(body) -> None:
    with engine("mujoco", BARRETT, body, SETTINGS) as world:
        held = hold(world, *grasp(0.04, 0.0))
    assert not held.dropped
    lead = held.joint_positions[5:] - held.joint_positions[2:5] * COUPLING
    assert lead.max() > 0.012
    # The others are still coupled.
    np.testing.assert_allclose(lead[np.array(held.stages) == 0], 0.0, atol=0.001)


def test_movement_is_that_of_the_object_wherever_its_frame_lies(body, tmp_path) -> None:
    shift = np.array([1.0, 0.0, 0.0])
    far_off = ball_object(tmp_path, centre_m=shift)
    T, angles = GOOD
    moved = np.eye(4)
    moved[:3, 3] = shift
    with engine("pybullet", BARRETT, far_off, SETTINGS) as world:
        held = hold(world, moved @ T, angles)
    assert not held.dropped
    # A turn by 0.5 degrees moves the frame's origin by 9 mm.
    assert held.moved_m < 0.003


def test_a_folded_finger_does_not_push_itself_off_the_palm(body) -> None:
    fist = BARRETT.couple([0.0, 2.2, 2.2, 0.0])
    with engine("pybullet", BARRETT, body, SETTINGS) as world:
        held = hold(world, palm_at(5.0)[0], fist)
    np.testing.assert_allclose(held.joint_positions[:2], 0.0, atol=0.002)


def test_an_open_hand_drops_a_ball_from_above_and_carries_it_from_below(body) -> None:
    above, wide_open = GOOD[0], BARRETT.couple([0.0, 0.0, 0.0, 0.0])
    below = np.diag([1.0, -1.0, -1.0, 1.0]) @ above
    with engine("pybullet", BARRETT, body, SETTINGS) as world:
        assert hold(world, above, wide_open).dropped
        assert not hold(world, below, wide_open).dropped


def test_nothing_holds_far_away_or_without_friction(body) -> None:
    far = palm_at(0.3)[0]
    with engine("pybullet", BARRETT, body, SETTINGS) as world:
        assert hold(world, far, GOOD[1]).dropped
    with engine("pybullet", BARRETT, body, SETTINGS.changed(friction=0.0)) as world:
        tips = grasp(0.105, 0.0)
        assert hold(world, *tips).dropped


def test_result_does_not_depend_on_the_tests_before(body) -> None:
    with engine("pybullet", BARRETT, body, SETTINGS) as world:
        alone = bytes_of(hold(world, *GOOD))
    with engine("pybullet", BARRETT, body, SETTINGS) as world:
        hold(world, *OTHER)
        after_another = bytes_of(hold(world, *GOOD))
        again = bytes_of(hold(world, *GOOD))
    assert alone == after_another == again


def test_shaking_goes_on_after_one_squeeze_and_ends_at_rest(body) -> None:
    with engine("pybullet", BARRETT, body, STILL) as world:
        still = hold(world, *GOOD)
        once = world.steps
    with engine("pybullet", BARRETT, body, STILL.changed(shake=True)) as world:
        shaken = hold(world, *GOOD)
        held_steps = round(STILL.hold_time_s / STILL.timestep_s)
        assert world.steps == once + 5 * held_steps
    assert not shaken.dropped
    assert shaken.moved_m >= still.moved_m


def test_a_grasp_that_only_carries_from_below_is_shaken_off(body) -> None:
    below, wide_open = np.diag([1.0, -1.0, -1.0, 1.0]) @ GOOD[0], BARRETT.couple([0.0] * 4)
    with engine("mujoco", BARRETT, body, STILL) as world:
        assert not hold(world, below, wide_open).dropped
    with engine("mujoco", BARRETT, body, STILL.changed(shake=True)) as world:
        assert hold(world, below, wide_open).dropped


def test_motion_counts_from_the_touching_hand(body) -> None:
    with engine("mujoco", BARRETT, body, STILL.changed(gravity_m_s2=0.0)) as world:
        held = hold(world, *OTHER)
    centre_m, touching_m = (inverse(T)[:3, 3] for T in (held.T_object_hand, OTHER[0]))
    moved_m = np.linalg.norm(centre_m - touching_m)
    assert moved_m > 0.0005
    assert held.moved_m >= moved_m - 1e-9


def test_a_load_that_is_too_large_is_noted_and_changes_nothing_else(body) -> None:
    with engine("mujoco", BARRETT, body, STILL) as world:
        plain = hold(world, *GOOD)
        light = hold(world, *GOOD, load=TaskLoad(np.zeros(3), 0.5, "away", np.eye(3)))
        heavy = hold(world, *GOOD, load=TaskLoad(np.zeros(3), 500.0, "away", np.eye(3)))
    assert plain.bears_load
    assert light.bears_load
    assert not heavy.bears_load
    assert not heavy.dropped
    assert bytes_of(heavy) == bytes_of(light) == bytes_of(plain)


@pytest.mark.parametrize("changes", [{"hold_time_s": 0.15}, {"control_steps": 100}])
def test_gravity_acts_however_short_the_test_or_long_an_interval_is(tmp_path, changes) -> None:
    settings = SETTINGS.changed(squeeze_time_s=0.0, **changes)
    with engine("pybullet", BARRETT, ball_object(tmp_path), settings) as world:
        assert hold(world, palm_at(0.3)[0], GOOD[1]).moved_m > settings.drop_distance_m


def test_a_heavy_ball_is_dropped(tmp_path) -> None:
    with engine("pybullet", BARRETT, ball_object(tmp_path, mass_kg=20.0), SETTINGS) as world:
        assert hold(world, *OTHER).dropped
