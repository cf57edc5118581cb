"""Objects act at the origin on what stands there, and second hands come near without touching."""

import numpy as np
import pandas as pd
import pytest
from scipy.spatial import cKDTree
from tests.unit.barrett import BARRETT
from tests.unit.settings import PARAMS

from grasptypes.errors import InputError
from grasptypes.hands import configuration
from grasptypes.objects.affordances import afforded
from grasptypes.objects.object_files import Surface
from grasptypes.objects.part_roles import part_roles
from grasptypes.renders.demonstrations import Shown, body_part, handovers, scenes, uses
from grasptypes.renders.scene import Part
from grasptypes.settings.demonstrations import Body, DemonstrationTable, read_demonstrations

ANGLES = BARRETT.couple(np.radians([[30.0, 60.0, 60.0, 60.0]]))[0]
ROUGH_M = 0.01


def ball(name: str, part: str) -> Shown:
    """A ball of 8 cm as an object with one part."""
    shape = body_part(Body(shape="ball", size_m=(0.08,) * 3, at_m=(0, 0, 0), rgb=(1, 0, 0)))
    index = np.zeros(len(shape.vertices), dtype=int)
    surface = Surface(shape.vertices, shape.faces, index, np.array([part]))
    return Shown(name, [shape], surface, BARRETT)


def grasps(*towards: tuple[float, float, float]) -> pd.DataFrame:
    """Hands that are 15 cm away in some directions, also before they grasp."""
    rows = []
    for direction in towards:
        pose = np.eye(4)
        pose[:3, 3] = 0.15 * np.array(direction)
        numbers = configuration.pack(0, pose, ANGLES[[0, 2, 3, 4]])
        hand = {"hand_configuration": numbers.tolist(), "joint_angles_rad": ANGLES.tolist()}
        open_hand = {"pregrasp_pose": pose[:3].ravel().tolist(), "pregrasp_joints": ANGLES.tolist()}
        rows.append(hand | open_hand)
    return pd.DataFrame(rows)


def points(parts: list[Part]) -> np.ndarray:
    return np.concatenate([part.vertices for part in parts])


def test_a_round_object_acts_at_the_origin_with_the_hand_behind():
    settings = PARAMS.demonstrations.changed(grasps=9)
    scenes = uses(ball("apple", "flesh"), grasps((0, 1, 0), (0.6, -0.8, 0)), settings)
    bodies = len(read_demonstrations().actions["to_the_mouth"].bodies)
    assert len(scenes) == 2
    for scene in scenes:
        thing, hand = points(scene[:1]), points(scene[1:-bodies])
        assert thing[:, 0].max() == pytest.approx(0, abs=0.003)
        assert abs(thing.mean(axis=0)[1]) < 0.003
        assert hand.mean(axis=0)[0] < -0.1


def test_what_acts_downwards_ends_at_the_ground():
    scene = uses(ball("mouse", "body"), grasps((0, 0, 1)), PARAMS.demonstrations)[0]
    assert points(scene[:1])[:, 2].min() == pytest.approx(0, abs=0.003)
    bodies = len(read_demonstrations().actions["point"].bodies)
    assert points(scene[1:-bodies]).mean(axis=0)[2] > 0.1


def test_the_second_hand_comes_as_near_as_the_settings_say():
    taken = grasps((1, 0, 0), (-1, 0, 0), (0, 0, 1))
    settings = PARAMS.demonstrations.changed(grasps=1, handover_m=0.03)
    scene = handovers(ball("apple", "flesh"), taken, settings)[0]
    first, second = np.array_split(np.array(scene[1:], dtype=object), 2)
    tree = cKDTree(points(list(second)))
    gap_m = tree.query(np.concatenate([points(list(first)), points(scene[:1])]))[0].min()
    assert gap_m == pytest.approx(0.03, abs=ROUGH_M)


def test_the_grasp_alone_is_shown_as_it_is_in_the_scene():
    apple, taken = ball("apple", "flesh"), grasps((0, 1, 0), (0, -1, 0))
    basin = len(read_demonstrations().actions["rinse"].bodies)
    for task, more in (("handoff", None), ("wash", basin)):
        whole = scenes(apple, taken, task, PARAMS.demonstrations)
        alone = scenes(apple, taken, task, PARAMS.demonstrations, alone=True)
        assert len(alone) == len(whole) == 2
        for part, other in zip(alone, whole, strict=True):
            assert len(other) - len(part) == (more or len(part) - 1)
            assert (points(part) == points(other[: len(part)])).all()


def test_every_object_of_the_table_has_the_part_that_acts():
    table = read_demonstrations()
    for uses_of in (table.uses, *table.tasks.values()):
        for name, use in uses_of.items():
            assert not use.part or use.part in part_roles(name), name


def test_every_task_that_an_object_affords_can_be_shown():
    table = read_demonstrations()
    for name, task in afforded(list(table.uses), list(PARAMS.many_tasks.tasks)):
        assert task == "handoff" or table.use_of(name, task).action in table.actions
    with pytest.raises(InputError, match=r"tasks\.cut\.mug: is missing"):
        table.use_of("mug", "cut")


def test_objects_without_a_use_or_the_part_are_errors():
    for name, part, message in (("ball", "skin", "uses.ball"), ("apple", "skin", "'flesh' is not")):
        with pytest.raises(InputError, match=message):
            uses(ball(name, part), grasps((1, 0, 0)), PARAMS.demonstrations)
    with pytest.raises(InputError, match="no valid grasp"):
        handovers(ball("apple", "flesh"), grasps(), PARAMS.demonstrations)


def test_a_table_names_known_actions_and_two_directions():
    known = read_demonstrations().model_dump()
    apple = known["uses"]["apple"]
    for change, message in (({"action": "juggle"}, "'juggle' is not"), ({"up": (1, 0, 0)}, "up")):
        changed = known | {"uses": {"apple": apple | change}}
        with pytest.raises(InputError, match=message):
            DemonstrationTable.check(changed)
