"""A hand that a test writes: two fingers, unlike each other and unlike those of any other hand.

The index finger turns about a post, which is its preshape, and bends at three joints, about axes
that are neither z nor parallel. The thumb slides. The palm's frame is none of a link's, bodies are
made of several fixed links, and shapes are boxes, cylinders, spheres and a scaled mesh.
"""

from copy import deepcopy
from pathlib import Path
from typing import Any

import trimesh
import yaml

from grasptypes.yaml_files import merge

URDF = """<?xml version="1.0"?>
<robot name="own">
  <material name="blue"><color rgba="0.1 0.2 0.8 1" /></material>
  <link name="wrist">
    <inertial><origin xyz="0 0 -0.04" /><mass value="0.4" />
      <inertia ixx="4e-4" ixy="0" ixz="0" iyy="4e-4" iyz="0" izz="2e-4" /></inertial>
    <visual><origin xyz="0 0 -0.04" />
      <geometry><cylinder radius="0.03" length="0.07" /></geometry>
      <material name="blue" /></visual>
    <collision><origin xyz="0 0 -0.04" />
      <geometry><cylinder radius="0.03" length="0.07" /></geometry></collision>
    <contact><lateral_friction value="0.7" /></contact>
  </link>
  <link name="plate">
    <inertial><origin xyz="0.01 0 0" rpy="0 0 0.5" /><mass value="0.1" />
      <inertia ixx="3e-5" ixy="0" ixz="0" iyy="5e-5" iyz="0" izz="7e-5" /></inertial>
    <visual><geometry><box size="0.08 0.06 0.01" /></geometry>
      <material name="red"><color rgba="0.9 0.1 0.1 1" /></material></visual>
    <collision><origin xyz="0.001 0 0" rpy="0 0 0.2" />
      <geometry><box size="0.08 0.06 0.01" /></geometry></collision>
  </link>
  <joint name="plate_fixed" type="fixed">
    <origin xyz="0 0.004 -0.002" rpy="0.1 0 0.3" /><parent link="wrist" /><child link="plate" />
  </joint>
  <link name="post">
    <inertial><mass value="0.05" />
      <inertia ixx="1e-5" ixy="0" ixz="0" iyy="1e-5" iyz="0" izz="1e-5" /></inertial>
    <visual><geometry><sphere radius="0.008" /></geometry></visual>
    <collision><geometry><sphere radius="0.008" /></geometry></collision>
  </link>
  <joint name="turn" type="revolute">
    <origin xyz="0.03 0.02 0" rpy="0 0.2 0" /><parent link="plate" /><child link="post" />
    <axis xyz="0 0 -2" /><limit lower="-0.5" upper="0.4" effort="1" velocity="2" />
  </joint>
  <link name="index_1">
    <inertial><origin xyz="0 0 0.02" rpy="0.2 0.1 0" /><mass value="0.03" />
      <inertia ixx="6e-6" ixy="1e-7" ixz="0" iyy="5e-6" iyz="2e-7" izz="2e-6" /></inertial>
    <visual><geometry><mesh filename="meshes/bar.stl" scale="0.001 0.001 0.001" /></geometry>
      <material name="blue" /></visual>
    <collision><origin xyz="0 0 0.02" />
      <geometry><box size="0.012 0.014 0.036" /></geometry></collision>
  </link>
  <joint name="index_1" type="revolute">
    <origin xyz="0.01 0 0.012" rpy="0 0 0.1" /><parent link="post" /><child link="index_1" />
    <axis xyz="0 -1 0" /><limit lower="0" upper="1.5" effort="2" velocity="3" />
  </joint>
  <link name="index_2">
    <inertial><origin xyz="0 0 0.015" /><mass value="0.02" />
      <inertia ixx="3e-6" ixy="0" ixz="0" iyy="3e-6" iyz="0" izz="1e-6" /></inertial>
    <visual><geometry><box size="0.01 0.01 0.01" /></geometry></visual>
    <collision><origin xyz="0 0 0.015" rpy="0 0 0.7" />
      <geometry><cylinder radius="0.006" length="0.026" /></geometry></collision>
  </link>
  <joint name="index_2" type="revolute">
    <origin xyz="0 0 0.04" rpy="0 0.1 0" /><parent link="index_1" /><child link="index_2" />
    <axis xyz="0.1 -0.9 0.2" /><limit lower="-0.1" upper="1.2" effort="1.5" velocity="3" />
  </joint>
  <link name="index_3">
    <inertial><origin xyz="0 0 0.01" /><mass value="0.01" />
      <inertia ixx="1e-6" ixy="0" ixz="0" iyy="1e-6" iyz="0" izz="5e-7" /></inertial>
    <visual><geometry><box size="0.01 0.01 0.02" /></geometry></visual>
    <collision><origin xyz="0 0 0.01" />
      <geometry><box size="0.01 0.01 0.02" /></geometry></collision>
  </link>
  <joint name="index_3" type="revolute">
    <origin xyz="0 0 0.03" rpy="0.2 0 0" /><parent link="index_2" /><child link="index_3" />
    <axis xyz="1 0 0" /><limit lower="0" upper="1" effort="1" velocity="3" />
  </joint>
  <link name="pad">
    <inertial><mass value="0.004" />
      <inertia ixx="1e-7" ixy="0" ixz="0" iyy="1e-7" iyz="0" izz="1e-7" /></inertial>
    <collision><geometry><sphere radius="0.006" /></geometry></collision>
  </link>
  <joint name="pad_fixed" type="fixed">
    <origin xyz="0.002 0 0.022" rpy="0 0 1" /><parent link="index_3" /><child link="pad" />
  </joint>
  <link name="rail" />
  <joint name="rail_fixed" type="fixed">
    <origin xyz="-0.03 -0.01 0.006" rpy="0 0 -0.4" /><parent link="wrist" /><child link="rail" />
  </joint>
  <link name="thumb">
    <inertial><origin xyz="0.003 0 0.03" /><mass value="0.06" />
      <inertia ixx="2e-5" ixy="0" ixz="0" iyy="2e-5" iyz="0" izz="5e-6" /></inertial>
    <visual><origin xyz="0 0 0.03" /><geometry><box size="0.02 0.02 0.06" /></geometry></visual>
    <collision><origin xyz="0 0 0.03" /><geometry><box size="0.02 0.02 0.06" /></geometry>
    </collision>
  </link>
  <joint name="slide" type="prismatic">
    <origin xyz="0.01 0 0" rpy="0 0.1 0" /><parent link="rail" /><child link="thumb" />
    <axis xyz="1 0 0" /><limit lower="0" upper="0.04" effort="20" velocity="0.1" />
  </joint>
</robot>
"""


