"""A hand of one's own is read as its URDF says, and mistakes are named with file and key."""

import re
import xml.etree.ElementTree as ElementTree
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh
import yourdfpy
from bullet import bullet_poses
from own_hand import URDF, write_hand
from trimesh.transformations import euler_matrix

from grasptypes.errors import InputError
from grasptypes.hands.folders import hand_files, hand_names
from grasptypes.hands.hand import Hand
from grasptypes.hands.reading import load_hand
from grasptypes.hands.urdf import write_urdf

LINKS = ("wrist", "post", "index_1", "thumb", "index_2", "index_3")
JOINTS = ("turn", "index_1", "slide", "index_2", "index_3")
MICROMETRE = 1e-6


@pytest.fixture(scope="module")
def folder(tmp_path_factory) -> Path:
    return write_hand(tmp_path_factory.mktemp("own") / "hand")


@pytest.fixture(scope="module")
def hand(folder: Path) -> Hand:
    return load_hand(folder)


@pytest.fixture(scope="module")
def original(folder: Path) -> yourdfpy.URDF:
    return yourdfpy.URDF.load(str(folder / "hand.urdf"))


@pytest.fixture(scope="module")
def positions(hand: Hand) -> np.ndarray:
    """(12, 5) the first all at zero."""
    draw = np.random.default_rng(2)
    drawn = draw.uniform(*hand.joint_limits.T, (12, len(hand.joints)))
    drawn[0] = 0.0
    return drawn


def stated_poses(original: yourdfpy.URDF, hand: Hand, positions: np.ndarray, link: str):
    """(n, 4, 4) of a link of the URDF in the hand's frame, by yourdfpy."""
    T_wrist_hand = euler_matrix(0.1, -0.2, 1.4, "sxyz")
    T_wrist_hand[:3, 3] = 0.002, -0.003, 0.01
    poses = []
    for row in positions:
        original.update_cfg(dict(zip(hand.joint_names, row, strict=True)))
        poses.append(np.linalg.inv(T_wrist_hand) @ original.get_transform(link, "wrist"))
    return np.array(poses)


def posed(poses: np.ndarray, points: np.ndarray) -> np.ndarray:
    """Points (m, 3), transformed by poses (n, 4, 4): (n, m, 3)."""
    return np.einsum("nij,mj->nmi", poses[:, :3, :3], points) + poses[:, None, :3, 3]


def test_links_and_joints_are_in_the_hand_s_order(hand: Hand, folder: Path) -> None:
    assert hand.title == "Own hand"
    assert Path(hand.folder) == folder
    assert hand.link_names == LINKS
    assert hand.joint_names == JOINTS
    assert [joint.parent for joint in hand.joints] == [0, 1, 0, 2, 4]
    assert [joint.prismatic for joint in hand.joints] == [False, False, True, False, False]
    assert hand.dof_names == ("turn", "index", "thumb")
    assert [finger.joints for finger in hand.fingers] == [(1, 3, 4), (2,)]
    assert hand.tip_links == (5, 3)
    assert hand.ignored_pairs == {(0, 2)}
    assert hand.path(hand.fingers[0]) == (5, 4, 2, 1)
    assert not hand.direct
    assert hand.grips.named("tripod") == hand.grips.named("pinch")


def test_limits_drives_and_friction_are_those_of_the_urdf(hand: Hand) -> None:
    expected = [[-0.5, 0.4], [0, 1.5], [0, 0.04], [-0.1, 1.2], [0, 1]]
    np.testing.assert_array_equal(hand.joint_limits, expected)
    assert [joint.effort for joint in hand.joints] == [1, 2, 20, 1.5, 1]
    assert [joint.speed for joint in hand.joints] == [2, 3, 0.1, 3, 3]
    assert [link.friction for link in hand.links] == [0.7, *[1.0] * 5]
    np.testing.assert_array_equal(hand.dof_limits, [[-0.5, 0.4], [0, 1.5], [0, 0.04]])


def test_tolerances_of_limits_are_radians_or_metres(hand: Hand) -> None:
    """0.01 rad beyond a limit is little, 0.01 m is a quarter of what the thumb moves."""
    positions = hand.joint_limits[:, 1] + 0.01
    assert hand.beyond_limits(positions, 0.02, 0.001).tolist() == hand.prismatic_joints.tolist()
    assert hand.beyond_limits(positions, 0.001, 0.02).tolist() == [True, True, False, True, True]
    assert hand.prismatic_dofs.tolist() == [False, False, True]


