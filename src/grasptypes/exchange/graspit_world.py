"""GraspIt! world files: one object and one of the robots that GraspIt! knows, in XML.

The format (GraspIt!'s manual, "Worlds", and the examples in its folder worlds): lengths are
millimetres; a pose is `(w x y z)[x y z]` in the world. The `dofValues` of a hand with breakaway
fingers are its preshapes, then for each finger its angle, 1 if its clutch has released, and the
angle at which it released. From there on, the finger's angle drives only the fingertip.
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
from grasptypes.hands.hand import Hand
from grasptypes.hands.links import Finger

Array = NDArray[np.float64]

MM = 1e3
# Below this difference a fingertip counts as coupled to its finger: angles in files have six
# digits.
COUPLED_RAD = 1e-4


def write_world(path: str | Path, hands: PosedHands, index: int, object_file: str) -> None:
    """Write one grasp, with the object at the origin of the world.

    Args:
        object_file: file of the body in GraspIt!'s model folder, e.g. `models/objects/mug.xml`.

    Raises:
        ValueError: GraspIt! has no model of the hand.
    """
    model = hands.hand.exchange.graspit_robot
    if model is None:
        raise ValueError(f"GraspIt! has no model of {hands.hand.title}")
    world = ElementTree.Element("world")
    body = ElementTree.SubElement(world, "graspableBody")
    ElementTree.SubElement(body, "filename").text = object_file
    _add_pose(body, RigidTransform.identity())
    robot = ElementTree.SubElement(world, "robot")
    ElementTree.SubElement(robot, "filename").text = model
    values = dof_values(hands.hand, hands.joint_positions[index])
    ElementTree.SubElement(robot, "dofValues").text = " ".join(f"{value:+.9g}" for value in values)
    _add_pose(robot, hands.T_object_hand[index])
    ElementTree.indent(world, "    ")
    write_bytes(path, ElementTree.tostring(world, encoding="UTF-8", xml_declaration=True) + b"\n")


def read_world(path: str | Path, hand: Hand) -> PosedHands:
    """Read a world with one graspable body and one hand; other elements are ignored.

    Raises:
        InputError: the file is not such a world.
    """
    with parsing(path, "is not a GraspIt! world"):
        world = ElementTree.parse(path).getroot()
    body = world.find("graspableBody")
    kind = Path(hand.exchange.graspit_robot or "").stem
    robots = [
        robot
        for robot in world.findall("robot")
        if kind and kind.lower() in _text(robot, "filename").lower()
    ]
    if body is None or len(robots) != 1:
        raise InputError(path, "", f"needs one graspableBody and one {kind or hand.title} robot")
    positions = _joint_positions(path, hand, _text(robots[0], "dofValues"))
    name, poses = Path(_text(body, "filename")).stem, (_pose(path, body), _pose(path, robots[0]))
    return relative(name, hand, poses, positions, held=True)


def dof_values(hand: Hand, joint_positions: Array) -> list[float]:
    """GraspIt!'s numbers of a hand with joint positions (J,).

    Its tips cannot lag behind their fingers; tips that physics pressed back count as coupled.
    """
    values = [float(value) for value in hand.preshape_of(joint_positions)]
    for finger in hand.fingers:
        ratio, (first, last) = _coupling(finger), (finger.joints[0], finger.joints[-1])
        base, tip = joint_positions[first], joint_positions[last]
        apart = tip - ratio * base > COUPLED_RAD
        driven = tip / ratio if apart else base
        values += [float(driven), float(apart), float(base if apart else 0.0)]
    return values


def _coupling(finger: Finger) -> float:
    """How much a finger's tip turns with its base."""
    return float(finger.rates[0, -1] / finger.rates[0, 0])


def _joint_positions(path: str | Path, hand: Hand, text: str) -> Array:
    try:
        numbers = [float(word) for word in text.split()]
    except ValueError as error:
        raise InputError(path, "robot/dofValues", str(error)) from error
    count, fingers = len(hand.preshape), len(hand.fingers)
    if len(numbers) != count + 3 * fingers:
        message = f"has {len(numbers)} numbers instead of {count + 3 * fingers}"
        raise InputError(path, "robot/dofValues", message)
    positions = hand.preshaped(numbers[:count])
    of_fingers = np.array(numbers[count:]).reshape(fingers, 3)
    for finger, (driven, released, stopped) in zip(hand.fingers, of_fingers, strict=True):
        positions[finger.joints[0]] = stopped if released > 0.5 else driven
        positions[finger.joints[-1]] = _coupling(finger) * driven
    return positions


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