def _finger(joints: list, opens: list, bends: list, thickness_m: float, **more: Any) -> dict:
    shape = {"open": opens, "bend_rad": bends, "half_thickness_m": thickness_m}
    return {"joints": joints, "rates": [[1.0]], **shape, **more}


DESCRIPTION: dict[str, Any] = {
    "name": "Own hand",
    "palm": {"link": "wrist", "xyz_m": [0.002, -0.003, 0.01], "rpy_rad": [0.1, -0.2, 1.4]},
    "preshape": {"turn": {"turn": 1.0}},
    "fingers": {
        "index": _finger(
            ["index_1", "index_2", "index_3"], [0.1, 0.0, 0.05], [1.5, 0.1, 0.2], 0.006,
            tip_m=[0.002, 0.0, 0.028], rates=[[1.0, 0.8, 0.5], [0.0, 1.0, 0.6], [0.0, 0.0, 1.0]],
        ),
        "thumb": _finger(["slide"], [0.0], [1.57], 0.01, tip_m=[0.01, 0.0, 0.06], thumb=True),
    },
    "drive": "coupled",
    "motors": {"fingertip_force_n": 3.0, "passive_force_n": 9.0, "closing_speed_rad_s": 0.5},
    "solver_iterations": 60,
    "ignored_collisions": [["wrist", "index_1"]],
    "exchange": {"gripper": "Own", "frame": "palm, metres"},
}  # fmt: skip

_GRIP = {
    "preshapes": [[0.0], [0.2]],
    "palm_distances_m": [0.0, 0.02],
    "shape": {"palm_gap_m": [-1, 1], "enclosed_diameter_m": [0, 1], "sideways_share": [0, 1]},
}
GRIPS: dict[str, Any] = {
    "start_m": 0.2,
    "wrap": _GRIP,
    "pinch": _GRIP,
    "instead": {"enclose": "wrap", "tripod": "pinch", "rim": "pinch"},
}


def write_hand(
    folder: Path,
    description: dict[str, Any] | None = None,
    grips: dict[str, Any] | None = None,
    urdf: str = URDF,
) -> Path:
    """The hand, with changes laid over its descriptions."""
    (folder / "meshes").mkdir(parents=True)
    trimesh.creation.box((12.0, 14.0, 36.0)).export(folder / "meshes/bar.stl")
    (folder / "hand.urdf").write_text(urdf)
    for name, content, changes in (
        ("hand.yaml", DESCRIPTION, description),
        ("grips.yaml", GRIPS, grips),
    ):
        changed = merge(deepcopy(content), changes or {})
        (folder / name).write_text(yaml.safe_dump(changed, sort_keys=False))
    return folder