def test_links_move_as_yourdfpy_moves_them(hand: Hand, original, positions) -> None:
    poses = hand.link_poses(positions)
    turned = poses[:, :, :3, :3] @ np.swapaxes(poses[0, :, :3, :3], -1, -2)
    for index, link in enumerate(hand.links):
        stated = stated_poses(original, hand, positions, link.name)
        if index:
            np.testing.assert_allclose(poses[:, index, :3, 3], stated[:, :3, 3], atol=1e-12)
        relative = stated[:, :3, :3] @ stated[0, :3, :3].T
        np.testing.assert_allclose(turned[:, index], relative, atol=1e-12)


def test_z_of_a_link_is_the_axis_of_its_joint_in_the_urdf(hand: Hand, original, positions) -> None:
    poses = hand.link_poses(positions)
    for index, name in enumerate(hand.joint_names, start=1):
        axis = np.array(original.joint_map[name].axis)
        stated = stated_poses(original, hand, positions, hand.link_names[index])
        expected = stated[:, :3, :3] @ (axis / np.linalg.norm(axis))
        np.testing.assert_allclose(poses[:, index, :3, 2], expected, atol=1e-12)


def test_fingertips_are_the_stated_points_of_the_last_links(hand, original, positions) -> None:
    tips = hand.fingertips(positions)
    for column, (link, tip_m) in enumerate(
        [("index_3", [0.002, 0.0, 0.028]), ("thumb", [0.01, 0.0, 0.06])]
    ):
        expected = posed(stated_poses(original, hand, positions, link), np.array([tip_m]))
        np.testing.assert_allclose(tips[:, column], expected[:, 0], atol=1e-12)


def corners(points: np.ndarray) -> np.ndarray:
    """Points (m, 3), without doubles, in an order that depends on nothing but them."""
    rounded = np.unique(np.round(points, 9) + 0.0, axis=0)
    return rounded[np.lexsort(np.round(rounded, 6).T)]


def test_boxes_of_all_members_of_a_link_are_where_the_urdf_puts_them(
    hand: Hand, original, positions
) -> None:
    poses = hand.link_poses(positions[:3])
    boxes = 0
    for index, link in enumerate(hand.links):
        members = [link.name, *{"wrist": ["plate"], "index_3": ["pad"]}.get(link.name, [])]
        shapes = [(name, s) for name in members for s in original.link_map[name].collisions]
        assert len(shapes) == len(link.parts)
        for part, (member, shape) in zip(link.parts, shapes, strict=True):
            if shape.geometry.box is None:
                continue
            boxes += 1
            T_shape = np.eye(4) if shape.origin is None else shape.origin
            box = trimesh.creation.box(shape.geometry.box.size)
            stated = stated_poses(original, hand, positions[:3], member) @ T_shape
            for mine, theirs in zip(
                posed(poses[:, index], part.vertices_m), posed(stated, box.vertices), strict=True
            ):
                np.testing.assert_allclose(corners(mine), corners(theirs), atol=1e-9)
    assert boxes == 4


def test_round_shapes_have_their_size_and_place(hand: Hand) -> None:
    parts = {part.name: part for link in hand.links for part in link.parts}
    assert len(parts) == 8
    for name, (size, volume) in {
        "post_0": ((0.016,) * 3, 4 / 3 * np.pi * 0.008**3),
        "pad_0": ((0.012,) * 3, 4 / 3 * np.pi * 0.006**3),
        "wrist_0": (None, np.pi * 0.03**2 * 0.07),
        "index_2_0": (None, np.pi * 0.006**2 * 0.026),
    }.items():
        mesh = trimesh.Trimesh(parts[name].vertices_m, parts[name].faces)
        assert mesh.is_watertight
        assert mesh.is_convex
        # 24 corners to a round: a circle loses 1 %, a sphere 4 %.
        assert 0.95 * volume < mesh.volume <= volume
        if size:
            lengths = np.linalg.norm(mesh.vertices - mesh.centroid, axis=1)
            np.testing.assert_allclose(2 * lengths, size[0], rtol=1e-6)


def test_a_mesh_is_scaled_to_metres(hand: Hand) -> None:
    (visual,) = hand.links[2].visuals
    np.testing.assert_allclose(
        sorted(np.ptp(visual.vertices_m, axis=0)), [0.012, 0.014, 0.036], atol=1e-9
    )
    assert visual.material == "blue"


