"""The committed hand: up to date, loads, steps quietly, physical, with our kinematics."""

import os
import subprocess
import sys
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest

from grasptypes.hand import kinematics, urdf
from grasptypes.hand.__main__ import main
from grasptypes.hand.shapes import link_meshes

ASSET = Path(__file__).parents[3] / "assets" / "barrett_hand"
URDF = ASSET / urdf.URDF_NAME
TENTH_MM = 1e-4

STEP_ONE_SECOND = """
import sys, pybullet
client = pybullet.connect(pybullet.DIRECT)
flags = pybullet.URDF_USE_SELF_COLLISION | pybullet.URDF_USE_INERTIA_FROM_FILE
hand = pybullet.loadURDF(sys.argv[1], useFixedBase=True, flags=flags)
for _ in range(240):
    pybullet.stepSimulation()
print(pybullet.getNumJoints(hand))
"""


@pytest.fixture(scope="module")
def physics():
    pybullet = pytest.importorskip("pybullet")
    client = pybullet.connect(pybullet.DIRECT)
    flags = pybullet.URDF_USE_INERTIA_FROM_FILE
    hand = pybullet.loadURDF(str(URDF), useFixedBase=True, flags=flags, physicsClientId=client)
    yield pybullet, client, hand
    pybullet.disconnect(client)


def test_committed_files_are_what_the_code_writes(tmp_path: Path) -> None:
    main([str(tmp_path)])
    written = {path.relative_to(tmp_path) for path in tmp_path.rglob("*.*")}
    kept = {path.relative_to(ASSET) for path in ASSET.rglob("*.*")} - {Path("README.md")}
    assert written == kept
    different = [str(n) for n in written if (tmp_path / n).read_bytes() != (ASSET / n).read_bytes()]
    assert not different


def test_loads_and_steps_for_a_second_without_a_warning() -> None:
    pytest.importorskip("pybullet")
    command = [sys.executable, "-c", STEP_ONE_SECOND, str(URDF)]
    run = subprocess.run(command, capture_output=True, text=True, env=os.environ, check=True)
    said = [line for line in (run.stdout + run.stderr).splitlines() if "build time" not in line]
    assert said == ["8"]


def test_joints_have_the_stated_names_and_limits(physics) -> None:
    pybullet, client, hand = physics
    joints = [pybullet.getJointInfo(hand, j, physicsClientId=client) for j in range(8)]
    by_name = {joint[1].decode(): joint for joint in joints}
    assert sorted(by_name) == sorted(kinematics.JOINT_NAMES)
    for name, limits in zip(kinematics.JOINT_NAMES, kinematics.JOINT_LIMITS_RAD, strict=True):
        np.testing.assert_allclose(by_name[name][8:10], limits, atol=1e-5)


def test_joint_axes_are_unit_vectors_and_only_coupled_joints_mimic() -> None:
    mimics = {}
    for joint in ElementTree.parse(URDF).getroot().iter("joint"):
        assert joint.find("axis").attrib["xyz"] == "0 0 1"
        if joint.find("mimic") is not None:
            mimic = joint.find("mimic").attrib
            mimics[joint.attrib["name"]] = mimic["joint"], float(mimic["multiplier"])
    third = pytest.approx(1 / 3, abs=1e-6)
    distals = {f"distal_{i}": (f"proximal_{i}", third) for i in (1, 2, 3)}
    assert mimics == {"spread_2": ("spread_1", 1.0)} | distals


