"""Tests of recognition: what a camera sees, true roles nearby, and the forest."""

import numpy as np
import pytest
import trimesh
from tests.unit.settings import PARAMS

from grasptypes.errors import InputError
from grasptypes.objects.object_files import Surface
from grasptypes.segmentation.evaluation import (
    FOREST_METHOD,
    KIND_SCHEMA,
    ROLE_SCHEMA,
    held_out_roles,
    kind_table,
    role_table,
)
from grasptypes.segmentation.forest import grow_forest
from grasptypes.segmentation.partial_views import SIDES, partial_views
from grasptypes.segmentation.samples import sample_shapes
from grasptypes.segmentation.true_roles import TrueRoles, read_slices
from grasptypes.settings.roles import PartRole

SETTINGS = PARAMS.segmentation
HANDLE, WALL = (PartRole.check({"role": role}) for role in ("handle", "container_wall"))


def test_a_camera_sees_neither_the_far_side_nor_what_is_hidden():
    small, large = trimesh.creation.icosphere(radius=0.01), trimesh.creation.icosphere(radius=0.03)
    small.apply_translation(-0.1 * SIDES[0])
    both = trimesh.util.concatenate([small, large])
    first, *others = partial_views(both, 400, "balls")
    on_small = [
        np.linalg.norm(points + 0.1 * SIDES[0], axis=1) < 0.011 for points, _ in (first, others[0])
    ]
    assert not on_small[0].any()
    assert on_small[1].any()
    assert (first[1] @ SIDES[0] > 0).all()


def test_the_other_side_of_a_wall_has_its_own_role():
    sheet = trimesh.creation.box((0.1, 0.1, 0.001)).subdivide_to_size(0.01)
    surface = Surface(
        sheet.vertices, sheet.faces, np.zeros(len(sheet.vertices), dtype=np.int16), np.array(["a"])
    )
    true = TrueRoles.of_surface(
        surface, [HANDLE if up > 0 else WALL for up in sheet.vertices[:, 2]]
    )
    # Nearer to the upper side, but facing down.
    points_m, down = np.array([[0.0, 0.0, 0.0002]]), np.array([[0.0, 0.0, -1.0]])
    assert true.at(points_m, down) == [WALL]
    assert true.at(points_m, -down) == [HANDLE]


def test_of_the_slices_that_hold_the_first_counts(tmp_path):
    bar = trimesh.creation.box((0.2, 0.02, 0.02)).subdivide_to_size(0.01)
    surface = Surface(
        bar.vertices, bar.faces, np.zeros(len(bar.vertices), dtype=np.int16), np.array(["a"])
    )
    table = tmp_path / "slices.csv"
    lines = ["# measured", "object,role,attributes,axis,from_m,to_m", "bar,blade,wet,x,0.05,"]
    table.write_text("\n".join([*lines, "bar,handle,,x,,"]))
    true = TrueRoles.of_slices(surface, read_slices(table))
    found = true.at(np.array([[0.09, 0.0, 0.01], [0.02, 0.0, 0.01]]), np.array([[0, 0, 1.0]] * 2))
    assert [(part.role, part.attributes) for part in found] == [("blade", ("wet",)), ("handle", ())]
    table.write_text("\n".join(lines))
    with pytest.raises(InputError, match=r"bar: .*is in none"):
        TrueRoles.of_slices(surface, read_slices(table))


def test_a_forest_knows_the_shapes_that_it_has_seen():
    samples = sample_shapes(["egg_s01", "mallet_s01"], SETTINGS.descriptors, SETTINGS.samples)
    forest = grow_forest(samples, np.arange(2), ("test", 0), SETTINGS.forest)
    chances = forest.probabilities(samples.descriptors[1])
    assert chances.sum(axis=1) == pytest.approx(1)
    folds = np.zeros(2, dtype=np.intp)
    methods = {FOREST_METHOD: lambda fold: forest}
    found = held_out_roles(samples, folds, methods, SETTINGS)[FOREST_METHOD]
    kinds = KIND_SCHEMA.validate(kind_table(FOREST_METHOD, samples, found))
    assert kinds.accuracy.min() > 0.6
    roles = ROLE_SCHEMA.validate(role_table(FOREST_METHOD, samples, found))
    assert roles.area_share.sum() == pytest.approx(1, abs=0.001)
