"""GraspIt! world files: one object and one Barrett hand, in XML.

The format (GraspIt!'s manual, "Worlds", and its worlds/barrettGlassDyn.xml): lengths are
millimetres; a pose is `(w x y z)[x y z]` in the world; the ten `dofValues` of its Barrett model are
the spread, then for each finger its angle, 1 if its clutch has released, and the angle at which it
released. From there on, the finger's angle drives only the fingertip.
"""

from __future__ import annotations

import re
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import RigidTransform

from grasptypes.errors import InputError, parsing
from grasptypes.exchange.records import (
    PosedHands,
    from_position_quaternion,
    relative,
    to_position_quaternion,
)
from grasptypes.files import write_bytes
from grasptypes.hand.kinematics import DISTAL_RATIO

Array = NDArray[np.float64]

ROBOT = "models/robots/Barrett/Barrett.xml"
MM = 1e3
# Below this difference a fingertip counts as coupled to its finger: angles in files have six
# digits.
COUPLED_RAD = 1e-4


def write_world(path: str | Path, hands: PosedHands, index: int, object_file: str) -> None:
    """Write one grasp, with the object at the origin of the world.

    Args:
        object_file: file of the body in GraspIt!'s model folder, e.g. `models/objects/mug.xml`.
    """
    world = ElementTree.Element("world")
    body = ElementTree.SubElement(world, "graspableBody")
    ElementTree.SubElement(body, "filename").text = object_file
    _add_pose(body, RigidTransform.identity())
    robot = ElementTree.SubElement(world, "robot")
    ElementTree.SubElement(robot, "filename").text = ROBOT
    values = dof_values(hands.joint_angles_rad[index])
    ElementTree.SubElement(robot, "dofValues").text = " ".join(f"{value:+.9g}" for value in values)
    _add_pose(robot, hands.T_object_hand[index])
    ElementTree.indent(world, "    ")
    write_bytes(path, ElementTree.tostring(world, encoding="UTF-8", xml_declaration=True) + b"\n")


def read_world(path: str | Path) -> PosedHands:
    """Read a world with one graspable body and one Barrett hand; other elements are ignored.

    Raises:
        InputError: the file is not such a world.
    """
    with parsing(path, "is not a GraspIt! world"):
        world = ElementTree.parse(path).getroot()
    body = world.find("graspableBody")
    robots = [
        robot for robot in world.findall("robot") if "barrett" in _text(robot, "filename").lower()
    ]
    if body is None or len(robots) != 1:
        raise InputError(path, "", "needs one graspableBody and one Barrett robot")
    angles = _joint_angles(path, _text(robots[0], "dofValues"))
    name, poses = Path(_text(body, "filename")).stem, (_pose(path, body), _pose(path, robots[0]))
    return relative(name, poses, angles, held=True)


def dof_values(joint_angles_rad: Array) -> list[float]:
    """The ten numbers of GraspIt!'s Barrett for joint angles (8,), radians.

    Its tips cannot lag behind their fingers; tips that physics pressed back count as coupled.
    """
    values = [float(joint_angles_rad[0])]
    for finger in range(3):
        proximal, distal = joint_angles_rad[2 + finger], joint_angles_rad[5 + finger]
        apart = distal - DISTAL_RATIO * proximal > COUPLED_RAD
        driven = distal / DISTAL_RATIO if apart else proximal
        values += [float(driven), float(apart), float(proximal if apart else 0.0)]
    return values


def _joint_angles(path: str | Path, text: str) -> Array:
    try:
        numbers = [float(word) for word in text.split()]
    except ValueError as error:
        raise InputError(path, "robot/dofValues", str(error)) from error
    if len(numbers) != 10:
        raise InputError(path, "robot/dofValues", f"has {len(numbers)} numbers instead of 10")
    fingers = np.array(numbers[1:]).reshape(3, 3)
    proximal = np.where(fingers[:, 1] > 0.5, fingers[:, 2], fingers[:, 0])
    return np.array([numbers[0], numbers[0], *proximal, *(DISTAL_RATIO * fingers[:, 0])])


def _add_pose(parent: ElementTree.Element, T: RigidTransform) -> None:
    numbers = to_position_quaternion(T)
    turn = " ".join(f"{value:+.9g}" for value in numbers[3:])
    place = " ".join(f"{value:+.9g}" for value in numbers[:3] * MM)
    pose = ElementTree.SubElement(ElementTree.SubElement(parent, "transform"), "fullTransform")
    pose.text = f"({turn})[{place}]"


def _pose(path: str | Path, parent: ElementTree.Element) -> RigidTransform:
    text = _text(parent, "transform/fullTransform")
    match = re.fullmatch(r"\s*\(([^)]*)\)\s*\[([^]]*)\]\s*", text)
    groups = match.groups() if match else ("", "")
    try:
        turn, place = ([float(word) for word in group.split()] for group in groups)
        return from_position_quaternion([*(np.array(place) / MM), *turn])
    except ValueError as error:
        message = f"{text!r} is not a pose (w x y z)[x y z]"
        raise InputError(path, f"{parent.tag}/transform/fullTransform", message) from error


def _text(parent: ElementTree.Element, name: str) -> str:
    return parent.findtext(name) or ""