def test_colours_come_from_the_robot_or_the_shape(hand: Hand) -> None:
    wrist = {visual.material: visual.rgba for visual in hand.links[0].visuals}
    assert wrist == {"blue": (0.1, 0.2, 0.8, 1.0), "red": (0.9, 0.1, 0.1, 1.0)}


def test_masses_of_fixed_links_add_up(hand: Hand, original) -> None:
    """Against a sum of moments about the hand's origin, in its frame."""
    home = np.zeros((1, len(hand.joints)))
    for link, T, members in zip(
        hand.links,
        hand.link_poses(home)[0],
        [("wrist", "plate"), ("post",), ("index_1",), ("thumb",), ("index_2",), ("index_3", "pad")],
        strict=True,
    ):
        mass, first, second = 0.0, np.zeros(3), np.zeros((3, 3))
        for name in members:
            inertial = original.link_map[name].inertial
            origin = np.eye(4) if inertial.origin is None else inertial.origin
            at = stated_poses(original, hand, home, name)[0] @ origin
            R, c, m = at[:3, :3], at[:3, 3], inertial.mass
            mass, first = mass + m, first + m * c
            second += R @ inertial.inertia @ R.T + m * (c @ c * np.eye(3) - np.outer(c, c))
        assert link.mass_kg == pytest.approx(mass)
        centre = T[:3, :3] @ link.centre_of_mass_m + T[:3, 3]
        np.testing.assert_allclose(centre, first / mass, atol=1e-12)
        mine = T[:3, :3] @ link.inertia_kg_m2 @ T[:3, :3].T
        mine = mine + mass * (centre @ centre * np.eye(3) - np.outer(centre, centre))
        np.testing.assert_allclose(mine, second, atol=1e-12)


def test_pybullet_moves_what_is_written_for_it_alike(hand: Hand, positions, tmp_path) -> None:
    expected = hand.link_poses(positions)[:, 1:]
    found = bullet_poses(write_urdf(hand, tmp_path), hand, positions)
    # The origin of each of four joints is rounded to a micrometre.
    np.testing.assert_allclose(found[..., 3], expected[..., :3, 3], atol=3 * MICROMETRE)
    np.testing.assert_allclose(found[..., :3], expected[..., :3, :3], atol=1e-6)


def test_what_is_written_reads_as_the_same_hand(hand: Hand, positions, tmp_path) -> None:
    path = write_urdf(hand, tmp_path)
    # yourdfpy obeys `mimic`; here each joint moves on its own.
    path.write_text(re.sub("<mimic [^>]*>", "", path.read_text()))
    original = yourdfpy.URDF.load(str(path))
    poses = hand.link_poses(positions)
    for row, pose in zip(positions, poses, strict=True):
        original.update_cfg(dict(zip(hand.joint_names, row, strict=True)))
        for name, T in zip(hand.link_names, pose, strict=True):
            np.testing.assert_allclose(original.get_transform(name), T, atol=3 * MICROMETRE)


def test_followers_of_an_underactuated_finger_mimic_its_first_joint(hand, tmp_path) -> None:
    mimics = {
        joint.attrib["name"]: (mimic.attrib["joint"], float(mimic.attrib["multiplier"]))
        for joint in ElementTree.parse(write_urdf(hand, tmp_path)).getroot().iter("joint")
        if (mimic := joint.find("mimic")) is not None
    }
    assert mimics == {"index_2": ("index_1", 0.8), "index_3": ("index_1", 0.5)}


def test_mimicking_joints_move_as_coupled_ones(hand: Hand, tmp_path) -> None:
    """Also of fingers that do not open at zero."""
    written = yourdfpy.URDF.load(str(write_urdf(hand, tmp_path)))
    dofs = np.array([0.2, 1.1, 0.01])
    written.update_cfg(dict(zip(("turn", "index_1", "slide"), dofs, strict=True)))
    for name, T in zip(hand.link_names, hand.link_poses(hand.couple(dofs)), strict=True):
        np.testing.assert_allclose(written.get_transform(name), T, atol=3 * MICROMETRE)


def test_fingers_close_from_where_they_open_at_their_rates(hand: Hand) -> None:
    np.testing.assert_allclose(hand.couple([0.2, 0.1, 0.01]), [0.2, 0.1, 0.01, 0.0, 0.05])
    positions = hand.couple([0.2, 1.1, 0.01])
    np.testing.assert_allclose(positions, [0.2, 1.1, 0.01, 0.8, 0.55])
    np.testing.assert_allclose(hand.dofs_of(positions), [0.2, 1.1, 0.01])
    np.testing.assert_allclose(hand.lag(positions), 0.0, atol=1e-12)


