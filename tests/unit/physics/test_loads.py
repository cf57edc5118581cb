"""The loads of tasks: where they act on an object, how strong they are, and in which directions."""

from dataclasses import replace

import numpy as np
import pytest
from synthesis_cases import ball_object, palm_at

from grasptypes.objects.object_files import SURFACE, Surface, write_surface
from grasptypes.physics.loads import TaskLoad, task_load
from grasptypes.settings.tasks import read_tasks

G = 9.81
AXES = np.eye(3)[[2, 0, 1]]
T = palm_at(0.1)[0]


def object_with(tmp_path, **roles):
    """A ball whose parts, named like their roles, each have one vertex, in a row along x."""
    ball = ball_object(tmp_path)
    names = list(roles)
    points = np.arange(3 * len(names), dtype=float).reshape(-1, 3) * [1, 0, 0] / 100
    surface = Surface(
        points, np.zeros((0, 3), np.int32), np.arange(len(names), dtype=np.int16), np.array(names)
    )
    write_surface(tmp_path / SURFACE, surface)
    known = {name: {"role": role, "attributes": []} for name, role in roles.items()}
    return replace(ball, properties=replace(ball.properties, roles=known)), points


def test_the_first_part_that_the_object_has_decides(tmp_path) -> None:
    use = read_tasks()["use"]
    jug, points = object_with(tmp_path, wall="container_wall", key="button")
    load = task_load(use, jug, G)
    assert load.along == "down"
    np.testing.assert_allclose(load.point_m, points[0])
    assert load.force_n == pytest.approx(jug.properties.mass_kg * G)


def test_an_object_without_such_a_part_is_loaded_at_its_centre_of_mass(tmp_path) -> None:
    ball = ball_object(tmp_path, centre_m=(0.0, 0.0, 0.01))
    load = task_load(read_tasks()["handoff"], ball, G)
    np.testing.assert_allclose(load.point_m, [0.0, 0.0, 0.01])
    # Away from the palm, whichever way the hand looks.
    np.testing.assert_allclose(load.forces(T), [[0.0, 0.0, load.force_n]])


@pytest.mark.parametrize(("along", "count"), [("axis", 2), ("across", 4), ("any", 6), ("down", 1)])
def test_directions_of_the_object_turn_with_it(along, count) -> None:
    load = TaskLoad(np.zeros(3), 2.0, along, AXES)
    forces = load.forces(T)
    assert forces.shape == (count, 3)
    np.testing.assert_allclose(np.linalg.norm(forces, axis=1), 2.0)
    in_object = forces @ T[:3, :3].T
    along_z = np.abs(in_object[:, 2]) > 1.0
    assert along_z.all() if along in ("axis", "down") else along_z.sum() == count - 4


def test_the_longest_axis_is_that_of_the_smallest_moment(tmp_path) -> None:
    ball = ball_object(tmp_path)
    rod = replace(ball.properties, inertia_kg_m2=np.diag([3.0, 1.0, 3.0]).tolist())
    load = task_load(read_tasks()["handoff"], replace(ball, properties=rod), G)
    np.testing.assert_allclose(np.abs(load.axes[0]), [0.0, 1.0, 0.0])
