"""Statistics of kinds count every grasp once, by kind and by the role that was held."""

from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pandas as pd
from scipy.spatial import cKDTree

from grasptypes.labels.grasp_type import GRASP_TYPES
from grasptypes.objects.object_files import Surface
from grasptypes.objects.object_geometry import ObjectGeometry
from grasptypes.reports.kind_statistics import (
    KIND_TABLE,
    NO_ROLE,
    ROLE_TABLE,
    held_role,
    kind_tables,
    size_class,
)


def two_parts(**properties):
    """A stick of two points: a handle at x = 0 and a head at x = 1."""
    surface = Surface(
        vertices=np.array([(0.0, 0, 0), (1.0, 0, 0)]),
        faces=np.zeros((0, 3), np.int32),
        part_index=np.array([0, 1], np.int16),
        part_names=np.array(["grip", "top"]),
    )
    roles = {"grip": {"role": "handle"}, "top": {"role": "head"}}
    geometry = ObjectGeometry(Path(), SimpleNamespace(roles=roles, **properties))
    geometry.__dict__["surface"] = surface
    return geometry, cKDTree(surface.vertices)


def test_the_role_with_most_force_is_held():
    geometry, tree = two_parts()
    contacts = [0.1, 0, 0, 0.9, 0, 0, 0.95, 0, 0]
    row = SimpleNamespace(contact_points_m=contacts, contact_forces_n=[5.0, 1.0, 1.0])
    assert held_role(row, tree, geometry) == "handle"
    row.contact_forces_n = [1.0, 1.0, 1.0]
    assert held_role(row, tree, geometry) == "head"
    row = SimpleNamespace(contact_points_m=[], contact_forces_n=[])
    assert held_role(row, tree, geometry) == NO_ROLE


def test_the_size_class_is_that_of_the_middle_side():
    geometry, _ = two_parts(bounds_m=[[0, 0, 0], [0.5, 0.04, 0.01]])
    assert size_class(geometry) == "3-5 cm"
    geometry, _ = two_parts(bounds_m=[[0, 0, 0], [0.5, 0.4, 0.01]])
    assert size_class(geometry) == "over 12 cm"


def test_every_grasp_counts_once():
    names = ["mug_s01", "mug_s01", "mug_s02", "mug_s02"]
    dataset = pd.DataFrame(
        {
            "Object": names,
            "Intent": "use",
            "Session": [1, 2, 1, 2],
            "reason": ["valid", "dropped", "valid", "valid"],
            "shape": [GRASP_TYPES[0], GRASP_TYPES[1], GRASP_TYPES[1], GRASP_TYPES[1]],
        }
    )
    roles = pd.DataFrame(
        {
            "object": names,
            "task": "use",
            "session": [1, 2, 1, 2],
            "role": ["handle", "handle", "rim", "handle"],
            "size": "8-12 cm",
        }
    )
    kinds, by_role = kind_tables(dataset, roles, {"mug": "kitchen"})
    KIND_TABLE.validate(kinds)
    ROLE_TABLE.validate(by_role)
    (mug,) = kinds.itertuples()
    assert (mug.shapes, mug.grasps, mug.valid, mug.valid_share, mug.dropped) == (2, 4, 3, 0.75, 1)
    assert (mug.large_wrap, mug.medium_wrap) == (1, 2)
    assert dict(zip(by_role.role, by_role.grasps, strict=True)) == {"handle": 3, "rim": 1}
