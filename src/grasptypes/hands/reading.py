"""Reading a hand's folder: hand.urdf, hand.yaml, grips.yaml and the meshes that the URDF names."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import cache
from itertools import pairwise
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np
import trimesh
from numpy.typing import NDArray

from grasptypes.errors import InputError, parsing
from grasptypes.hands.description import FingerDescription, Grips, HandDescription
from grasptypes.hands.folders import DESCRIPTION, GRIPS, URDF, hand_folder
from grasptypes.hands.hand import Hand
from grasptypes.hands.link_reading import LinkReader, link_frictions
from grasptypes.hands.links import Finger, Joint
from grasptypes.settings.base import MisplacedError
from grasptypes.yaml_files import read_yaml

Array = NDArray[np.float64]


def load_hand(name: str | Path, base: str | Path = ".") -> Hand:
    """Read a hand by the name of one that comes with the package, or a folder below `base`.

    Raises:
        InputError: the hand is unknown, or a file of it is wrong; names the file and the key.
    """
    folder = hand_folder(name, base)
    return _load(folder, folder.resolve())


@cache
def _load(folder: Path, absolute: Path) -> Hand:
    """The hand in a folder, which messages name as the user does."""
    described = HandDescription.check(read_yaml(folder / DESCRIPTION), folder / DESCRIPTION)
    grips = Grips.check(read_yaml(folder / GRIPS), folder / GRIPS)
    try:
        grips.check_preshapes(len(described.preshape))
    except MisplacedError as error:
        raise InputError(folder / GRIPS, error.key, str(error)) from error
    return replace(_Reader(folder, described, grips).hand(), folder=str(absolute))


class _Reader:
    """Reads the URDF of a folder and matches it with the description."""

    def __init__(self, folder: Path, described: HandDescription, grips: Grips) -> None:
        import yourdfpy  # here, since it takes time

        self._folder, self._described, self._grips = folder, described, grips
        self._path = folder / URDF
        if not self._path.is_file():
            raise InputError(self._path, "", "no such file")
        with parsing(self._path, "cannot be read as a URDF"):
            # yourdfpy repairs broken XML without a word, and does not read `contact`.
            frictions = link_frictions(ElementTree.parse(self._path).getroot())
            self._robot = yourdfpy.URDF.load(
                str(self._path), build_scene_graph=False, load_meshes=False
            ).robot
        self._joints = {joint.name: joint for joint in self._robot.joints}
        self._above = {joint.child: joint for joint in self._robot.joints}
        self._urdf_links = {link.name: link for link in self._robot.links}
        self._link_reader = LinkReader(self._path, self._robot, frictions)
        self._palm = described.palm.link
        self._known(self._palm, self._urdf_links, "palm.link", "link")
        self._check_tree()

    def hand(self) -> Hand:
        """The hand; raises InputError."""
        moving = self._moving_joints()
        carried = {self._palm: 0} | {
            self._joints[name].child: index + 1 for index, name in enumerate(moving)
        }
        joints, turned = [], {0: self._T_link_hand()}
        for index, name in enumerate(moving):
            parent, T_parent_rest = self._rest(name, carried)
            T_rest, T_axis = self._along_axis(name, T_parent_rest)
            joints.append(
                self._joint(
                    name,
                    parent,
                    np.linalg.inv(turned[parent]) @ T_rest if parent in turned else T_rest,
                )
            )
            if T_axis is not None:
                turned[index + 1] = T_axis
        self._check_chains(joints, moving)
        merged = self._rigidly_attached(carried)
        links = [
            self._link_reader.read(name, merged[index], turned.get(index))
            for name, index in carried.items()
        ]
        numbers = {name: index for index, name in enumerate(moving)}
        described = self._described
        return Hand(
            folder=str(self._folder),
            title=described.name,
            links=tuple(links),
            joints=tuple(joints),
            preshape={
                dof: {numbers[joint]: factor for joint, factor in driven.items()}
                for dof, driven in described.preshape.items()
            },
            fingers=tuple(
                self._finger(name, finger, numbers, turned)
                for name, finger in described.fingers.items()
            ),
            direct=described.drive == "direct",
            self_centring=described.self_centring,
            ends_at_hand=described.ends_at_hand,
            motors=described.motors,
            solver_iterations=described.solver_iterations,
            ignored_pairs=frozenset(self._ignored(carried)),
            grips=self._grips,
            exchange=described.exchange,
        )

    def _known(self, name: str, among: Any, key: str, kind: str) -> None:
        if name not in among:
            message = f"'{name}' is not a {kind} of {URDF}, which has {', '.join(among)}"
            raise InputError(self._folder / DESCRIPTION, key, message)

    def _check_tree(self) -> None:
        """All links must hang on the palm; raises InputError."""
        if self._palm in self._above:
            message = f"'{self._palm}' is carried by another link: name the root of {URDF}"
            raise InputError(self._folder / DESCRIPTION, "palm.link", message)
        for name in self._urdf_links:
            seen, at = {name}, name
            while at in self._above:
                at = self._above[at].parent
                if at in seen:
                    raise InputError(self._path, f"link {name}", "is part of a loop of joints")
                seen.add(at)
            if at != self._palm:
                message = f"is not connected to the palm '{self._palm}'"
                raise InputError(self._path, f"link {name}", message)

    def _moving_joints(self) -> list[str]:
        """Names of all joints that move, in the hand's order."""
        described = self._described
        named: dict[str, str] = {}
        for dof, driven in described.preshape.items():
            for name in driven:
                if name in named:
                    message = f"'{name}' already belongs to {named[name]}"
                    raise InputError(self._folder / DESCRIPTION, f"preshape.{dof}", message)
                named[name] = f"preshape.{dof}"
        first = list(named)
        chains = [list(finger.joints) for finger in described.fingers.values()]
        for (finger, _), chain in zip(described.fingers.items(), chains, strict=True):
            for name in chain:
                if name in named:
                    message = f"'{name}' already belongs to {named[name]}"
                    raise InputError(
                        self._folder / DESCRIPTION, f"fingers.{finger}.joints", message
                    )
                named[name] = f"fingers.{finger}.joints"
        for name, key in named.items():
            self._known(name, self._joints, key, "joint")
        free = [
            joint.name
            for joint in self._robot.joints
            if joint.type != "fixed" and joint.name not in named
        ]
        if free:
            names = ", ".join(free)
            message = (
                f"does not mention {names}: add it to preshape or fingers, or fix it in {URDF}"
            )
            raise InputError(self._folder / DESCRIPTION, "", message)
        longest = max(map(len, chains))
        rows = [chain[place] for place in range(longest) for chain in chains if place < len(chain)]
        return [*first, *rows]

    def _check_chains(self, joints: Sequence[Joint], moving: Sequence[str]) -> None:
        """Each closing joint must sit on the closing link before it; raises InputError."""
        for name, finger in self._described.fingers.items():
            for before, joint in pairwise(finger.joints):
                if joints[moving.index(joint)].parent != moving.index(before) + 1:
                    message = f"'{joint}' is not on the link of '{before}', which comes before it"
                    key = f"fingers.{name}.joints"
                    raise InputError(self._folder / DESCRIPTION, key, message)

    def _rest(self, name: str, carried: dict[str, int]) -> tuple[int, Array]:
        """The link that carries a joint, and the pose of the joint's child in it at zero."""
        joint = self._joints[name]
        chain = [joint]
        while chain[0].parent not in carried:
            if chain[0].parent not in self._above:
                message = f"joint '{name}' is not connected to the palm '{self._palm}'"
                raise InputError(self._path, "", message)
            chain.insert(0, self._above[chain[0].parent])
            if chain[0].type != "fixed":
                message = f"'{chain[0].name}' comes after '{name}' although it is nearer the palm"
                raise InputError(self._folder / DESCRIPTION, "", message)
        T = _origin(chain[0])
        for following in chain[1:]:
            T = T @ _origin(following)
        return carried[chain[0].parent], T

    def _along_axis(self, name: str, T_rest: Array) -> tuple[Array, Array | None]:
        """The pose with z along the joint's axis, and its pose in the URDF's link (None: equal)."""
        axis = np.asarray(self._joints[name].axis, dtype=np.float64)
        length = np.linalg.norm(axis)
        if not length > 0:
            raise InputError(self._path, f"joint {name}", "its axis has no length")
        axis = axis / length
        if np.allclose(axis, [0, 0, 1], atol=1e-12):
            return T_rest, None
        T = np.eye(4)
        T[:3, :3] = trimesh.geometry.align_vectors([0, 0, 1], axis)[:3, :3]
        return T_rest @ T, T

    def _joint(self, name: str, parent: int, T_parent_rest: Array) -> Joint:
        joint, values = self._joints[name], {}
        if joint.type not in ("revolute", "prismatic"):
            message = f"is {joint.type}; a joint that moves must be revolute or prismatic"
            raise InputError(self._path, f"joint {name}", message)
        for key in ("lower", "upper", "effort", "velocity"):
            value = getattr(joint.limit, key, None)
            if value is None or not np.isfinite(value):
                raise InputError(self._path, f"joint {name}", f"its limit has no {key}")
            values[key] = float(value)
        if values["lower"] >= values["upper"]:
            raise InputError(self._path, f"joint {name}", "its lower limit is not below the upper")
        limits = values["lower"], values["upper"]
        prismatic = joint.type == "prismatic"
        return Joint(
            name, parent, prismatic, T_parent_rest, limits, values["effort"], values["velocity"]
        )

    def _T_link_hand(self) -> Array:
        import trimesh.transformations as tra

        palm = self._described.palm
        T = np.asarray(tra.euler_matrix(*palm.rpy_rad, "sxyz"), dtype=np.float64)
        T[:3, 3] = palm.xyz_m
        return T

    def _rigidly_attached(self, carried: dict[str, int]) -> list[list[tuple[str, Array]]]:
        """For each link, the URDF links fixed to it and their poses in it."""
        merged: list[list[tuple[str, Array]]] = [[(name, np.eye(4))] for name in carried]
        for name in self._urdf_links:
            if name in carried:
                continue
            T, at = np.eye(4), name
            while at not in carried and at in self._above:
                joint = self._above[at]
                T, at = _origin(joint) @ T, joint.parent
            if at in carried:
                merged[carried[at]].append((name, T))
        return merged

    def _finger(
        self, name: str, described: FingerDescription, numbers: dict[str, int],
        turned: dict[int, Array],
    ) -> Finger:  # fmt: skip
        joints = tuple(numbers[joint] for joint in described.joints)
        tip = np.array(described.tip_m, dtype=np.float64)
        T = turned.get(joints[-1] + 1)
        if T is not None:
            tip = (tip - T[:3, 3]) @ T[:3, :3]
        return Finger(
            name, joints, np.array(described.open), np.array(described.rates),
            np.array(described.bend_rad), described.half_thickness_m, tip, described.thumb,
        )  # fmt: skip

    def _ignored(self, carried: dict[str, int]) -> Iterator[tuple[int, int]]:
        for index, pair in enumerate(self._described.ignored_collisions):
            for name in pair:
                self._known(name, carried, f"ignored_collisions.{index}", "moving link")
            first, second = sorted(carried[name] for name in pair)
            yield first, second


def _origin(joint: Any) -> Array:
    return np.eye(4) if joint.origin is None else np.asarray(joint.origin, dtype=np.float64)
