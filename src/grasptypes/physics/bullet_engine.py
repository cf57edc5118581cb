"""PyBullet as an engine. The only module that uses it, and its xyzw quaternions."""

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
from grasptypes.physics.engine import NOMINAL, Contact, Surroundings
from grasptypes.physics.motors import MotorCommand
from grasptypes.poses import inverse
from grasptypes.settings.physics import PhysicsSettings

Array = NDArray[np.float64]


class BulletEngine:
    """A physics server for one hand and object. Use `bullet_engine` to get one."""

    def __init__(
        self,
        client: int,
        hand: Hand,
        urdf: Path,
        geometry: ObjectGeometry,
        settings: PhysicsSettings,
    ) -> None:
        self.hand = hand
        self.geometry = geometry
        self.settings = settings
        self.steps = 0
        self.client = client
        self._urdf = urdf
        self._joints: list[int] = []
        self._gears: dict[int, list[int]] = {}
        self._limits: dict[int, tuple[float, float, float]] = {}
        self._force: tuple[Array, Array] | None = None
        self._hand_id = self._object_id = -1
        self._T_inertial_object = np.eye(4)

    def load(
        self, T_object_hand: Array, joint_positions: Array, world: Surroundings = NOMINAL
    ) -> None:
        """Create a world with the hand at its origin and the object."""
        client, settings = self.client, self.settings
        self._gears, self._limits, self._force = {}, {}, None
        pybullet.resetSimulation(physicsClientId=client)
        pybullet.setPhysicsEngineParameter(
            fixedTimeStep=settings.timestep_s,
            numSolverIterations=self.hand.solver_iterations,
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
        for joint, position in zip(self._joints, joint_positions, strict=True):
            pybullet.resetJointState(hand, joint, position, physicsClientId=client)
        thing = self._load_object(inverse(T_object_hand), world.mass_share)
        friction = settings.friction if world.friction is None else world.friction
        for link in (-1, *self._joints):
            pybullet.changeDynamics(hand, link, lateralFriction=friction, physicsClientId=client)
        self._hand_id, self._object_id = hand, thing
        inertial = pybullet.getDynamicsInfo(thing, -1, physicsClientId=client)[3:5]
        self._T_inertial_object = inverse(_matrix(*inertial))

    def _number_joints(self, hand: int) -> None:
        """Find Bullet's index of each joint, which is also that of its child link."""
        count, client = pybullet.getNumJoints(hand, physicsClientId=self.client), self.client
        names = [pybullet.getJointInfo(hand, n, physicsClientId=client)[1] for n in range(count)]
        self._joints = [names.index(name.encode()) for name in self.hand.joint_names]

    def _let_own_links_pass(self, hand: int) -> None:
        """Ignore the collisions that the hand's description ignores, like the search."""
        for pair in sorted(self.hand.ignored_pairs):
            one, other = (-1 if link == PALM else self._joints[link - 1] for link in pair)
            pybullet.setCollisionFilterPair(
                hand, hand, one, other, enableCollision=0, physicsClientId=self.client
            )

    def _load_object(self, T_hand_object: Array, mass_share: float) -> int:
        body, client = self.geometry.properties, self.client
        moments, axes = np.linalg.eigh(np.array(body.inertia_kg_m2))
        axes = axes * np.sign(np.linalg.det(axes))
        T_object_inertial = np.eye(4)
        T_object_inertial[:3, :3], T_object_inertial[:3, 3] = axes, body.centre_of_mass_m
        shape = pybullet.createCollisionShape(
            pybullet.GEOM_MESH, fileName=str(self.geometry.collision), physicsClientId=client
        )
        position, orientation = _position_orientation(T_object_inertial)
        thing = pybullet.createMultiBody(
            baseMass=body.mass_kg * mass_share,
            baseCollisionShapeIndex=shape,
            baseInertialFramePosition=position,
            baseInertialFrameOrientation=orientation,
            physicsClientId=client,
        )
        pybullet.changeDynamics(
            thing,
            -1,
            localInertiaDiagonal=(moments * mass_share).tolist(),
            lateralFriction=1.0,  # Bullet multiplies the friction of both bodies
            contactStiffness=self.settings.pybullet.contact_stiffness_n_m,
            contactDamping=self.settings.pybullet.contact_damping_n_s_m,
            collisionMargin=0.0,
            physicsClientId=client,
        )
        position, orientation = _position_orientation(T_hand_object @ T_object_inertial)
        pybullet.resetBasePositionAndOrientation(
            thing, position, orientation, physicsClientId=client
        )
        return int(thing)

    def accelerate(self, gravity_m_s2: Array) -> None:
        """Set the acceleration (3,) of gravity, in the hand's frame."""
        pybullet.setGravity(*gravity_m_s2, physicsClientId=self.client)

    def push(self, force_n: Array, point_m: Array) -> None:
        """Let a force (3,), in the hand's frame, act at a point (3,) of the object's frame."""
        self._force = force_n, point_m

    def drive(self, command: MotorCommand) -> None:
        """Let the joints close with their torques, and withstand being driven back.

        What they withstand is a limit of the joint that moves on with it. If the motor switched
        between both forces instead, the fingers would shake the object.
        """
        moves = command.closing_torques > 0.0
        follows = command.passive_torques == 0.0
        low, high = self.hand.joint_limits.T
        low = np.where(follows, low, command.reached)
        high = np.where(moves | follows, high, command.reached)
        for place, joint in enumerate(self._joints):
            limits = float(low[place]), float(high[place]), float(command.passive_torques[place])
            if follows[place] or limits == self._limits.get(joint):
                continue
            self._limits[joint] = limits
            pybullet.changeDynamics(
                self._hand_id,
                joint,
                jointLowerLimit=limits[0],
                jointUpperLimit=limits[1],
                jointLimitForce=limits[2],
                physicsClientId=self.client,
            )
        pybullet.setJointMotorControlArray(
            self._hand_id,
            self._joints,
            pybullet.VELOCITY_CONTROL,
            targetVelocities=command.speeds.tolist(),
            forces=np.where(moves, command.closing_torques, command.passive_torques).tolist(),
            physicsClientId=self.client,
        )

    def step(self, count: int) -> None:
        """Simulate `count` time steps."""
        for _ in range(count):
            if self._force is not None:
                force_n, point_m = self._force
                T = self.T_hand_object()
                pybullet.applyExternalForce(
                    self._object_id,
                    -1,
                    force_n.tolist(),
                    (T[:3, :3] @ point_m + T[:3, 3]).tolist(),
                    pybullet.WORLD_FRAME,
                    physicsClientId=self.client,
                )
            pybullet.stepSimulation(physicsClientId=self.client)
        self.steps += count

    def couple(self, finger: int, stage: int) -> None:
        """Let the joints of a finger that still move follow the first of them, by gears."""
        client, described = self.client, self.hand.fingers[finger]
        settings = self.settings.pybullet
        hand = self._hand_id
        for gear in self._gears.pop(finger, []):
            pybullet.removeConstraint(gear, physicsClientId=client)
        if self.hand.direct or stage == len(described.joints):
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

    def presses(self, link: int) -> bool:
        """Whether a link presses on the object."""
        touching = pybullet.getContactPoints(
            self._hand_id, self._object_id, self._joints[link - 1], physicsClientId=self.client
        )
        return any(point[9] > 0.0 for point in touching)

    def joint_positions(self) -> Array:
        """(J,) rad, prismatic joints m."""
        states = pybullet.getJointStates(self._hand_id, self._joints, physicsClientId=self.client)
        return np.array([state[0] for state in states])

    def T_hand_object(self) -> Array:
        """(4, 4) object frame in the hand frame; Bullet itself reports the inertial frame."""
        inertial = pybullet.getBasePositionAndOrientation(
            self._object_id, physicsClientId=self.client
        )
        return _matrix(*inertial) @ self._T_inertial_object

    def contacts(self) -> list[Contact]:
        """Where the hand presses on the object."""
        T = inverse(self.T_hand_object())
        found = pybullet.getContactPoints(
            self._object_id, self._hand_id, physicsClientId=self.client
        )
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
def bullet_engine(
    hand: Hand, geometry: ObjectGeometry, settings: PhysicsSettings
) -> Iterator[BulletEngine]:
    """A physics server for one hand and object, in this process, without a window."""
    client = pybullet.connect(pybullet.DIRECT)
    try:
        with TemporaryDirectory() as folder:
            yield BulletEngine(client, hand, write_urdf(hand, folder), geometry, settings)
    finally:
        pybullet.disconnect(client)


def _position_orientation(T: Array) -> tuple[list[float], list[float]]:
    return T[:3, 3].tolist(), Rotation.from_matrix(T[:3, :3]).as_quat().tolist()


def _matrix(position: Sequence[float], orientation: Sequence[float]) -> Array:
    T = np.eye(4)
    T[:3, :3] = Rotation.from_quat(orientation).as_matrix()
    T[:3, 3] = position
    return T
