"""Both engines obey mechanics, and hold the same ball with the same hand."""

import numpy as np
import pytest
import trimesh
from synthesis_cases import CLOSING, RADIUS_M, ball_object, closed, palm_at
from tests.unit.barrett import BARRETT
from tests.unit.settings import PARAMS

from grasptypes.hands.folders import hand_names
from grasptypes.hands.reading import load_hand
from grasptypes.objects.distance_grid import DistanceGrid
from grasptypes.objects.object_files import read_collision, write_collision
from grasptypes.physics.engines import engine
from grasptypes.physics.holding import hold, run, squeeze
from grasptypes.physics.motors import Motors
from grasptypes.synthesis.closing import close_fingers
from grasptypes.synthesis.fields import field
from grasptypes.synthesis.hand_model import hand_model
from grasptypes.synthesis.scene import GraspScene

ENGINES = ("pybullet", "mujoco")
SETTINGS = PARAMS.physics.test.changed(shake=False)
GRAVITY = np.array([0.0, 0.0, 9.81])
OPEN = BARRETT.couple([0.0, 0.0, 0.0, 0.0])
TIPS = palm_at(0.1)[0], closed(palm_at(0.1), 0.0)[0]


# What a squeezed ball may move in 0.1 s. Bullet's motors, which are given speeds, shake it.
REST_M = {"BulletEngine": 2e-3, "MujocoEngine": 1e-4}


@pytest.fixture(params=ENGINES)
def world(request, tmp_path):
    with engine(request.param, BARRETT, ball_object(tmp_path), SETTINGS) as world:
        yield world


def start(world, T, positions):
    world.load(T, positions)
    motors = Motors(BARRETT, positions, np.full(3, BARRETT.motors.fingertip_force_n))
    for finger, stage in enumerate(motors.stages):
        world.couple(finger, stage)
    return motors


def centre(world):
    return world.T_hand_object()[:3, 3]


def test_hand_and_object_start_where_they_are_put(world) -> None:
    T, positions = TIPS
    T = T @ trimesh.transformations.rotation_matrix(0.3, [1, 2, 3])
    world.load(T, positions)
    np.testing.assert_allclose(world.T_hand_object() @ T, np.eye(4), atol=1e-6)
    np.testing.assert_allclose(world.joint_positions(), positions, atol=1e-9)


def test_hundreds_of_contacts_are_no_error(tmp_path) -> None:
    ball = ball_object(tmp_path)
    parts = list(read_collision(ball.collision))
    write_collision(ball.collision, parts * 150)
    with engine("mujoco", BARRETT, ball, SETTINGS) as world:
        start(world, *TIPS)
        world.step(1)
        assert len(world.contacts()) > 450


def test_a_free_object_falls_as_gravity_says_and_does_not_turn(world) -> None:
    start(world, palm_at(0.5)[0], OPEN)
    world.accelerate(GRAVITY)
    before = world.T_hand_object()
    world.step(100)
    seconds = 100 * SETTINGS.timestep_s
    fallen = world.T_hand_object() - before
    step = SETTINGS.timestep_s * seconds * 9.81
    assert fallen[2, 3] == pytest.approx(0.5 * 9.81 * seconds**2, abs=step)
    np.testing.assert_allclose(fallen[:3, :3], 0.0, atol=1e-6)


def test_an_object_that_falls_on_the_palm_gains_no_energy(world) -> None:
    height = 0.1
    motors = start(world, palm_at(height)[0], OPEN)
    world.accelerate(-GRAVITY)
    heights = []
    for _ in range(100):
        run(world, motors, 1)
        heights.append(centre(world)[2])
    assert max(heights) <= height + 1e-6
    # At rest on the palm, within the collision margin of 1 mm, in which MuJoCo's contacts yield.
    assert heights[-1] == pytest.approx(RADIUS_M + 0.0007, abs=0.0005)


def test_a_squeezed_object_comes_to_rest(world) -> None:
    motors = start(world, *TIPS)
    run(world, motors, 100)
    before = world.T_hand_object()
    run(world, motors, 10)
    moved_m = np.linalg.norm((world.T_hand_object() - before)[:3, 3])
    assert moved_m < REST_M[type(world).__name__]


def test_a_start_in_the_object_does_not_throw_it(world) -> None:
    T, positions = TIPS
    deeper = positions + 0.015 * (positions > 0.0)
    deeper[5:] = positions[5:] + 0.005  # coupled: 1.5 mm into the ball
    motors = start(world, T, deeper)
    before = centre(world)
    run(world, motors, 20)
    assert np.linalg.norm(centre(world) - before) < 0.01


@pytest.mark.parametrize("name", ENGINES)
def test_fingertips_without_friction_drop_what_they_hold_with_friction(name, tmp_path) -> None:
    body, smooth = ball_object(tmp_path), SETTINGS.changed(friction=0.0)
    with engine(name, BARRETT, body, SETTINGS) as world:
        assert not hold(world, *TIPS).dropped
    with engine(name, BARRETT, body, smooth) as world:
        assert hold(world, *TIPS).dropped


@pytest.mark.parametrize("name", ENGINES)
def test_the_same_test_has_the_same_result_to_the_last_bit(name, tmp_path) -> None:
    with engine(name, BARRETT, ball_object(tmp_path), SETTINGS) as world:
        first = hold(world, *TIPS)
        hold(world, palm_at(0.06)[0], OPEN)
        again = hold(world, *TIPS)
    assert first.T_object_hand.tobytes() == again.T_object_hand.tobytes()
    assert first.joint_positions.tobytes() == again.joint_positions.tobytes()


@pytest.mark.parametrize("name", hand_names())
@pytest.mark.parametrize("engine_name", ENGINES)
def test_every_hand_squeezes_a_ball_with_its_force(engine_name, name, tmp_path) -> None:
    hand, body = load_hand(name), ball_object(tmp_path)
    mesh = trimesh.creation.icosphere(subdivisions=4, radius=RADIUS_M)
    grid = field(DistanceGrid.from_mesh(mesh.vertices, mesh.faces, 0.002, 0.02))
    model = hand_model(hand, 0.006, 0.012, 0.004, 0.02)
    scene = GraspScene(hand, model, grid, np.zeros(3), RADIUS_M, np.asarray(mesh.vertices))
    preshape = np.array([hand.grips.named("tripod").preshapes[0]])
    height = 0.04 if hand.direct else 0.1
    states = close_fingers(scene, palm_at(height), preshape, CLOSING)
    weightless = SETTINGS.changed(gravity_m_s2=0.0)
    totals = []
    with engine(engine_name, hand, body, weightless) as world:
        motors = squeeze(world, states.T_object_hand[0], states.joint_positions[0])
        for _ in range(20):
            run(world, motors, 1)
            contacts = world.contacts()
            totals.append(sum(contact.force_n for contact in contacts))
        positions = world.joint_positions()
    assert len({contact.link for contact in contacts}) >= 2
    # Bullet's contact forces change from step to step: one of them says little.
    assert np.mean(totals) > 0.95 * hand.motors.fingertip_force_n
    # No joint lags behind its coupling; a stop may let it move ahead.
    assert hand.lag(positions).max() < PARAMS.physics.validity.lag_tolerance_rad
