"""Formats of the field: what is written is read back the same, and bad files are named."""

import json
import os
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from scipy.spatial.transform import RigidTransform, Rotation
from tests.unit.barrett import BARRETT

from grasptypes.errors import InputError
from grasptypes.exchange import dexgraspbench, graspit_world, multigrippergrasp
from grasptypes.exchange.published_csv import authors_columns, posed_hands
from grasptypes.exchange.records import (
    PosedHands,
    from_position_quaternion,
    to_position_quaternion,
)
from grasptypes.hands import configuration
from grasptypes.labels.grasp_type import GRASP_TYPES
from grasptypes.labels.published import read_published


def hands(count=3):
    draw = np.random.default_rng(0)
    turns = Rotation.random(count, rng=draw)
    T = RigidTransform.from_components(draw.uniform(-0.2, 0.2, (count, 3)), turns)
    angles = BARRETT.couple(draw.uniform(0, 2, (count, 4)))
    angles[0, 6] += 0.1  # one fingertip that its clutch has let go
    return PosedHands("mug", BARRETT, T, angles, np.array([True] * (count - 1) + [False]))


def assert_same(first, second, atol):
    assert first.object_name == second.object_name
    assert first.hand is second.hand
    poses = [hands.T_object_hand.as_matrix() for hands in (first, second)]
    np.testing.assert_allclose(*poses, atol=atol)
    np.testing.assert_allclose(first.joint_positions, second.joint_positions, atol=atol)


def one(hands, index):
    rows = (values[index : index + 1] for values in hands[2:])
    return PosedHands(hands.object_name, hands.hand, *rows)


def test_position_and_quaternion_with_w_first():
    quarter = Rotation.from_euler("z", 90, degrees=True)
    T = RigidTransform.from_components([1, 2, 3], quarter)
    half = np.sqrt(0.5)
    np.testing.assert_allclose(to_position_quaternion(T), [1, 2, 3, half, 0, 0, half], atol=1e-12)
    back = from_position_quaternion([1, 2, 3, 2, 0, 0, 2])
    np.testing.assert_allclose(back.as_matrix(), T.as_matrix(), atol=1e-12)
    with pytest.raises(ValueError, match="7 numbers"):
        from_position_quaternion([1, 2, 3])


@pytest.mark.parametrize("index", [0, 1])
def test_graspit_world(tmp_path, index):
    graspit_world.write_world(tmp_path / "w.xml", hands(), index, "models/objects/mug.xml")
    assert_same(graspit_world.read_world(tmp_path / "w.xml", BARRETT), one(hands(), index), 1e-8)


def test_graspit_world_as_graspit_writes_it(tmp_path):
    """Millimetres, a moved object, other bodies and robots, and ten values for the hand."""
    (tmp_path / "w.xml").write_text(
        """<?xml version="1.0" ?><world>
        <obstacle><filename>models/obstacles/table.xml</filename></obstacle>
        <graspableBody><filename>models/objects/glass.xml</filename>
          <transform><fullTransform>(+1 0 0 0)[+100 0 0]</fullTransform></transform></graspableBody>
        <robot><filename>models/robots/Puma560/Puma560.xml</filename></robot>
        <robot><filename>models/robots/Barrett/Barrett.xml</filename>
          <dofValues>+0.5 +0.9 +0 +0 +0.9 +1 +0.6 +0.9 +0 +0</dofValues>
          <transform><fullTransform>(+1 0 0 0)[+100 +20 -50]</fullTransform></transform></robot>
        </world>"""
    )
    world = graspit_world.read_world(tmp_path / "w.xml", BARRETT)
    assert world.object_name == "glass"
    np.testing.assert_allclose(world.T_object_hand[0].translation, [0, 0.02, -0.05], atol=1e-12)
    expected = [0.5, 0.5, 0.9, 0.6, 0.9, 0.3, 0.3, 0.3]
    np.testing.assert_allclose(world.joint_positions[0], expected)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("<dofValues>", "<dofValues>1 ", "11 numbers"),
        ("<fullTransform>(", "<fullTransform>[", "is not a pose"),
    ],
)
def test_bad_graspit_world(tmp_path, old, new, message):
    path = tmp_path / "w.xml"
    graspit_world.write_world(path, hands(), 0, "mug.xml")
    path.write_text(path.read_text().replace(old, new))
    with pytest.raises(InputError, match=message):
        graspit_world.read_world(path, BARRETT)


def test_multigrippergrasp(tmp_path):
    multigrippergrasp.write_grasps(tmp_path / "g.json", hands())
    read = multigrippergrasp.read_grasps(tmp_path / "g.json", BARRETT)
    assert_same(read, hands(), 1e-12)
    assert read.held.tolist() == [True, True, False]


