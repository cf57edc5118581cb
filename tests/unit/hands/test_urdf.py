"""The URDF for physics engines: loads, steps quietly, physical, and moves as the hand does."""

import os
import subprocess
import sys
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest
from bullet import bullet_poses, loaded
from tests.unit.barrett import BARRETT, COUPLING, DISTAL_M

from grasptypes.hands.folders import HANDS, hand_files, hand_names
from grasptypes.hands.hand import Hand
from grasptypes.hands.reading import load_hand
from grasptypes.hands.surface import link_meshes
from grasptypes.hands.urdf import obj_text, write_urdf

TENTH_MM, MICROMETRE = 1e-4, 1e-6

STEP_ONE_SECOND = """
import sys, pybullet
client = pybullet.connect(pybullet.DIRECT)
flags = pybullet.URDF_USE_SELF_COLLISION | pybullet.URDF_USE_INERTIA_FROM_FILE
hand = pybullet.loadURDF(sys.argv[1], useFixedBase=True, flags=flags)
for _ in range(240):
    pybullet.stepSimulation()
print(pybullet.getNumJoints(hand))
"""


@pytest.fixture(scope="module", params=hand_names())
def hand(request) -> Hand:
    return load_hand(request.param)


@pytest.fixture(scope="module")
def urdf(hand: Hand, tmp_path_factory) -> Path:
    return write_urdf(hand, tmp_path_factory.mktemp("urdf"))


@pytest.fixture(scope="module")
def barrett_urdf(tmp_path_factory) -> Path:
    return write_urdf(BARRETT, tmp_path_factory.mktemp("barrett"))


def test_the_paper_s_hand_comes_with_the_package() -> None:
    assert "barrett" in hand_names()
    assert Path(BARRETT.folder) == HANDS / "barrett"
    assert BARRETT.title == "BarrettHand"


def test_a_hand_s_folder_has_the_meshes_that_its_urdf_names_and_no_others(hand: Hand) -> None:
    folder = Path(hand.folder)
    meshes = ElementTree.parse(folder / "hand.urdf").getroot().iter("mesh")
    named = {folder / mesh.attrib["filename"] for mesh in meshes}
    files = hand_files(folder.name)
    assert named == {path for path in files if path.suffix in (".obj", ".stl")}
    assert {path.name for path in files if path not in named} == {
        "grips.yaml",
        "hand.urdf",
        "hand.yaml",
    }
    assert (folder / "README.md").is_file()


def test_the_same_hand_gives_the_same_files(hand: Hand, urdf: Path, tmp_path: Path) -> None:
    write_urdf(hand, tmp_path)
    written, again = (
        {path.relative_to(folder): path.read_bytes() for path in folder.rglob("*.*")}
        for folder in (urdf.parent, tmp_path)
    )
    assert written == again
    meshes = ElementTree.parse(urdf).getroot().iter("mesh")
    assert {Path(mesh.attrib["filename"]) for mesh in meshes} | {Path("hand.urdf")} == set(written)


def test_loads_and_steps_for_a_second_without_a_warning(hand: Hand, urdf: Path) -> None:
    pytest.importorskip("pybullet")
    command = [sys.executable, "-c", STEP_ONE_SECOND, str(urdf)]
    run = subprocess.run(command, capture_output=True, text=True, env=os.environ, check=True)
    said = [line for line in (run.stdout + run.stderr).splitlines() if "build time" not in line]
    assert said == [str(len(hand.joints))]


def test_joints_have_the_stated_names_and_limits(hand: Hand, urdf: Path) -> None:
    with loaded(urdf) as (pybullet, client, body):
        count = pybullet.getNumJoints(body, physicsClientId=client)
        infos = [pybullet.getJointInfo(body, j, physicsClientId=client) for j in range(count)]
    by_name = {info[1].decode(): info for info in infos}
    assert sorted(by_name) == sorted(hand.joint_names)
    for joint, child in zip(hand.joints, hand.link_names[1:], strict=True):
        info = by_name[joint.name]
        np.testing.assert_allclose(info[8:10], joint.limits, atol=1e-5)
        np.testing.assert_allclose(info[10:12], [joint.effort, joint.speed], atol=1e-3)
        assert info[12].decode() == child


def test_joint_axes_are_unit_vectors_along_z(hand: Hand, urdf: Path) -> None:
    joints = list(ElementTree.parse(urdf).getroot().iter("joint"))
    assert [joint.attrib["name"] for joint in joints] == list(hand.joint_names)
    assert {joint.find("axis").attrib["xyz"] for joint in joints} == {"0 0 1"}


def test_only_coupled_joints_mimic(barrett_urdf: Path) -> None:
    mimics = {}
    for joint in ElementTree.parse(barrett_urdf).getroot().iter("joint"):
        if joint.find("mimic") is not None:
            mimic = joint.find("mimic").attrib
            mimics[joint.attrib["name"]] = mimic["joint"], float(mimic["multiplier"])
    third = pytest.approx(COUPLING, abs=1e-6)
    distals = {f"distal_{i}": (f"proximal_{i}", third) for i in (1, 2, 3)}
    assert mimics == {"spread_2": ("spread_1", 1.0)} | distals


