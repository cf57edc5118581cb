"""Solids from descriptions: their size, volume and place are those that the description states."""

import numpy as np
import pytest

from grasptypes.kinds import shapes
from grasptypes.kinds.curves import curve
from grasptypes.kinds.solid_description import Solid
from grasptypes.settings.base import MisplacedError


def built(**described):
    return shapes.build(Solid.check(described), {}, "solid")


def bounds(solid):
    return np.array(solid.bounding_box()).reshape(2, 3)


def test_an_open_vessel_has_a_wall_of_the_stated_thickness():
    profile = [[0, 0], [0.04, 0], [0.04, 0.1]]
    cup = built(turned={"profile": profile, "wall": 0.004, "segments": 256})
    outside, inside = np.pi * 0.04**2 * 0.1, np.pi * 0.036**2 * 0.096
    assert cup.volume() == pytest.approx(outside - inside, rel=0.002)


@pytest.mark.parametrize(
    ("axis", "expected"),
    [("x", (0.3, 0.1, 0.2)), ("y", (0.1, 0.3, 0.2)), ("z", (0.1, 0.2, 0.3))],
)
def test_a_section_is_drawn_along_its_axis(axis, expected):
    outline = [[0, 0], [0.1, 0], [0.1, 0.2], [0, 0.2]]
    solid = built(extruded={"section": {"outline": outline}, "between": [0, 0.3]}, axis=axis)
    np.testing.assert_allclose(bounds(solid), [(0, 0, 0), expected], atol=1e-12)


def test_what_is_done_to_a_solid_happens_in_the_stated_order():
    solid = built(
        box={"size": [0.02, 0.02, 0.02]},
        keep={"z": [0, 1]},
        turn=[0, 90, 0],
        at=[0.1, 0, 0],
        ring={"count": 2},
        mirrored=["z"],
    )
    np.testing.assert_allclose(
        bounds(solid), [(-0.11, -0.01, -0.01), (0.11, 0.01, 0.01)], atol=1e-9
    )
    assert len(solid.decompose()) == 2


def test_slices_of_a_solid_vanish_in_their_union():
    tube = Solid.check(
        {
            "lofted": {
                "columns": ["x", "half_y", "half_z"],
                "rows": [[0, 1, 1], [1, 3, 2], [2, 1, 1]],
            }
        }
    )
    whole = shapes.build(tube, {}, "tube")
    slices = [shapes.between(whole, "x", low, high) for low, high in ((-9, 0.7), (0.7, 9))]
    joined = slices[0] + slices[1]
    assert len(joined.decompose()) == 1
    assert joined.volume() == pytest.approx(whole.volume(), rel=1e-9)


def test_a_rounded_corner_is_an_arc_of_its_radius():
    traced = curve([(0, 0), (1, 0, 0.2), (1, 1)], smooth=False)
    inner = traced[1:-1]
    np.testing.assert_allclose(np.linalg.norm(inner - [0.8, 0.2], axis=1), 0.2, atol=1e-9)


def test_a_closed_sweep_is_a_torus():
    turns = np.radians(np.arange(0, 360, 45))
    path = [[float(np.cos(turn)), float(np.sin(turn)), 0.0] for turn in turns]
    ring = built(swept={"path": path, "closed": True, "section": {"circle": 0.1}, "up": [0, 0, 1]})
    assert ring.genus() == 1
    assert ring.volume() == pytest.approx(2 * np.pi**2 * 0.1**2, rel=0.01)


def test_scales_narrow_a_sweep():
    path = [[0, 0, 0], [0, 0, 1]]
    section = {"circle": 0.1}
    cone = built(
        swept={"path": path, "smooth": False, "section": section, "scales": [[0, 1], [1, 0.5]]}
    )
    straight = built(swept={"path": path, "smooth": False, "section": section})
    assert cone.volume() / straight.volume() == pytest.approx(7 / 12, rel=0.01)


def test_an_empty_solid_names_its_key():
    with pytest.raises(MisplacedError) as raised:
        built(box={"size": [1, 1, 1]}, keep={"z": [2, 3]})
    assert raised.value.key == "solid"
