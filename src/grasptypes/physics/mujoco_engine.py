"""MuJoCo as an engine. The only module that uses it, and its wxyz quaternions.

The hand is the URDF that PyBullet loads; its mimic joints become constraints that open with the
TorqueSwitch. Motors are torques, and dampers that limit the speed: motors that are given speeds
chatter on light objects. Contacts are found at Bullet's collision margin, around the hand only.
"""

from __future__ import annotations

from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any
from xml.etree import ElementTree

import mujoco
import numpy as np
from numpy.typing import NDArray

from grasptypes.hands.hand import Hand
from grasptypes.hands.urdf import write_urdf
from grasptypes.objects.object_files import read_collision
from grasptypes.objects.object_geometry import ObjectGeometry
from grasptypes.physics.engine import NOMINAL, Contact, Surroundings
from grasptypes.physics.motors import MotorCommand, tip_levers
from grasptypes.poses import inverse
from grasptypes.settings.physics import PhysicsSettings

Array = NDArray[np.float64]

OBJECT = "object"

# As stiff as MuJoCo's constraints become: a time constant of two time steps, and no compliance.
# With the defaults, made for heavier bodies, a fingertip lags behind its finger by half a radian.
STIFFEST_STEPS = 2.0
STIFFEST_SOLIMP = [0.9999, 0.9999, 0.001, 0.5, 2.0]

MEMORY_BYTES = 2**28
"""What a step may use: a hand in a bowl of many parts has 450 contacts, which need more than
MuJoCo's own estimate. Only what is used is taken from the machine."""