def test_kinematics_of_the_urdf_equal_the_hand_s(hand: Hand, urdf: Path) -> None:
    positions = np.random.default_rng(1).uniform(*hand.joint_limits.T, (20, len(hand.joints)))
    expected = hand.link_poses(positions)[:, 1:]
    found = bullet_poses(urdf, hand, positions)
    # The origin of each joint is rounded to a micrometre.
    longest = max(len(hand.path(finger)) for finger in hand.fingers)
    atol = MICROMETRE if hand is BARRETT else MICROMETRE * longest
    np.testing.assert_allclose(found[..., 3], expected[..., :3, 3], atol=atol)
    np.testing.assert_allclose(found[..., :3], expected[..., :3, :3], atol=1e-6)


def inertials(urdf: Path) -> dict[str, tuple[float, np.ndarray, np.ndarray]]:
    """Mass, centre and inertia matrix of every link as the file states them."""
    found = {}
    for link in ElementTree.parse(urdf).getroot().iter("link"):
        values = {k: float(v) for k, v in link.find("inertial/inertia").attrib.items()}
        xx, xy, xz, yy, yz, zz = (values[k] for k in ("ixx", "ixy", "ixz", "iyy", "iyz", "izz"))
        centre = np.array(link.find("inertial/origin").attrib["xyz"].split(), dtype=float)
        mass = float(link.find("inertial/mass").attrib["value"])
        found[link.attrib["name"]] = (
            mass,
            centre,
            np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]),
        )
    return found


def test_masses_are_the_stated_ones(barrett_urdf: Path) -> None:
    found = inertials(barrett_urdf)
    assert tuple(found) == BARRETT.link_names
    assert sum(mass for mass, _, _ in found.values()) == pytest.approx(1.097, abs=0.002)
    stated = {"palm": 0.506, "knuckle_1": 0.141, "proximal_2": 0.062, "distal_3": 0.041}
    assert {name: found[name][0] for name in stated} == pytest.approx(stated)


def test_inertials_are_those_of_the_hand(hand: Hand, urdf: Path) -> None:
    for link, (mass, centre, inertia) in zip(hand.links, inertials(urdf).values(), strict=True):
        assert mass == pytest.approx(link.mass_kg, abs=1e-6)
        np.testing.assert_allclose(centre, link.centre_of_mass_m, atol=1e-6)
        np.testing.assert_allclose(inertia, link.inertia_kg_m2, rtol=1e-4, atol=1e-12)


def test_inertias_are_physical(hand: Hand, urdf: Path) -> None:
    found = inertials(urdf).values()
    for mesh, (mass, centre, inertia) in zip(link_meshes(hand), found, strict=True):
        moments = np.linalg.eigvalsh(inertia)
        assert moments[0] > 0
        assert moments[0] + moments[1] > moments[2]
        # No thinner than a rod, no wider than a shell: a factor of a thousand would show.
        radii = np.sqrt(moments / mass)
        assert 0.05 * mesh.scale < radii.min()
        assert radii.max() < 0.5 * mesh.scale
        assert mesh.bounding_box.contains([centre]).all()


def test_palm_centre_of_mass_is_near_barretts(barrett_urdf: Path) -> None:
    """Barrett: (0.05, -4.6, 37.8) mm from the wrist, which lies 79.5 mm below the palm."""
    _, centre, _ = inertials(barrett_urdf)["palm"]
    np.testing.assert_allclose(centre, [0.00005, -0.0046, 0.0378 - 0.0795], atol=0.004)


def test_efforts_give_the_stated_fingertip_force() -> None:
    lever = np.hypot(*(BARRETT.fingertips(np.zeros(8))[2] - [0, -0.05, -0.001])[1:])
    effort = {joint.name: joint.effort for joint in BARRETT.joints}
    assert effort["proximal_3"] == pytest.approx(15.0 * lever, abs=5e-4)
    assert effort["distal_1"] == pytest.approx(15.0 * DISTAL_M, abs=5e-4)
    assert effort["spread_1"] < effort["proximal_1"]


def test_friction_is_the_stated_one(barrett_urdf: Path) -> None:
    assert {link.friction for link in BARRETT.links} == {0.8}
    links = list(ElementTree.parse(barrett_urdf).getroot().iter("lateral_friction"))
    assert [float(link.attrib["value"]) for link in links] == [0.8] * len(BARRETT.links)


def test_obj_text_does_not_depend_on_the_order_of_vertices() -> None:
    vertices = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], dtype=float)
    faces = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]])
    order = np.array([2, 0, 3, 1])
    text = obj_text(vertices[order], np.argsort(order)[faces][::-1])
    assert text == obj_text(vertices, faces)
    assert text.startswith("v 0.000000 0.000000 0.000000\n")
