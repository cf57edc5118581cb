"""Laws of the objects held by a handle or in one hand: tools, blades, desk, phone, bathroom."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from manifold3d import Manifold

from grasptypes.objects import bathroom, blades, desk, phone, solids, tools
from grasptypes.objects.parts import ObjectModel

# Bounds of ContactDB's scans in mm (min, max) and the parts that contact maps refer to.
EXPECTED = {
    tools.hammer: ((-81.2, -69.7, -11.6), (123.9, 47.5, 11.6), "handle head face claw"),
    tools.flashlight: (
        (-17.5, -17.3, -58.3),
        (17.3, 17.2, 80.7),
        "body tail head reflector lens button",
    ),
    blades.knife: ((-12.9, -100.1, -7.4), (19.3, 121.9, 7.4), "handle rivets bolster blade"),
    blades.scissors: (
        (-37.2, -74.9, -7.0),
        (36.9, 55.1, 7.7),
        "blade_left blade_right loop_left loop_right pivot",
    ),
    desk.mouse: ((-59.0, -31.3, -16.4), (57.8, 31.3, 22.6), "body button_left button_right wheel"),
    desk.stapler: (
        (-57.4, -15.0, -18.7),
        (65.6, 15.0, 21.8),
        "base anvil hinge pin magazine cover",
    ),
    phone.cell_phone: (
        (-66.8, -23.2, -12.3),
        (81.4, 23.9, 12.1),
        "back front bezel screen keys menu_key antenna",
    ),
    bathroom.toothbrush: (
        (-72.4, -13.7, -5.9),
        (92.5, 10.4, 6.6),
        "handle grip_pad neck head bristles",
    ),
    bathroom.toothpaste: (
        (-98.3, -26.4, -19.0),
        (103.9, 26.3, 19.1),
        "body label stripe fold shoulder cap",
    ),
}
BUILDERS = pytest.mark.parametrize("build", EXPECTED, ids=lambda build: build.__name__)
HALF_MM = 0.5


def union(model: ObjectModel) -> Manifold:
    return solids.union(*(part.solid for part in model.parts))


def part(model: ObjectModel, name: str) -> Manifold:
    return next(part.solid for part in model.parts if part.name == name)


def filled(solid: Manifold, *point_mm: float) -> bool:
    """Tell whether a point is inside, by a probe of 0.1 mm that lies inside or outside whole."""
    probe = solids.sphere(1e-4, 16).translate(tuple(1e-3 * x for x in point_mm))
    share = (solid ^ probe).volume() / probe.volume()
    assert share < 1e-6 or share > 1 - 1e-6
    return share > 0.5


def bounds_mm(solid: Manifold) -> np.ndarray:
    return 1e3 * np.array(solid.bounding_box()).reshape(2, 3)


@BUILDERS
def test_bounds_are_those_of_the_scan(build: Callable[[], ObjectModel]) -> None:
    low, high, _ = EXPECTED[build]
    np.testing.assert_allclose(bounds_mm(union(build())), [low, high], atol=HALF_MM)


@BUILDERS
def test_is_one_watertight_body(build: Callable[[], ObjectModel]) -> None:
    solid = union(build())
    assert len(solid.decompose()) == 1
    vertices, faces = solids.to_mesh(solid)
    edges = np.sort(faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    assert (np.unique(edges, axis=0, return_counts=True)[1] == 2).all()
    assert faces.max() == len(vertices) - 1


@BUILDERS
def test_every_part_is_named_and_shows(build: Callable[[], ObjectModel]) -> None:
    model = build()
    assert " ".join(part.name for part in model.parts) == EXPECTED[build][2]
    for index, shown in enumerate(model.parts):
        others = [part.solid for other, part in enumerate(model.parts) if other != index]
        assert (shown.solid - solids.union(*others)).volume() > 1e-9


def test_flashlight_has_an_open_reflector_with_the_lens_at_its_bottom() -> None:
    model = tools.flashlight()
    assert not filled(union(model), 0, 0, -56)
    assert filled(part(model, "lens"), 0, 0, -45)


def test_hammer_claw_is_parted_and_its_face_round() -> None:
    solid = union(tools.hammer())
    assert not filled(solid, -63, -60, 0)
    assert filled(solid, -63, -60, 8)
    assert not filled(solid, -69.7 + 10, 40, 10)


def test_knife_blade_is_thick_at_the_spine_and_thin_at_the_edge() -> None:
    blade = part(blades.knife(), "blade")
    assert filled(blade, -9.5, 20, 2.3)
    assert not filled(blade, -9.5, 20, 2.9)
    assert not filled(blade, 17, 20, 1.2)
    assert not filled(union(blades.knife()), 12, -22, 0)


def test_scissors_let_fingers_through_both_loops() -> None:
    solid = union(blades.scissors())
    for x_mm in (-19, 19):
        hole = solids.cylinder(0.011, 0.1).translate((1e-3 * x_mm, 0.026, 0.0))
        assert (solid ^ hole).volume() == 0


def test_scissors_blades_cross_over_to_the_loop_of_the_other_side() -> None:
    left = part(blades.scissors(), "blade_left")
    assert filled(left, -6, -40, 2)
    assert not filled(left, 6, -40, 2)
    assert not filled(left, -6, -40, -2)


def test_stapler_stands_open_between_magazine_and_base() -> None:
    solid = union(desk.stapler())
    assert not filled(solid, 30, 0, -6)
    assert filled(solid, 30, 0, 5)


def test_mouse_wheel_stands_out_between_the_buttons() -> None:
    model = desk.mouse()
    assert filled(part(model, "wheel"), -24.5, 0, 18)
    assert part(model, "button_left").bounding_box()[1] >= 0
    assert part(model, "button_right").bounding_box()[4] <= 0
    assert not filled(union(model), -50, 0, 6.0)


def test_phone_keys_stand_out_and_the_screen_lies_below_its_bezel() -> None:
    model = phone.cell_phone()
    tops = {part.name: part.solid.bounding_box()[5] for part in model.parts}
    assert tops["menu_key"] > tops["bezel"] > tops["screen"] > tops["front"]
    assert filled(part(model, "keys"), -40.5, 0, 10.2)


def test_toothbrush_bristles_point_down_from_the_head() -> None:
    model = bathroom.toothbrush()
    bristles, head = (bounds_mm(part(model, name)) for name in ("bristles", "head"))
    assert bristles[0, 1] < head[0, 1] - 5
    assert head[0, 0] < bristles[0, 0] < bristles[1, 0] < head[1, 0] + HALF_MM


def test_toothpaste_is_flat_at_the_fold_and_round_at_the_shoulder() -> None:
    solid = union(bathroom.toothpaste())
    assert filled(solid, -96, 20, 0.5)
    assert not filled(solid, -96, 0, 2)
    assert filled(solid, 74, 0, 18.5)
    assert filled(solid, 74, 18.5, 0)


def test_dimensions_can_be_varied() -> None:
    longer = replace(tools.Hammer(), face_end_y_m=0.060)
    assert bounds_mm(union(tools.hammer(longer)))[1, 1] == pytest.approx(60)
    smaller = replace(blades.Scissors(), loop_width_m=0.030, bow_outer_radius_m=0.014)
    assert len(union(blades.scissors(smaller)).decompose()) == 1