def test_multigrippergrasp_joints_in_another_order(tmp_path):
    path = tmp_path / "g.json"
    multigrippergrasp.write_grasps(path, hands())
    content = json.loads(path.read_text())
    content["joint_names"] = content["joint_names"][::-1]
    content["dofs"] = [row[::-1] for row in content["dofs"]]
    path.write_text(json.dumps(content))
    assert_same(multigrippergrasp.read_grasps(path, BARRETT), hands(), 1e-12)


@pytest.mark.parametrize(
    ("key", "value", "message"),
    [
        ("dofs", [[1.0]], "8 numbers"),
        ("pose", None, "pose: is missing"),
    ],
)
def test_bad_multigrippergrasp(tmp_path, key, value, message):
    path = tmp_path / "g.json"
    multigrippergrasp.write_grasps(path, hands())
    content = {**json.loads(path.read_text()), key: value}
    path.write_text(json.dumps({k: v for k, v in content.items() if v is not None}))
    with pytest.raises(InputError, match=message):
        multigrippergrasp.read_grasps(path, BARRETT)


def test_dexgraspbench(tmp_path):
    path = tmp_path / "0.npy"
    dexgraspbench.write_grasp(path, hands(), 0, 1.15, "assets/object/mug")
    assert_same(dexgraspbench.read_grasp(path, BARRETT), one(hands(), 0), 1e-12)
    content = np.load(path, allow_pickle=True).item()
    assert content["obj_scale"] == 1.15
    before, grasp, after = (content[f"{name}_qpos"] for name in ("pregrasp", "grasp", "squeeze"))
    assert (before[9:] < grasp[9:]).all()
    assert (after[9:] >= grasp[9:]).all()
    assert (after[7:] <= BARRETT.joint_limits[:, 1]).all()


@pytest.mark.parametrize("content", [b"", b"text"])
def test_not_dexgraspbench(tmp_path, content):
    (tmp_path / "0.npy").write_bytes(content)
    with pytest.raises(InputError, match="not a DexGraspBench grasp"):
        dexgraspbench.read_grasp(tmp_path / "0.npy", BARRETT)


def test_published_csv(tmp_path):
    mine = hands()
    mine = mine._replace(joint_positions=BARRETT.couple(mine.joint_positions[:, [0, 2, 3, 4]]))
    dofs = mine.joint_positions[:, [0, 2, 3, 4]]
    table = pd.DataFrame(
        {
            "object": "mug",
            "task": "use",
            "session": [1, 2, 3],
            "grasp_type": ["Precision", "Large Wrap", "Invalid"],
            "rank": 0,
            "energy": [-0.2, -0.1, 0.0],
            "pose_index": 0,
            "hand_configuration": list(configuration.pack(0, mine.T_object_hand.as_matrix(), dofs)),
            "image": "screenshots/mug.png",
        }
    )
    authors_columns(table, GRASP_TYPES).to_csv(tmp_path / "g.csv", index=False)
    read = read_published(tmp_path / "g.csv")
    assert read.grasp_type_index.tolist() == [6, 1, 7]
    assert read["rank"].tolist() == [1, 1, 1]
    back = posed_hands(read, "mug", BARRETT)
    assert_same(back, mine, 1e-8)
    assert back.held.tolist() == [True, True, False]


def test_the_authors_own_file(tmp_path):
    source = os.environ.get("GRASPTYPES_PUBLISHED_CSV", "")
    if not source:
        pytest.skip("GRASPTYPES_PUBLISHED_CSV is not set")
    published = read_published(Path(source))
    known = published[published.hand_configuration.notna()]
    written = authors_columns(known.assign(rank=known["rank"] - 1), GRASP_TYPES)
    written.to_csv(tmp_path / "g.csv", index=False)
    again = read_published(tmp_path / "g.csv")
    np.testing.assert_allclose(
        np.stack(again.hand_configuration), np.stack(known.hand_configuration), rtol=1e-8
    )
    assert again.grasp_type.tolist() == known.grasp_type.tolist()


def test_a_tip_pressed_behind_its_finger_counts_as_coupled() -> None:
    """GraspIt!'s clutch lets a tip go ahead, never back."""
    behind = BARRETT.couple(np.radians([0.0, 90.0, 90.0, 90.0]))
    behind[5] -= 0.02
    behind[6] += 0.02
    values = graspit_world.dof_values(BARRETT, behind)
    assert values[2] == 0.0
    assert values[1] == behind[2]
    assert values[5] == 1.0
    assert values[6] == behind[3]