class MujocoEngine:
    """A model of one hand and object. A new load resets its state."""

    def __init__(self, hand: Hand, geometry: ObjectGeometry, settings: PhysicsSettings) -> None:
        self.hand = hand
        self.geometry = geometry
        self.settings = settings
        self.steps = 0
        self._force: tuple[Array, Array] | None = None
        self._model = _model(hand, geometry, settings)
        self._data = mujoco.MjData(self._model)
        model = self._model
        self._qpos = np.array([model.joint(name).qposadr[0] for name in hand.joint_names])
        self._dof = np.array([model.joint(name).dofadr[0] for name in hand.joint_names])
        self._body = model.body(OBJECT).id
        links = {model.body(name).id: link for link, name in enumerate(hand.link_names)}
        self._link_of_geom = np.array([links.get(body, -1) for body in model.geom_bodyid.tolist()])

    def load(
        self, T_object_hand: Array, joint_positions: Array, world: Surroundings = NOMINAL
    ) -> None:
        """Reset the world: a hand at a pose (4, 4) at rest, (J,) joints, without gravity."""
        model, data = self._model, self._data
        mujoco.mj_resetData(model, data)
        self._vary(world)
        self._force = None
        model.opt.gravity[:] = 0.0
        data.qpos[self._qpos] = joint_positions
        T_hand_object = inverse(T_object_hand)
        start = model.body_jntadr[self._body]
        place = data.qpos[model.jnt_qposadr[start] :][:7]
        place[:3] = T_hand_object[:3, 3]
        mujoco.mju_mat2Quat(place[3:], T_hand_object[:3, :3].ravel())
        mujoco.mj_forward(model, data)

    def _vary(self, world: Surroundings) -> None:
        """Set the friction, and the object's mass, if it is not that of the last load."""
        model, friction = self._model, world.friction
        model.geom_friction[:, 0] = self.settings.friction if friction is None else friction
        mass_kg = self.geometry.properties.mass_kg * world.mass_share
        change = mass_kg / model.body_mass[self._body]
        if change != 1.0:
            model.body_mass[self._body] *= change
            model.body_inertia[self._body] *= change
            mujoco.mj_setConst(model, self._data)
            mujoco.mj_resetData(model, self._data)

    def accelerate(self, gravity_m_s2: Array) -> None:
        """Set the acceleration (3,) of gravity, in the hand's frame."""
        self._model.opt.gravity[:] = gravity_m_s2

    def push(self, force_n: Array, point_m: Array) -> None:
        """Let a force (3,), in the hand's frame, act at a point (3,) of the object's frame."""
        self._force = force_n, point_m

    def couple(self, finger: int, stage: int) -> None:
        """Let the joints of a finger that still move follow the first of them, by constraints."""
        model, data, described = self._model, self._data, self.hand.fingers[finger]
        if self.hand.direct:
            return
        for place in range(1, len(described.joints)):
            coupling = model.equality(_coupling_name(finger, place)).id
            follows = place > stage and described.rates[stage, place] != 0.0
            data.eq_active[coupling] = follows
            if not follows:
                continue
            joint, driver = described.joints[place], described.joints[stage]
            ratio = described.rates[stage, place] / described.rates[stage, stage]
            place_now, driver_now = data.qpos[self._qpos[[joint, driver]]]
            if stage == 0:
                place_now, driver_now = described.open[place], described.open[0]
            model.eq_obj2id[coupling] = model.joint(self.hand.joint_names[driver]).id
            model.eq_data[coupling, :2] = place_now - ratio * driver_now, ratio

    def drive(self, command: MotorCommand) -> None:
        """Let the joints close with their torques, and withstand being driven back."""
        model, closing, passive = self._model, command.closing_torques, command.passive_torques
        moves = closing > 0.0
        damping = np.where(moves, closing, passive) / self.hand.motors.closing_speed_rad_s
        model.dof_damping[self._dof] = damping
        # As stiff as one time step allows: a joint that is driven back returns within it.
        stiffness = damping / self.settings.timestep_s
        model.actuator_gainprm[:, 0] = stiffness
        model.actuator_biasprm[:, 1] = -stiffness
        model.actuator_forcerange[:, 0] = np.where(moves, closing, -passive)
        model.actuator_forcerange[:, 1] = passive
        self._data.ctrl[:] = command.reached

    def step(self, count: int) -> None:
        """Simulate `count` time steps."""
        if self._force is not None:
            force_n, point_m = self._force
            centre_m = np.array(self.geometry.properties.centre_of_mass_m)
            arm_m = self.T_hand_object()[:3, :3] @ (point_m - centre_m)
            self._data.xfrc_applied[self._body] = [*force_n, *np.cross(arm_m, force_n)]
        mujoco.mj_step(self._model, self._data, nstep=count)
        self.steps += count

    def presses(self, link: int) -> bool:
        """Whether a link presses on the object."""
        contacts = np.flatnonzero(self._touching_links() == link).tolist()
        return any(self._force_n(contact) > 0.0 for contact in contacts)

    def joint_positions(self) -> Array:
        """(J,) rad, prismatic joints m."""
        return np.asarray(self._data.qpos[self._qpos])

    def T_hand_object(self) -> Array:
        """(4, 4) the object's frame in the hand's."""
        T = np.eye(4)
        T[:3, :3] = self._data.xmat[self._body].reshape(3, 3)
        T[:3, 3] = self._data.xpos[self._body]
        return T

    def contacts(self) -> list[Contact]:
        """Where the hand presses on the object."""
        T, links = inverse(self.T_hand_object()), self._touching_links()
        found = []
        for index in np.flatnonzero(links >= 0).tolist():
            contact, force_n = self._data.contact[index], self._force_n(index)
            if force_n <= 0.0:
                continue
            # The normal points from the first geom to the second.
            sign = 1.0 if self._link_of_geom[contact.geom[0]] >= 0 else -1.0
            found.append(
                Contact(
                    link=int(links[index]),
                    point_m=T[:3, :3] @ contact.pos + T[:3, 3],
                    normal=T[:3, :3] @ (sign * contact.frame[:3]),
                    force_n=force_n,
                )
            )
        return found

    def _touching_links(self) -> NDArray[np.int64]:
        """(n,) the link of each of the engine's contacts with the object; -1 for the others."""
        pairs = self._link_of_geom[self._data.contact.geom]
        return np.where(pairs.min(axis=1) < 0, pairs.max(axis=1), -1)

    def _force_n(self, contact: int) -> float:
        """The force along a contact's normal."""
        force = np.zeros(6)
        mujoco.mj_contactForce(self._model, self._data, contact, force)
        return float(force[0])