def test_kinematics_of_the_urdf_equal_the_code(physics) -> None:
    pybullet, client, hand = physics
    infos = [pybullet.getJointInfo(hand, j, physicsClientId=client) for j in range(8)]
    lower, upper = kinematics.JOINT_LIMITS_RAD.T
    angles = np.random.default_rng(1).uniform(lower, upper, (20, 8))
    for sample, expected in zip(angles, kinematics.link_poses(angles), strict=True):
        for index, info in enumerate(infos):
            angle = sample[kinematics.JOINT_NAMES.index(info[1].decode())]
            pybullet.resetJointState(hand, index, angle, physicsClientId=client)
        for index, info in enumerate(infos):
            state = pybullet.getLinkState(
                hand, index, computeForwardKinematics=True, physicsClientId=client
            )
            rotation = np.reshape(pybullet.getMatrixFromQuaternion(state[5]), (3, 3))
            T_hand_link = expected[kinematics.LINK_NAMES.index(info[12].decode())]
            np.testing.assert_allclose(state[4], T_hand_link[:3, 3], atol=TENTH_MM)
            np.testing.assert_allclose(rotation, T_hand_link[:3, :3], atol=1e-4)


def test_fingertips_of_the_urdf_are_where_stated(physics) -> None:
    pybullet, client, hand = physics
    for index in range(8):
        pybullet.resetJointState(hand, index, 0.0, physicsClientId=client)
    tips = {}
    for index in range(8):
        link = pybullet.getJointInfo(hand, index, physicsClientId=client)[12].decode()
        if link.startswith("distal"):
            state = pybullet.getLinkState(hand, index, True, True, physicsClientId=client)
            tips[link] = pybullet.multiplyTransforms(*state[4:6], [0.055, 0, 0], [0, 0, 0, 1])[0]
    expected = {"distal_1": [0.025, 0.1586, 0.044], "distal_2": [-0.025, 0.1586, 0.044]}
    for link, tip in (expected | {"distal_3": [0, -0.1586, 0.044]}).items():
        np.testing.assert_allclose(tips[link], tip, atol=TENTH_MM)


def _inertials() -> dict[str, tuple[float, np.ndarray, np.ndarray]]:
    """Mass, centre and inertia matrix of every link as the file states them."""
    found = {}
    for link in ElementTree.parse(URDF).getroot().iter("link"):
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


def test_masses_are_the_stated_ones() -> None:
    inertials = _inertials()
    assert tuple(inertials) == kinematics.LINK_NAMES
    assert sum(mass for mass, _, _ in inertials.values()) == pytest.approx(1.097, abs=0.002)


def test_inertias_are_physical() -> None:
    for mesh, (mass, centre, inertia) in zip(link_meshes(), _inertials().values(), strict=True):
        moments = np.linalg.eigvalsh(inertia)
        assert moments[0] > 0
        assert moments[0] + moments[1] > moments[2]
        # No thinner than a rod, no wider than a shell: a factor of a thousand would show.
        radii = np.sqrt(moments / mass)
        assert 0.05 * mesh.scale < radii.min()
        assert radii.max() < 0.5 * mesh.scale
        assert mesh.bounding_box.contains([centre]).all()


def test_palm_centre_of_mass_is_near_barretts() -> None:
    """Barrett: (0.05, -4.6, 37.8) mm from the wrist, which lies 79.5 mm below the palm."""
    _, centre, _ = _inertials()["palm"]
    np.testing.assert_allclose(centre, [0.00005, -0.0046, 0.0378 - 0.0795], atol=0.004)


def test_efforts_give_the_stated_fingertip_force() -> None:
    lever = np.hypot(*(kinematics.fingertips(np.zeros(8))[2] - [0, -0.05, -0.001])[1:])
    assert urdf.joint_effort_nm("proximal_3") == pytest.approx(15.0 * lever)
    assert urdf.joint_effort_nm("distal_1") == pytest.approx(15.0 * 0.055)
    assert urdf.joint_effort_nm("spread_1") < urdf.joint_effort_nm("proximal_1")


def test_obj_text_does_not_depend_on_the_order_of_vertices() -> None:
    vertices = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], dtype=float)
    faces = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]])
    order = np.array([2, 0, 3, 1])
    text = urdf.obj_text(vertices[order], np.argsort(order)[faces][::-1])
    assert text == urdf.obj_text(vertices, faces)
    assert text.startswith("v 0.000000 0.000000 0.000000\n")
