"""Does a grasp hold? The test, in any engine: squeeze without gravity first, then gravity acts."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from grasptypes.physics.engine import NOMINAL, Contact, Engine, Surroundings
from grasptypes.physics.motors import Motors
from grasptypes.poses import inverse
from grasptypes.settings.physics import PhysicsSettings

Array = NDArray[np.float64]

DIRECTIONS = np.concatenate([-np.eye(3)[::-1], np.eye(3)[::-1]])
"""(6, 3) directions of gravity in the object frame; the first, -z, is that of an object at rest."""

LOOKS = 20
"""Maximum number of checks, during a test, of whether the object has dropped."""


class HoldResult(NamedTuple):
    """Result of a physics test.

    With `shake`, all fields are of the test in the worst direction of gravity: the first in which
    the object dropped, or the one in which it moved most.
    """

    dropped: bool
    moved_m: float
    """Motion of the object's centre of mass in the hand under gravity."""
    turned_rad: float
    """Rotation of the object in the hand under gravity."""
    T_object_hand: Array
    """(4, 4) at the end of the last test."""
    joint_positions: Array
    """(J,) at the end of the last test."""
    contacts: list[Contact]
    """At the end of the last test."""
    stages: tuple[int, ...]
    """Number of stopped joints of each finger at the end of the last test."""


def hold(
    engine: Engine,
    T_object_hand: Array,
    joint_positions: Array,
    stages: Sequence[int] | None = None,
) -> HoldResult:
    """Squeeze and hold the object; returns the result for the worst direction of gravity.

    Args:
        T_object_hand: (4, 4) hand in the object frame.
        joint_positions: (J,) at which the fingers touch.
        stages: number of stopped joints of each finger; default: what the positions show.
    """
    directions = DIRECTIONS if engine.settings.shake else DIRECTIONS[:1]
    worst: HoldResult | None = None
    for direction in directions:
        held = hold_against(engine, T_object_hand, joint_positions, direction, stages)
        if worst is None or (held.dropped, held.moved_m) > (worst.dropped, worst.moved_m):
            worst = held
        if worst.dropped:
            break
    assert worst is not None
    return worst


def hold_against(
    engine: Engine,
    T_object_hand: Array,
    positions: Array,
    direction: Array,
    stages: Sequence[int] | None = None,
) -> HoldResult:
    """Squeeze and hold the object against gravity in one direction (3,) of the object frame."""
    motors = squeeze(engine, T_object_hand, positions, stages)
    down = T_object_hand[:3, :3].T @ direction * engine.settings.gravity_m_s2
    borne = bear(engine, motors, down)
    contacts = engine.contacts()
    return HoldResult(
        dropped=borne.lost or not contacts,
        moved_m=borne.moved_m,
        turned_rad=borne.turned_rad,
        T_object_hand=inverse(borne.T_hand_object),
        joint_positions=engine.joint_positions(),
        contacts=contacts,
        stages=tuple(motors.stages),
    )


def squeeze(
    engine: Engine,
    T_object_hand: Array,
    positions: Array,
    stages: Sequence[int] | None = None,
    world: Surroundings = NOMINAL,
) -> Motors:
    """Load hand and object and close the fingers without gravity; returns the closed motors."""
    settings = engine.settings
    engine.load(T_object_hand, positions, world)
    motors = Motors(engine.hand, positions, settings, stages)
    for finger, stage in enumerate(motors.stages):
        engine.couple(finger, stage)
    run(engine, motors, round(settings.squeeze_time_s / _interval_s(settings)))
    return motors


class Motion(NamedTuple):
    """How an object moved in a hand under a load."""

    lost: bool
    """Whether it moved or turned too far; then the test ended early."""
    moved_m: float
    """Motion of its centre of mass."""
    turned_rad: float
    creep_m_s: float
    """Speed of the centre of mass over the second half of the time; infinite if lost."""
    T_hand_object: Array
    """(4, 4) at the end."""


def bear(
    engine: Engine, motors: Motors, acceleration_m_s2: Array, time_s: float | None = None
) -> Motion:
    """Let an acceleration (3,), in the hand's frame, act on a squeezed object.

    A force that `Engine.push` has set acts as well.

    Args:
        time_s: default: the holding time of the settings.
    """
    settings = engine.settings
    before = half = engine.T_hand_object()
    engine.accelerate(acceleration_m_s2)
    time_s = settings.hold_time_s if time_s is None else time_s
    whole = max(1, round(time_s / _interval_s(settings)))
    looks = np.linspace(0, whole, min(LOOKS, whole) + 1).astype(int)
    centre_m = np.array(engine.geometry.properties.centre_of_mass_m)
    for look, intervals in enumerate(np.diff(looks).tolist(), start=1):
        run(engine, motors, intervals)
        after = engine.T_hand_object()
        moved, turned = _difference(before, after, centre_m)
        if lost := moved > settings.drop_distance_m or turned > settings.drop_rotation_rad:
            break
        if look == len(looks) // 2:
            half = after
    crept, _ = _difference(half, after, centre_m)
    creep = np.inf if lost else crept / (time_s / 2.0)
    return Motion(lost, moved, turned, creep, after)


def _interval_s(settings: PhysicsSettings) -> float:
    return settings.timestep_s * settings.control_steps


def run(engine: Engine, motors: Motors, intervals: int) -> None:
    """Simulate while the motors close the fingers as far as their force allows.

    Args:
        intervals: number of motor commands, each held for `control_steps`.
    """
    for _ in range(intervals):
        positions = engine.joint_positions()
        _stop_fingers(engine, motors)
        engine.drive(motors.drive(positions))
        engine.step(engine.settings.control_steps)


def _stop_fingers(engine: Engine, motors: Motors) -> None:
    """Stop the joints of coupled links that press on the object, and let the others go on."""
    hand = engine.hand
    if hand.direct:
        return
    for finger, described in enumerate(hand.fingers):
        stage = motors.stages[finger]
        for place in reversed(range(stage, len(described.joints) - 1)):
            if engine.presses(described.links[place]):
                motors.stop(finger, place + 1)
                engine.couple(finger, place + 1)
                break


def _difference(before: Array, after: Array, centre_m: Array) -> tuple[float, float]:
    """Motion of a body's centre of mass (m) and its rotation (rad) between two poses."""
    turned = Rotation.from_matrix(before[:3, :3].T @ after[:3, :3]).magnitude()
    change = after - before
    return float(np.linalg.norm(change[:3, :3] @ centre_m + change[:3, 3])), float(turned)