def _model(hand: Hand, geometry: ObjectGeometry, settings: PhysicsSettings) -> Any:
    """The compiled model of a hand at the world's origin and an object."""
    spec = _hand_spec(hand)
    spec.memory = MEMORY_BYTES
    option, engine = spec.option, settings.mujoco
    option.timestep = settings.timestep_s
    option.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    option.cone = mujoco.mjtCone.mjCONE_ELLIPTIC
    option.impratio = engine.impratio
    option.noslip_iterations = engine.noslip_iterations
    for geom in spec.geoms:
        geom.margin = engine.margin_m
        geom.solref[0] = engine.contact_time_s
    levers = tip_levers(hand, [0] * len(hand.fingers), np.zeros(len(hand.joints)))
    for name, lever in zip(hand.joint_names, levers.tolist(), strict=True):
        spec.joint(name).armature = engine.motor_mass_kg * lever**2
    # MuJoCo lets neighbours pass, too, but not those of a body that is fixed, like the palm.
    neighbours = {(joint.parent, link) for link, joint in enumerate(hand.joints, start=1)}
    for pair in sorted(hand.ignored_pairs | neighbours):
        one, other = (hand.link_names[link] for link in pair)
        spec.add_exclude(bodyname1=one, bodyname2=other)
    _add_couplings(spec, hand)
    for name in hand.joint_names:
        motor = spec.add_actuator(name=name, target=name)
        motor.trntype = mujoco.mjtTrn.mjTRN_JOINT
        motor.gaintype = mujoco.mjtGain.mjGAIN_FIXED
        motor.biastype = mujoco.mjtBias.mjBIAS_AFFINE
        motor.forcelimited, motor.forcerange = True, [-1.0, 1.0]
    _add_object(spec, geometry, settings)
    return spec.compile()


def _hand_spec(hand: Hand) -> Any:
    """The hand's URDF, without what is only seen and without the mimic joints."""
    with TemporaryDirectory() as folder:
        urdf = write_urdf(hand, folder)
        robot = ElementTree.parse(urdf).getroot()
        how = ElementTree.SubElement(robot, "mujoco")
        ElementTree.SubElement(
            how,
            "compiler",
            {"strippath": "false", "fusestatic": "false", "discardvisual": "true"},
        )
        for joint in robot.iter("joint"):
            for mimic in joint.findall("mimic"):
                joint.remove(mimic)
        files = {
            str(path.relative_to(folder)): path.read_bytes()
            for path in sorted(Path(folder).rglob("*.obj"))
        }
        spec = mujoco.MjSpec.from_string(
            ElementTree.tostring(robot, encoding="unicode"), assets=files
        )
        spec.compile()
        return spec


def _add_couplings(spec: Any, hand: Hand) -> None:
    """A constraint for every joint of a finger that can follow another one, open at first."""
    if hand.direct:
        return
    for finger, described in enumerate(hand.fingers):
        names = [hand.joint_names[joint] for joint in described.joints]
        for place in range(1, len(names)):
            coupling = spec.add_equality(name=_coupling_name(finger, place))
            coupling.type = mujoco.mjtEq.mjEQ_JOINT
            coupling.name1, coupling.name2 = names[place], names[0]
            coupling.active = False
            coupling.solref = [STIFFEST_STEPS * spec.option.timestep, 1.0]
            coupling.solimp = STIFFEST_SOLIMP


def _coupling_name(finger: int, place: int) -> str:
    return f"coupling_{finger}_{place}"


def _add_object(spec: Any, geometry: ObjectGeometry, settings: PhysicsSettings) -> None:
    """Add the free object: convex parts, mass and inertia."""
    properties = geometry.properties
    inertia = np.array(properties.inertia_kg_m2)
    body = spec.worldbody.add_body(name=OBJECT)
    body.add_freejoint()
    body.explicitinertial = True
    body.mass, body.ipos = properties.mass_kg, properties.centre_of_mass_m
    body.fullinertia = [*np.diag(inertia), inertia[0, 1], inertia[0, 2], inertia[1, 2]]
    for index, (vertices, faces) in enumerate(read_collision(geometry.collision)):
        name = f"{OBJECT}_{index}"
        mesh = spec.add_mesh(name=name, uservert=vertices.ravel(), userface=faces.ravel())
        mesh.inertia = mujoco.mjtMeshInertia.mjMESH_INERTIA_CONVEX
        geom = body.add_geom(name=name, type=mujoco.mjtGeom.mjGEOM_MESH, meshname=name)
        # The object's friction is that of the contact: its priority is higher than the hand's.
        geom.friction[0], geom.priority = settings.friction, 1
        geom.solref[0] = settings.mujoco.contact_time_s
