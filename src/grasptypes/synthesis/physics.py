"""Does a grasp hold? The only module that uses PyBullet, and its xyzw quaternions.

Every test has its own world: everything is reloaded after a reset, in the same order, so the result
cannot depend on earlier tests. The hand's base is fixed, its motors push with a limited force, the
object is free. It is squeezed without gravity first, then gravity acts.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
import pybullet
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from grasptypes.hands.hand import PALM, Hand
from grasptypes.hands.urdf import write_urdf
from grasptypes.objects.object_geometry import ObjectGeometry
from grasptypes.poses import inverse
from grasptypes.settings.physics import PhysicsSettings
from grasptypes.synthesis.holding import Contact, HoldResult, Motors

Array = NDArray[np.float64]

DIRECTIONS = np.concatenate([-np.eye(3)[::-1], np.eye(3)[::-1]])
"""(6, 3) directions of gravity in the object frame; the first, -z, is that of an object at rest."""

LOOKS = 20
"""Maximum number of checks, during a test, of whether the object has dropped."""


class Physics:
    """A physics server that tests grasps of one object. Use `physics` to get one."""

    def __init__(
        self,
        client: int,
        hand: Hand,
        urdf: Path,
        geometry: ObjectGeometry,
        settings: PhysicsSettings,
    ) -> None:
        self._client = client
        self._hand = hand
        self._urdf = urdf
        self._geometry = geometry
        self._settings = settings
        self._joints: list[int] = []
        self._gears: dict[int, list[int]] = {}
        self.steps = 0
        """Number of time steps so far, for benchmarks."""

    def hold(self, T_object_hand: Array, joint_positions: Array) -> HoldResult:
        """Squeeze and hold the object; returns the result for the worst direction of gravity.

        Args:
            T_object_hand: (4, 4) hand in the object frame.
            joint_positions: (J,) at which the fingers touch.
        """
        directions = DIRECTIONS if self._settings.shake else DIRECTIONS[:1]
        worst: HoldResult | None = None
        for direction in directions:
            held = self._hold_once(T_object_hand, joint_positions, direction)
            if worst is None or (held.dropped, held.moved_m) > (worst.dropped, worst.moved_m):
                worst = held
            if worst.dropped:
                break
        assert worst is not None
        return worst

    def _hold_once(self, T_object_hand: Array, positions: Array, direction: Array) -> HoldResult:
        settings, client = self._settings, self._client
        hand, thing = self._load(T_object_hand, positions)
        motors = Motors(self._hand, positions, settings)
        self._gears = {}
        for finger in range(len(motors.stages)):
            self._couple(hand, motors, finger)
        interval_s = settings.timestep_s * settings.control_steps
        self._run(hand, thing, motors, round(settings.squeeze_time_s / interval_s))
        before = self._pose(thing)
        down = T_object_hand[:3, :3].T @ direction * settings.gravity_m_s2
        pybullet.setGravity(*down, physicsClientId=client)
        dropped, whole = False, max(1, round(settings.hold_time_s / interval_s))
        for intervals in np.diff(np.linspace(0, whole, min(LOOKS, whole) + 1).astype(int)).tolist():
            self._run(hand, thing, motors, intervals)
            after = self._pose(thing)
            moved, turned = _difference(
                before, after, np.array(self._geometry.properties.centre_of_mass_m)
            )
            dropped = moved > settings.drop_distance_m or turned > settings.drop_rotation_rad
            if dropped:
                break
        contacts = self._contacts(hand, thing, after)
        states = pybullet.getJointStates(hand, self._joints, physicsClientId=client)
        return HoldResult(
            dropped=dropped or not contacts,
            moved_m=moved,
            turned_rad=turned,
            T_object_hand=inverse(after),
            joint_positions=np.array([state[0] for state in states]),
            contacts=contacts,
        )

    def _load(self, T_object_hand: Array, positions: Array) -> tuple[int, int]:
        """Create a world with the hand at its origin and the object; returns their body IDs."""
        client, settings = self._client, self._settings
        pybullet.resetSimulation(physicsClientId=client)
        pybullet.setPhysicsEngineParameter(
            fixedTimeStep=settings.timestep_s,
            numSolverIterations=self._hand.solver_iterations,
            deterministicOverlappingPairs=1,
            physicsClientId=client,
        )
        hand = pybullet.loadURDF(
            str(self._urdf),
            useFixedBase=True,
            flags=pybullet.URDF_USE_INERTIA_FROM_FILE | pybullet.URDF_USE_SELF_COLLISION,
            physicsClientId=client,
        )
        self._number_joints(hand)
        self._let_own_links_pass(hand)
        for joint, position in zip(self._joints, positions, strict=True):
            pybullet.resetJointState(hand, joint, position, physicsClientId=client)
        thing = self._load_object(inverse(T_object_hand))
        for link in (-1, *self._joints):
            pybullet.changeDynamics(
                hand, link, lateralFriction=settings.friction, physicsClientId=client
            )
        return hand, thing

    def _number_joints(self, hand: int) -> None:
        """Find Bullet's index of each joint, which is also that of its child link."""
        count, client = pybullet.getNumJoints(hand, physicsClientId=self._client), self._client
        names = [pybullet.getJointInfo(hand, n, physicsClientId=client)[1] for n in range(count)]
        self._joints = [names.index(name.encode()) for name in self._hand.joint_names]

    def _let_own_links_pass(self, hand: int) -> None:
        """Ignore the collisions that the hand's description ignores, like the search."""
        for pair in sorted(self._hand.ignored_pairs):
            one, other = (-1 if link == PALM else self._joints[link - 1] for link in pair)
            pybullet.setCollisionFilterPair(
                hand, hand, one, other, enableCollision=0, physicsClientId=self._client
            )

    def _load_object(self, T_hand_object: Array) -> int:
        body, client = self._geometry.properties, self._client
        moments, axes = np.linalg.eigh(np.array(body.inertia_kg_m2))
        axes = axes * np.sign(np.linalg.det(axes))
        T_object_inertial = np.eye(4)
        T_object_inertial[:3, :3], T_object_inertial[:3, 3] = axes, body.centre_of_mass_m
        shape = pybullet.createCollisionShape(
            pybullet.GEOM_MESH, fileName=str(self._geometry.collision), physicsClientId=client
        )
        position, orientation = _position_orientation(T_object_inertial)
        thing = pybullet.createMultiBody(
            baseMass=body.mass_kg,
            baseCollisionShapeIndex=shape,
            baseInertialFramePosition=position,
            baseInertialFrameOrientation=orientation,
            physicsClientId=client,
        )
        pybullet.changeDynamics(
            thing,
            -1,
            localInertiaDiagonal=moments.tolist(),
            lateralFriction=1.0,  # Bullet multiplies the friction of both bodies
            collisionMargin=0.0,
            physicsClientId=client,
        )
        position, orientation = _position_orientation(T_hand_object @ T_object_inertial)
        pybullet.resetBasePositionAndOrientation(
            thing, position, orientation, physicsClientId=client
        )
        return int(thing)

    def _run(self, hand: int, thing: int, motors: Motors, intervals: int) -> None:
        """Simulate while the motors close the fingers as far as their force allows.

        Args:
            intervals: number of motor commands, each held for `control_steps`.
        """
        settings, client = self._settings, self._client
        for _ in range(intervals):
            states = pybullet.getJointStates(hand, self._joints, physicsClientId=client)
            self._stop_fingers(hand, thing, motors)
            speeds, torques = motors.drive(np.array([state[0] for state in states]))
            pybullet.setJointMotorControlArray(
                hand,
                self._joints,
                pybullet.VELOCITY_CONTROL,
                targetVelocities=speeds.tolist(),
                forces=torques.tolist(),
                physicsClientId=client,
            )
            for _ in range(settings.control_steps):
                pybullet.stepSimulation(physicsClientId=client)
            self.steps += settings.control_steps

    def _couple(self, hand: int, motors: Motors, finger: int) -> None:
        """Let the joints of a finger that still move follow the first of them, by gears."""
        client, settings, described = self._client, self._settings, self._hand.fingers[finger]
        for gear in self._gears.pop(finger, []):
            pybullet.removeConstraint(gear, physicsClientId=client)
        stage = motors.stages[finger]
        if self._hand.direct or stage == len(described.joints):
            return
        driver, rates = self._joints[described.joints[stage]], described.rates[stage]
        gears = []
        for place in range(stage + 1, len(described.joints)):
            if rates[place] == 0.0:
                continue
            follower = self._joints[described.joints[place]]
            gear = pybullet.createConstraint(
                *(hand, driver, hand, follower, pybullet.JOINT_GEAR),
                *([0.0, 0.0, 1.0], [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]),
                physicsClientId=client,
            )
            ratio = rates[stage] / rates[place]
            offset = described.open[stage] - ratio * described.open[place]
            pybullet.changeConstraint(
                gear,
                gearRatio=-ratio,
                erp=settings.gear_correction,
                maxForce=settings.gear_torque_nm,
                **({"relativePositionTarget": offset} if offset and not stage else {}),
                physicsClientId=client,
            )
            gears.append(gear)
        self._gears[finger] = gears

    def _stop_fingers(self, hand: int, thing: int, motors: Motors) -> None:
        """Stop the joints of coupled links that press on the object, and let the others go on."""
        client = self._client
        if self._hand.direct:
            return
        for finger, described in enumerate(self._hand.fingers):
            stage = motors.stages[finger]
            for place in reversed(range(stage, len(described.joints) - 1)):
                link = self._joints[described.joints[place]]
                touching = pybullet.getContactPoints(hand, thing, link, physicsClientId=client)
                if any(point[9] > 0.0 for point in touching):
                    motors.stop(finger, place + 1)
                    self._couple(hand, motors, finger)
                    break

    def _pose(self, thing: int) -> Array:
        """(4, 4) object frame in the hand frame; Bullet itself reports the inertial frame."""
        client = self._client
        position, orientation = pybullet.getBasePositionAndOrientation(
            thing, physicsClientId=client
        )
        inertial = pybullet.getDynamicsInfo(thing, -1, physicsClientId=client)[3:5]
        return _matrix(position, orientation) @ inverse(_matrix(*inertial))

    def _contacts(self, hand: int, thing: int, T_hand_object: Array) -> list[Contact]:
        T = inverse(T_hand_object)
        found = pybullet.getContactPoints(thing, hand, physicsClientId=self._client)
        return [
            Contact(
                link=0 if point[4] < 0 else self._joints.index(point[4]) + 1,
                point_m=T[:3, :3] @ np.array(point[6]) + T[:3, 3],
                normal=T[:3, :3] @ np.array(point[7]),
                force_n=float(point[9]),
            )
            for point in found
            if point[9] > 0.0
        ]


@contextmanager
def physics(hand: Hand, geometry: ObjectGeometry, settings: PhysicsSettings) -> Iterator[Physics]:
    """A physics server for one hand and object, in this process, without a window."""
    client = pybullet.connect(pybullet.DIRECT)
    try:
        with TemporaryDirectory() as folder:
            yield Physics(client, hand, write_urdf(hand, folder), geometry, settings)
    finally:
        pybullet.disconnect(client)


def _position_orientation(T: Array) -> tuple[list[float], list[float]]:
    return T[:3, 3].tolist(), Rotation.from_matrix(T[:3, :3]).as_quat().tolist()


def _matrix(position: Sequence[float], orientation: Sequence[float]) -> Array:
    T = np.eye(4)
    T[:3, :3] = Rotation.from_quat(orientation).as_matrix()
    T[:3, 3] = position
    return T


def _difference(before: Array, after: Array, centre_m: Array) -> tuple[float, float]:
    """Motion of a body's centre of mass (m) and its rotation (rad) between two poses."""
    turned = Rotation.from_matrix(before[:3, :3].T @ after[:3, :3]).magnitude()
    change = after - before
    return float(np.linalg.norm(change[:3, :3] @ centre_m + change[:3, 3])), float(turned)
