"""Touched roles of published poses, on a hand put where its contact is known."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest
import trimesh
from tests.unit.barrett import BARRETT
from tests.unit.settings import PARAMS

from grasptypes.contact_maps.touched_roles import TOUCH_SCHEMA, touched_roles
from grasptypes.objects.object_files import Surface


@pytest.fixture
def block():
    """A block 80 mm wide and 200 mm high, off its frame's origin; its upper half is a lid."""
    mesh = trimesh.creation.box((0.08, 0.08, 0.2))
    fine = trimesh.Trimesh(*trimesh.remesh.subdivide_to_size(mesh.vertices, mesh.faces, 0.01))
    part = (fine.vertices[:, 2] > 0).astype(np.int16)
    names = np.array(["lower", "upper"])
    surface = Surface(fine.vertices + [0.3, 0.0, 0.1], fine.faces, part, names)
    roles = {"lower": {"role": "base"}, "upper": {"role": "lid"}}
    return SimpleNamespace(surface=surface, properties=SimpleNamespace(roles=roles))


def grasp(palm_z_m, grasp_type="Power Sphere"):
    """A flat open hand above the middle of the block's top, its palm down."""
    T = np.array([[1.0, 0, 0, 0], [0, -1, 0, 0], [0, 0, -1, palm_z_m]])
    numbers = np.array([0.0, *T.ravel(), 0.0, 0.0, 0.0, 0.0])
    return {
        "object": "block",
        "task": "use",
        "grasp_type": grasp_type,
        "hand_configuration": numbers,
    }


def touched(block, tmp_path, *grasps):
    table = pd.DataFrame(list(grasps))
    scan = tmp_path / "none.stl"
    return touched_roles(table, BARRETT, block, scan, 1.0, PARAMS.hold_fit.touch)


def test_a_palm_on_the_top_touches_the_lid(block, tmp_path):
    rows = TOUCH_SCHEMA.validate(touched(block, tmp_path, grasp(0.203)))
    assert rows.values.tolist() == [["block", "use", "enclose", "lid", 1]]


def test_a_palm_on_a_lid_that_is_the_base_touches_the_base(block, tmp_path):
    swapped = replace(block.surface, part_index=1 - block.surface.part_index)
    turned = SimpleNamespace(surface=swapped, properties=block.properties)
    assert touched(turned, tmp_path, grasp(0.203)).role.tolist() == ["base"]


def test_grasps_are_counted_by_grip(block, tmp_path):
    grasps = grasp(0.203), grasp(0.21), grasp(0.25), grasp(0.25, "Precision")
    rows = touched(block, tmp_path, *grasps).set_index("grip")
    assert rows.n.to_dict() == {"enclose": 3, "pinch": 1}
