"""Real objects beside the ranges of their kinds."""

import json

import numpy as np
import pytest

from grasptypes.errors import InputError
from grasptypes.reports.kind_sizes import (
    SIZE_TABLE,
    RealObject,
    furniture_objects,
    side_ranges,
    size_table,
    ycb_objects,
)


def test_sides_are_ranges_from_small_to_large():
    low, high = side_ranges("padlock")
    assert (low < high).all()
    assert (np.diff(low) <= 0).all()


def test_a_cube_is_measured_wherever_it_lies(tmp_path):
    folder = tmp_path / "ycb/die"
    folder.mkdir(parents=True)
    (tmp_path / "scripts").mkdir()
    (tmp_path / "scripts/ycb_mass.json").write_text(json.dumps({"die": 0.005}))
    corners = 0.02 * np.array([(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)])
    turn = np.array([(0.6, -0.8, 0), (0.8, 0.6, 0), (0, 0, 1)])
    lines = ["v {} {} {}".format(*point) for point in corners @ turn.T + 0.3]
    (folder / "textured.obj").write_text("\n".join(lines))
    die = ycb_objects(tmp_path)["die"]
    np.testing.assert_allclose(die.sides_m, 0.02, atol=1e-9)
    assert die.mass_kg == 0.005


def test_missing_sets_are_named(tmp_path):
    with pytest.raises(InputError, match="GRASPTYPES_YCB"):
        ycb_objects(tmp_path)
    with pytest.raises(InputError, match=r"\.sh3f"):
        furniture_objects(tmp_path)


def test_the_table_tells_what_is_inside(tmp_path):
    block = (
        "die:\n  imagenet: []\n  ycb: [small, large]\n  family: die\n  mass_kg: [0.004, 0.02, x]\n"
        "  sizes: {side: [0.01, 0.03, x]}\n  parts:\n    cube:\n      role: grip_body\n"
        "      material: plastic\n      solids: [{box: {size: [side, side, side]}}]\n"
    )
    (tmp_path / "toys.yaml").write_text(block)
    (tmp_path / "materials.yaml").write_text(
        "materials: {plastic: {density_kg_m3: 1000, colour: red}}\ncolours: {red: [1, 0, 0]}\n"
    )
    known = {
        "small": RealObject("small", np.full(3, 0.02), 0.01),
        "large": RealObject("large", np.full(3, 0.04), 0.01),
    }
    table = size_table(known, {}, tmp_path)
    SIZE_TABLE.validate(table)
    assert table.inside.tolist() == [True, False]
    with pytest.raises(InputError, match="there is no object 'large'"):
        size_table({"small": known["small"]}, {}, tmp_path)