def test_a_joint_lags_behind_what_those_before_it_prescribe(hand: Hand) -> None:
    # The first joint was stopped at half its way; the second went on by 0.3, and the third by 0.18.
    positions = hand.couple([0.0, 0.6, 0.0])
    positions[3] += 0.3
    positions[4] += 0.18
    np.testing.assert_allclose(hand.lag(positions), [0, 0, 0, -0.3, 0], atol=1e-12)
    positions[4] -= 0.05
    np.testing.assert_allclose(hand.lag(positions), [0, 0, 0, -0.3, 0.05], atol=1e-12)


def test_all_files_of_a_hand_are_listed(folder: Path) -> None:
    names = [str(path.relative_to(folder)) for path in hand_files(folder)]
    assert names == ["grips.yaml", "hand.urdf", "hand.yaml", "meshes/bar.stl"]


def test_a_folder_may_be_relative_to_another(folder: Path, hand: Hand) -> None:
    assert load_hand("hand", folder.parent) is hand


def without(tag: str, owner: str, urdf: str = URDF) -> str:
    """The URDF without a part of a link or joint."""
    root = ElementTree.fromstring(urdf)
    (parent,) = (node for node in root if node.tag != "material" and named(node, owner, tag))
    for node in parent.findall(tag):
        parent.remove(node)
    return ElementTree.tostring(root, encoding="unicode")


def named(node: ElementTree.Element, owner: str, tag: str) -> bool:
    return node.attrib["name"] == owner and node.find(tag) is not None


def index(**changes: Any) -> dict[str, Any]:
    return {"fingers": {"index": changes}}


def refused(folder: Path) -> str:
    with pytest.raises(InputError) as caught:
        load_hand(folder)
    message = str(caught.value)
    assert "\n" not in message
    assert message.startswith(str(folder))
    return message.removeprefix(f"{folder}/")


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        (
            index(joints=["index_1", "index_2", "turn"]),
            "hand.yaml: fingers.index.joints: 'turn' already belongs to preshape.turn",
        ),
        (
            index(rates=[[1.0, 0.8, 0.5], [0.0, 1.0], [0.0, 0.0, 1.0]]),
            "hand.yaml: fingers.index.rates.1: needs 3 values",
        ),
        (index(bend_rad=[0.0] * 4), "hand.yaml: fingers.index.bend_rad: needs 3 values"),
        (index(thumb=True), "hand.yaml: fingers: needs fingers with `thumb: true`"),
    ],
)
def test_a_mistake_in_the_description_is_named(tmp_path, changes, message) -> None:
    """Here and below, of the kinds that tests/bad_input does not try."""
    assert refused(write_hand(tmp_path / "hand", changes)).startswith(message)


@pytest.mark.parametrize(
    ("urdf", "message"),
    [
        (without("limit", "index_2"), "hand.urdf: joint index_2: its limit has no lower"),
        (URDF.replace('upper="1.5"', ""), "hand.urdf: joint index_1: its limit has no upper"),
        (without("inertial", "thumb"), "hand.urdf: link thumb: has no mass"),
        (without("collision", "thumb"), "hand.urdf: link thumb: has no collision shape"),
    ],
)
def test_a_mistake_in_the_urdf_is_named(tmp_path, urdf, message) -> None:
    assert refused(write_hand(tmp_path / "hand", urdf=urdf)).startswith(message)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        (
            {"instead": {"rim": "enclose"}},
            "grips.yaml: instead: 'rim' is not described: name another one for it (wrap, pinch)",
        ),
        ({"instead": {"wrap": "pinch"}}, "grips.yaml: instead.wrap: the grip is described, too"),
        ({"start_m": 0.0}, "grips.yaml: start_m: 0.0 is below the minimum of 0.1"),
    ],
)
def test_a_mistake_in_the_grips_is_named(tmp_path, changes, message) -> None:
    assert refused(write_hand(tmp_path / "hand", grips=changes)).startswith(message)


def test_an_unknown_hand_is_named_with_those_that_are_known() -> None:
    with pytest.raises(InputError) as caught:
        load_hand("shadow")
    message = str(caught.value)
    assert message.startswith("shadow: no such hand: use ")
    assert all(name in message for name in hand_names())
    assert "hand.yaml" in message
    assert "\n" not in message
