"""The hand as a URDF with OBJ meshes, written from the dimensions, masses and limits in code."""

from pathlib import Path
from xml.etree import ElementTree as Xml

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.spatial.transform import Rotation

from grasptypes.files import write_text
from grasptypes.hand import kinematics
from grasptypes.hand.parts import convex_parts
from grasptypes.hand.shapes import link_meshes
from grasptypes.hand.visuals import MATERIALS, link_visuals

Array = NDArray[np.float64]
Faces = NDArray[np.int64]

URDF_NAME = "barrett_hand.urdf"

# jhu-lcsr/barrett_model, the best-documented public model: 1.098 kg in all (quoted: 0.98).
LINK_MASSES_KG = {"palm": 0.506, "knuckle": 0.141, "proximal": 0.062, "distal": 0.041}
FRICTION = 0.8

# Barrett: 15 N at the fingertip, open to close in 1.0 s, the whole spread in 0.5 s.
FINGERTIP_FORCE_N = 15.0
CLOSING_TIME_S = 1.0
SPREAD_TIME_S = 0.5
# Barrett's gear ratios, motor to joint: the same motor turns the spread with less torque.
PROXIMAL_GEAR = 125.0
SPREAD_GEAR = 17.5

# Products of inertia below this are rounding errors of a symmetric shape.
ROUNDING_KG_M2 = 1e-12

Element = Xml.Element


def link_mass_kg(link: str) -> float:
    """Mass of a link of `kinematics.LINK_NAMES`."""
    return LINK_MASSES_KG[link.split("_")[0]]


def joint_effort_nm(joint: str) -> float:
    """Joint torque that gives the stated fingertip force with the finger open."""
    kind = joint.split("_")[0]
    if kind == "distal":
        return FINGERTIP_FORCE_N * kinematics.DISTAL_LENGTH_M
    tip = kinematics.fingertips(np.zeros(8))[2]
    lever = np.linalg.norm(tip - kinematics.link_poses(np.zeros(8))[5, :3, 3])
    proximal = FINGERTIP_FORCE_N * float(lever)
    return proximal if kind == "proximal" else proximal * SPREAD_GEAR / PROXIMAL_GEAR


def joint_speed_rad_s(joint: str) -> float:
    """Speed limit of a joint, from the time the hand takes for its whole range."""
    spread, finger = np.diff(kinematics.DOF_LIMITS_RAD[:2]).ravel()
    if joint.startswith("spread"):
        return float(spread / SPREAD_TIME_S)
    ratio = kinematics.DISTAL_RATIO if joint.startswith("distal") else 1.0
    return float(finger / CLOSING_TIME_S * ratio)


def write_hand(folder: str | Path) -> list[Path]:
    """Write the URDF and every mesh it names below `folder`; the same bytes each time.

    Returns:
        All files written, the URDF first.
    """
    folder = Path(folder)
    robot = Xml.Element("robot", name="barrett_hand")
    for name, rgba in MATERIALS.items():
        Xml.SubElement(_add(robot, "material", name=name), "color", rgba=_numbers(rgba))
    meshes = {}
    for index, link in enumerate(kinematics.LINK_NAMES):
        meshes.update(_add_link(robot, index, link))
    for joint, limits in zip(kinematics.JOINTS, kinematics.JOINT_LIMITS_RAD, strict=True):
        _add_joint(robot, joint, limits)
    Xml.indent(robot)
    text = '<?xml version="1.0"?>\n' + Xml.tostring(robot, encoding="unicode") + "\n"
    write_text(folder / URDF_NAME, text)
    for name, (vertices, faces) in meshes.items():
        write_text(folder / name, obj_text(vertices, faces))
    return [folder / URDF_NAME, *(folder / name for name in sorted(meshes))]


def obj_text(vertices_m: Array, faces: Faces) -> str:
    """A triangle mesh as OBJ, rounded to micrometres, in an order that only depends on shape."""
    rounded = np.round(vertices_m, 6) + 0.0
    unique, index = np.unique(rounded, axis=0, return_inverse=True)
    triangles = index.reshape(-1)[faces]
    distinct = np.array([len(set(corners)) == 3 for corners in triangles.tolist()])
    triangles = triangles[distinct]
    shift = triangles.argmin(axis=1)[:, None]
    triangles = np.take_along_axis(triangles, (shift + np.arange(3)) % 3, axis=1)
    triangles = triangles[np.lexsort(triangles.T[::-1])] + 1
    lines = [f"v {x:.6f} {y:.6f} {z:.6f}" for x, y, z in unique]
    return "\n".join(lines + [f"f {a} {b} {c}" for a, b, c in triangles]) + "\n"


