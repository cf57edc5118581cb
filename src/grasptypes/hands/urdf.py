"""A hand as physics engines load it: a URDF in the hand's own frames, with convex OBJ meshes.

Whatever frames, axes, primitives and fixed joints the hand's own URDF has, this one has its root
at the hand's frame, all joint axes along z, and one mesh file for every convex part.
"""

from pathlib import Path
from xml.etree import ElementTree as Xml

import numpy as np
from numpy.typing import ArrayLike, NDArray
from trimesh.transformations import euler_from_matrix

from grasptypes.files import write_text
from grasptypes.hands.hand import Hand
from grasptypes.hands.links import Joint, Link

Array = NDArray[np.float64]
Faces = NDArray[np.int64]

# Products of inertia below this are rounding errors of a symmetric shape.
ROUNDING_KG_M2 = 1e-12

Element = Xml.Element


def write_urdf(hand: Hand, folder: str | Path) -> Path:
    """Write the URDF `hand.urdf` and the meshes that it names below `folder`.

    Returns:
        Path of the URDF.
    """
    folder = Path(folder)
    robot = Xml.Element("robot", name=Path(hand.folder).name)
    colours = {v.material: v.rgba for link in hand.links for v in link.visuals}
    for name, rgba in colours.items():
        Xml.SubElement(_add(robot, "material", name=name), "color", rgba=_numbers(rgba))
    meshes = {}
    for link in hand.links:
        meshes.update(_add_link(robot, link))
    for index, joint in enumerate(hand.joints):
        _add_joint(robot, hand, index, joint)
    Xml.indent(robot)
    path = folder / "hand.urdf"
    text = '<?xml version="1.0"?>\n' + Xml.tostring(robot, encoding="unicode") + "\n"
    write_text(path, text)
    for name, (vertices, faces) in meshes.items():
        write_text(folder / name, obj_text(vertices, faces))
    return path


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


def _add_link(robot: Element, link: Link) -> dict[str, tuple[Array, Faces]]:
    """Add a link's element; returns its meshes, vertices and faces, by file name."""
    element = _add(robot, "link", name=link.name)
    _add_inertial(element, link)
    meshes = {}
    for visual in link.visuals:
        name = f"visual/{visual.name}.obj"
        node = _add_mesh(element, "visual", name)
        Xml.SubElement(node, "material", name=visual.material)
        meshes[name] = (visual.vertices_m, visual.faces)
    for part in link.parts:
        name = f"collision/{part.name}.obj"
        _add_mesh(element, "collision", name)
        meshes[name] = (part.vertices_m, part.faces)
    contact = Xml.SubElement(element, "contact")
    Xml.SubElement(contact, "lateral_friction", value=_numbers([link.friction]))
    return meshes


def _add_inertial(element: Element, link: Link) -> None:
    inertia = np.where(np.abs(link.inertia_kg_m2) < ROUNDING_KG_M2, 0.0, link.inertia_kg_m2)
    inertial = Xml.SubElement(element, "inertial")
    Xml.SubElement(inertial, "origin", xyz=_numbers(link.centre_of_mass_m), rpy="0 0 0")
    Xml.SubElement(inertial, "mass", value=_numbers([link.mass_kg]))
    keys = {"ixx": (0, 0), "ixy": (0, 1), "ixz": (0, 2), "iyy": (1, 1), "iyz": (1, 2)}
    values = {key: f"{inertia[at]:.4e}" for key, at in (keys | {"izz": (2, 2)}).items()}
    Xml.SubElement(inertial, "inertia", values)


def _add_joint(robot: Element, hand: Hand, index: int, joint: Joint) -> None:
    kind = "prismatic" if joint.prismatic else "revolute"
    element = _add(robot, "joint", name=joint.name, type=kind)
    pose = joint.T_parent_rest
    rpy = euler_from_matrix(pose, "sxyz")
    Xml.SubElement(element, "origin", xyz=_numbers(pose[:3, 3]), rpy=_numbers(rpy, 9))
    Xml.SubElement(element, "parent", link=hand.links[joint.parent].name)
    Xml.SubElement(element, "child", link=hand.links[index + 1].name)
    Xml.SubElement(element, "axis", xyz="0 0 1")
    ends = dict(zip(("lower", "upper"), map(_numbers, joint.limits), strict=True))
    drive = {"effort": joint.effort, "velocity": joint.speed}
    Xml.SubElement(element, "limit", ends | {k: _numbers([v], 3) for k, v in drive.items()})
    leader = _leader(hand, index)
    if leader:
        name, multiplier, offset = leader
        values = {"joint": name, "multiplier": multiplier}
        Xml.SubElement(
            element, "mimic", values | ({"offset": _numbers([offset])} if offset else {})
        )


def _leader(hand: Hand, index: int) -> tuple[str, str, float] | None:
    """The joint that a joint follows while nothing stops it, if any: name, ratio and offset."""
    for joints in hand.preshape.values():
        first = next(joint for joint, factor in joints.items() if factor)
        if index in joints and index != first:
            return hand.joint_names[first], f"{joints[index] / joints[first]:g}", 0.0
    for finger in hand.fingers:
        if not hand.direct and index in finger.joints[1:]:
            place = finger.joints.index(index)
            ratio = finger.rates[0, place] / finger.rates[0, 0]
            offset = float(finger.open[place] - ratio * finger.open[0])
            return hand.joint_names[finger.joints[0]], _numbers([ratio]), offset
    return None


def _add_mesh(element: Element, role: str, name: str) -> Element:
    node = Xml.SubElement(element, role)
    Xml.SubElement(Xml.SubElement(node, "geometry"), "mesh", filename=name)
    return node


def _add(parent: Element, tag: str, **attributes: str) -> Element:
    return Xml.SubElement(parent, tag, attributes)


def _numbers(values: ArrayLike, digits: int = 6) -> str:
    """Numbers in URDF notation, rounded to `digits` decimals."""
    return " ".join(f"{round(float(v), digits) + 0.0:.{digits}f}" for v in np.ravel(values))
