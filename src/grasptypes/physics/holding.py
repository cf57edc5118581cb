"""Does a grasp hold? The test, in any engine: squeeze without gravity first, then gravity acts."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from grasptypes.physics.engine import NOMINAL, Contact, Engine, Surroundings
from grasptypes.physics.loads import TaskLoad
from grasptypes.physics.motors import Motors, grip_forces
from grasptypes.poses import inverse
from grasptypes.settings.physics import PhysicsSettings

Array = NDArray[np.float64]

DIRECTIONS = np.concatenate([-np.eye(3)[::-1], np.eye(3)[::-1]])
"""(6, 3) directions of gravity in the object frame; the first, -z, is that of an object at rest."""

LOOKS = 20
"""Maximum number of checks, during a test, of whether the object has dropped."""


class HoldResult(NamedTuple):
    """Result of a physics test."""

    dropped: bool
    moved_m: float
    """Largest motion of the object's centre of mass in the hand since the fingers touched it."""
    turned_rad: float
    """Largest rotation of the object in the hand since the fingers touched it."""
    T_object_hand: Array
    """(4, 4) at the end of the test."""
    joint_positions: Array
    """(J,) at the end of the test."""
    contacts: list[Contact]
    """At the end of the test."""
    stages: tuple[int, ...]
    """Number of stopped joints of each finger at the end of the test."""
    bears_load: bool = True
    """Whether the task's load, if there is one, left the object in the hand."""


def hold(
    engine: Engine,
    T_object_hand: Array,
    joint_positions: Array,
    stages: Sequence[int] | None = None,
    load: TaskLoad | None = None,
) -> HoldResult:
    """Squeeze the object and hold it, while gravity acts along -z or, with `shake`, from six sides.

    Motion counts from where the fingers touched the object, so that closing must not push it out of
    the hand either. The hand does not let go in between, as when an arm turns. Gravity along -z
    comes last, so that the hand is at rest then. Whether the object is lost under the load does not
    decide about the result: the load acts after all directions.

    Args:
        T_object_hand: (4, 4) hand in the object frame.
        joint_positions: (J,) at which the fingers touch.
        stages: number of stopped joints of each finger; default: what the positions show.
        load: acts besides gravity along -z.
    """
    settings, R = engine.settings, T_object_hand[:3, :3].T
    motors = squeeze(engine, T_object_hand, joint_positions, stages)
    start = inverse(T_object_hand)
    directions = (*DIRECTIONS[1:], DIRECTIONS[0]) if settings.shake else DIRECTIONS[:1]
    moved, turned = 0.0, 0.0
    for direction in directions:
        borne = bear(engine, motors, R @ direction * settings.gravity_m_s2, start=start)
        moved, turned = max(moved, borne.moved_m), max(turned, borne.turned_rad)
        if borne.lost:
            break
    contacts = engine.contacts()
    result = HoldResult(
        dropped=borne.lost or not contacts,
        moved_m=moved,
        turned_rad=turned,
        T_object_hand=inverse(borne.T_hand_object),
        joint_positions=engine.joint_positions(),
        contacts=contacts,
        stages=tuple(motors.stages),
    )
    if load is None or result.dropped:
        return result
    return result._replace(bears_load=bears_load(engine, motors, T_object_hand, load))


def squeeze(
    engine: Engine,
    T_object_hand: Array,
    positions: Array,
    stages: Sequence[int] | None = None,
    world: Surroundings = NOMINAL,
) -> Motors:
    """Load hand and object and close the fingers without gravity; returns the closed motors."""
    motors = load_and_couple(engine, T_object_hand, positions, stages, world)
    settings = engine.settings
    run(engine, motors, round(settings.squeeze_time_s / _interval_s(settings)))
    return motors


def load_and_couple(
    engine: Engine,
    T_object_hand: Array,
    positions: Array,
    stages: Sequence[int] | None = None,
    world: Surroundings = NOMINAL,
) -> Motors:
    """Load hand and object; returns the motors, which have not moved yet."""
    engine.load(T_object_hand, positions, world)
    forces_n = grip_forces(engine.hand, engine.geometry.properties.mass_kg, engine.settings)
    motors = Motors(engine.hand, positions, forces_n, stages)
    for finger, stage in enumerate(motors.stages):
        engine.couple(finger, stage)
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
    engine: Engine,
    motors: Motors,
    acceleration_m_s2: Array,
    time_s: float | None = None,
    start: Array | None = None,
) -> Motion:
    """Let an acceleration (3,), in the hand's frame, act on a squeezed object.

    A force that `Engine.push` has set acts as well.

    Args:
        time_s: default: the holding time of the settings.
        start: (4, 4) the object in the hand before it moved; default: as it is now.
    """
    settings = engine.settings
    half = engine.T_hand_object()
    before = half if start is None else start
    engine.accelerate(acceleration_m_s2)
    time_s = settings.hold_time_s if time_s is None else time_s
    whole = max(1, round(time_s / _interval_s(settings)))
    looks = np.linspace(0, whole, min(LOOKS, whole) + 1).astype(int)
    centre_m = np.array(engine.geometry.properties.centre_of_mass_m)
    for look, intervals in enumerate(np.diff(looks).tolist(), start=1):
        run(engine, motors, intervals)
        after = engine.T_hand_object()
        if lost := _is_lost(before, after, centre_m, settings):
            break
        if look == len(looks) // 2:
            half = after
    moved, crept = _shift(before, after, centre_m), _shift(half, after, centre_m)
    turned = float(Rotation.from_matrix(before[:3, :3].T @ after[:3, :3]).magnitude())
    creep = np.inf if lost else crept / (time_s / 2.0)
    return Motion(lost, moved, turned, creep, after)


def bears_load(engine: Engine, motors: Motors, T_object_hand: Array, load: TaskLoad) -> bool:
    """Whether a squeezed object stays in the hand, at a pose (4, 4), under a task's load.

    Its directions follow each other, each for the holding time, besides gravity along -z.
    """
    down = T_object_hand[:3, :3].T @ DIRECTIONS[0] * engine.settings.gravity_m_s2
    for force_n in load.forces(T_object_hand):
        engine.push(force_n, load.point_m)
        if bear(engine, motors, down).lost:
            return False
    return True


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


def _is_lost(before: Array, after: Array, centre_m: Array, settings: PhysicsSettings) -> bool:
    """Whether a body's centre of mass moved, or the body turned, too far between two poses."""
    if _shift(before, after, centre_m) > settings.drop_distance_m:
        return True
    # The angle by the trace is quicker than by `Rotation`, but not exact if it is tiny.
    cosine = (float(np.vdot(before[:3, :3], after[:3, :3])) - 1.0) / 2.0
    return math.acos(min(max(cosine, -1.0), 1.0)) > settings.drop_rotation_rad


def _shift(before: Array, after: Array, centre_m: Array) -> float:
    """Motion of a body's centre of mass between two poses, metres."""
    change = after - before
    return float(np.linalg.norm(change[:3, :3] @ centre_m + change[:3, 3]))