def _add_link(robot: Element, index: int, link: str) -> dict[str, tuple[Array, Faces]]:
    """Add a link's element; returns its meshes, vertices and faces, by file name."""
    element = _add(robot, "link", name=link)
    _add_inertial(element, index, link)
    meshes = {}
    for visual in link_visuals()[index]:
        name = f"visual/{visual.name}.obj"
        node = _add_mesh(element, "visual", name)
        Xml.SubElement(node, "material", name=visual.material)
        meshes[name] = (visual.vertices_m, visual.faces)
    kind = link if link.startswith("knuckle") else link.split("_")[0]
    for part in convex_parts()[index]:
        name = f"collision/{kind}_{part.name}.obj"
        _add_mesh(element, "collision", name)
        meshes[name] = (part.vertices_m, part.faces)
    contact = Xml.SubElement(element, "contact")
    Xml.SubElement(contact, "lateral_friction", value=_numbers([FRICTION]))
    return meshes


def _add_inertial(element: Element, index: int, link: str) -> None:
    """Mass properties of a link of uniform density; they satisfy the triangle inequality."""
    mesh = link_meshes()[index]
    mass = link_mass_kg(link)
    inertia = mesh.moment_inertia * (mass / mesh.volume)
    inertia[np.abs(inertia) < ROUNDING_KG_M2] = 0.0
    inertial = Xml.SubElement(element, "inertial")
    Xml.SubElement(inertial, "origin", xyz=_numbers(mesh.center_mass), rpy="0 0 0")
    Xml.SubElement(inertial, "mass", value=_numbers([mass]))
    keys = {"ixx": (0, 0), "ixy": (0, 1), "ixz": (0, 2), "iyy": (1, 1), "iyz": (1, 2)}
    values = {key: f"{inertia[at]:.4e}" for key, at in (keys | {"izz": (2, 2)}).items()}
    Xml.SubElement(inertial, "inertia", values)


def _add_joint(robot: Element, joint: kinematics.Joint, limits: Array) -> None:
    element = _add(robot, "joint", name=joint.name, type="revolute")
    pose = joint.T_parent_rest
    rpy = Rotation.from_matrix(pose[:3, :3]).as_euler("xyz")
    Xml.SubElement(element, "origin", xyz=_numbers(pose[:3, 3]), rpy=_numbers(rpy, 9))
    Xml.SubElement(element, "parent", link=joint.parent)
    Xml.SubElement(element, "child", link=joint.child)
    Xml.SubElement(element, "axis", xyz="0 0 1")
    ends = {"lower": _numbers(limits[:1]), "upper": _numbers(limits[1:])}
    drive = {"effort": joint_effort_nm(joint.name), "velocity": joint_speed_rad_s(joint.name)}
    Xml.SubElement(element, "limit", ends | {k: _numbers([v], 3) for k, v in drive.items()})
    if joint.name == "spread_2":
        Xml.SubElement(element, "mimic", joint="spread_1", multiplier="1")
    elif joint.name.startswith("distal"):
        ratio = _numbers([kinematics.DISTAL_RATIO])
        Xml.SubElement(element, "mimic", joint=joint.parent, multiplier=ratio)


def _add_mesh(element: Element, role: str, name: str) -> Element:
    node = Xml.SubElement(element, role)
    Xml.SubElement(Xml.SubElement(node, "geometry"), "mesh", filename=name)
    return node


def _add(parent: Element, tag: str, **attributes: str) -> Element:
    return Xml.SubElement(parent, tag, attributes)


def _numbers(values: ArrayLike, digits: int = 6) -> str:
    """Numbers in URDF notation, rounded to `digits` decimals."""
    return " ".join(f"{round(float(v), digits) + 0.0:.{digits}f}" for v in np.ravel(values))
