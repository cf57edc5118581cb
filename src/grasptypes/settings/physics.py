"""Section `physics`: which grasps are valid, and the test in a physics engine."""

from __future__ import annotations

from typing import Literal

from grasptypes.settings.base import Settings, Unique, setting

EngineName = Literal["pybullet", "mujoco"]


class ValiditySettings(Settings):
    """Limits of a valid grasp."""

    max_depth_m: float = setting("penetration depth above which a grasp is invalid", ge=0, le=0.05)
    strict_depth_m: float = setting("stricter depth, which is reported too", ge=0, le=0.05)
    min_links: int = setting("number of links that must touch", ge=1, le=9)
    touch_m: float = setting(
        "distance below which a planned finger counts as touching", ge=0, le=0.005
    )
    limit_tolerance_rad: float = setting(
        "how far a revolute joint may exceed its limit", ge=0, le=0.2
    )
    limit_tolerance_m: float = setting(
        "how far a prismatic joint may exceed its limit", ge=0, le=0.02
    )
    lag_tolerance_rad: float = setting(
        "how far a revolute joint may be behind the motion of its coupled finger", ge=0, le=0.2
    )
    lag_tolerance_m: float = setting(
        "how far a prismatic joint may be behind the motion of its coupled finger", ge=0, le=0.02
    )


class MujocoSettings(Settings):
    """How MuJoCo computes contacts; they have elliptic friction cones."""

    margin_m: float = setting("distance from the hand at which contacts push", ge=0, le=0.005)
    impratio: float = setting("stiffness of friction relative to that along normals", ge=1, le=1000)
    noslip_iterations: int = setting("iterations that remove the remaining slip", ge=0, le=100)
    contact_time_s: float = setting("time constant in which contacts yield", ge=0.001, le=0.1)
    motor_mass_kg: float = setting("inertia of motor and gears at the fingertip", ge=0, le=1)


class BulletSettings(Settings):
    """How PyBullet couples joints and computes contacts."""

    gear_correction: float = setting(
        "share of a coupled fingertip's lag that is corrected per time step", gt=0, le=10
    )
    gear_torque_nm: float = setting("maximum torque of a finger's coupling", gt=0, le=1000)
    contact_stiffness_n_m: float = setting("force of a contact per depth", gt=0, le=1e7)
    contact_damping_n_s_m: float = setting("force of a contact per speed", ge=0, le=1e5)


class PhysicsSettings(Settings):
    """The test in physics engines."""

    engines: Unique[EngineName] = setting(
        "engines in which a grasp must hold; the first one's state is recorded", min_length=1
    )
    timestep_s: float = setting("time step", ge=0.0001, le=0.01)
    friction: float = setting("Coulomb coefficient between hand and object", ge=0, le=5)
    gravity_m_s2: float = setting("acceleration of gravity", ge=0, le=100)
    control_steps: int = setting("time steps between commands to the motors", ge=1, le=100)
    squeeze_time_s: float = setting("closing without gravity", gt=0, le=10)
    hold_time_s: float = setting("holding against gravity", ge=0.1, le=60)
    drop_distance_m: float = setting("movement in the hand that counts as dropped", gt=0, le=1)
    drop_rotation_rad: float = setting("rotation in the hand that counts as dropped", gt=0, le=3.15)
    shake: bool = setting("apply gravity from six sides in turn, each for the holding time")
    grip_weights: float = setting(
        "force of a fingertip in weights of the object, up to the hand's rated force", ge=0, le=20
    )
    thumb_share: float = setting(
        "share of what the thumbs withstand with which the other fingers press at most", gt=0, le=1
    )
    pybullet: BulletSettings
    mujoco: MujocoSettings


class GraspTestSettings(Settings):
    """Which grasps are valid."""

    validity: ValiditySettings
    test: PhysicsSettings
