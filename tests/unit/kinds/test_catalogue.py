"""Every object of the catalogue: a solid of named parts, as large and heavy as such things are."""

import numpy as np
import pytest
from manifold3d import Manifold

from grasptypes.kinds.catalogue import build, object_names
from grasptypes.objects import solids
from grasptypes.objects.parts import ImportedModel
from grasptypes.objects.preparation import physical_properties
from grasptypes.settings.objects import CATALOGUE

# Bounds in mm: (x, y, z) lows, then highs; of ContactDB's scans, or of fruit as sold.
BOUNDS_MM = {
    "apple": ((-36.8, -37.0, -33.9), (37.3, 37.0, 44.6)),
    "banana": ((-95.3, -17.7, -28.3), (95.3, 17.7, 28.3)),
    "bowl": ((-74.5, -74.0, -41.1), (74.5, 73.9, 35.5)),
    "cell_phone": ((-66.8, -23.2, -12.3), (81.4, 23.9, 12.1)),
    "cup": ((-42.1, -42.1, -49.2), (42.1, 42.1, 50.3)),
    "flashlight": ((-17.5, -17.3, -58.3), (17.3, 17.2, 80.7)),
    "hammer": ((-81.2, -69.7, -11.6), (123.9, 47.5, 11.6)),
    "knife": ((-12.9, -100.1, -7.4), (19.3, 121.9, 7.4)),
    "light_bulb": ((-62.9, -31.0, -30.9), (47.6, 31.1, 31.1)),
    "mouse": ((-59.0, -31.3, -16.4), (57.8, 31.3, 22.6)),
    "mug": ((-44.7, -41.1, -48.3), (71.2, 41.1, 56.3)),
    "pan": ((-85.3, -75.0, -13.0), (150.7, 75.0, 21.6)),
    "scissors": ((-37.2, -74.9, -7.0), (36.9, 55.1, 7.7)),
    "stapler": ((-57.4, -15.0, -18.7), (65.6, 15.0, 21.8)),
    "toothbrush": ((-72.4, -13.7, -5.9), (92.5, 10.4, 6.6)),
    "toothpaste": ((-98.3, -26.4, -19.0), (103.9, 26.3, 19.1)),
    "utah_teapot": ((-104.2, -68.0, -44.2), (115.9, 68.0, 60.6)),
    "water_bottle": ((-30.1, -30.1, -60.6), (30.1, 30.1, 75.9)),
    "wine_glass": ((-35.4, -35.4, -102.7), (35.4, 35.4, 69.3)),
}
# Points in mm on the inside and the outside of an object, or of one of its parts.
FILLED_MM = {
    "cell_phone keys": [(-40.5, 0, 10.2)],
    "flashlight lens": [(0, 0, -45)],
    "hammer": [(-63, -60, 8)],
    "knife blade": [(-9.5, 20, 2.3)],
    "mouse wheel": [(-24.5, 0, 18)],
    "scissors blade_left": [(-6, -40, 2)],
    "stapler": [(30, 0, 5)],
    "toothpaste": [(-96, 20, 0.5), (74, 0, 18.5), (74, 18.5, 0)],
}
EMPTY_MM = {
    "bowl": [(0, 0, 0)],
    "cup": [(0, 0, 0)],
    "flashlight": [(0, 0, -56)],
    "hammer": [(-63, -60, 0), (-59.7, 40, 10)],
    "knife": [(12, -22, 0)],
    "knife blade": [(-9.5, 20, 2.9), (17, 20, 1.2)],
    "mouse": [(-50, 0, 6)],
    "mug": [(0, 0, 0)],
    "scissors blade_left": [(6, -40, 2), (-6, -40, -2)],
    "stapler": [(30, 0, -6)],
    "toothpaste": [(-96, 0, 2)],
    "wine_glass": [(0, 0, 20)],
}


def union(model):
    return solids.union(*(part.solid for part in model.parts))


def bounds_mm(solid):
    return 1e3 * np.reshape(solid.bounding_box(), (2, 3))


def filled_share(what, point_mm):
    """Share of a probe of 0.1 mm that is in an object, or in one of its parts."""
    name, _, part_name = what.partition(" ")
    model = build(name)
    solids_of = {part.name: part.solid for part in model.parts} | {"": union(model)}
    probe = Manifold.sphere(1e-4, 16).translate(tuple(1e-3 * x for x in point_mm))
    return (solids_of[part_name] ^ probe).volume() / probe.volume()


def test_the_settings_name_the_same_objects():
    assert sorted(CATALOGUE) == sorted(object_names()) == sorted(BOUNDS_MM)


@pytest.mark.parametrize("name", object_names())
def test_objects_are_bodies_one_can_hold(name):
    model = build(name)
    solid = union(model)
    tolerance_mm = 1.0 if name == "utah_teapot" else 0.5
    assert bounds_mm(solid) == pytest.approx(np.array(BOUNDS_MM[name]), abs=tolerance_mm)
    assert len(solid.decompose()) == 1
    found = physical_properties(name, ImportedModel(model, 1.15))
    assert 0.015 < found.mass_kg < 1.0
    low, high = np.array(found.bounds_m)
    assert ((low < found.centre_of_mass_m) & (found.centre_of_mass_m < high)).all()
    moments = np.linalg.eigvalsh(found.inertia_kg_m2)
    assert moments[0] > 0
    assert moments[2] <= moments[0] + moments[1]


@pytest.mark.parametrize("name", object_names())
def test_every_part_shows_and_is_built_the_same_every_time(name):
    parts, again = build(name).parts, build(name).parts
    for index, part in enumerate(parts):
        others = [other.solid for other in parts if other is not part]
        assert (part.solid - solids.union(*others)).volume() > 1e-9, part.name
        assert part.name == again[index].name
        assert part.solid.volume() == again[index].solid.volume()


@pytest.mark.parametrize("what", FILLED_MM)
def test_is_filled(what):
    for point_mm in FILLED_MM[what]:
        assert filled_share(what, point_mm) > 1 - 1e-6, point_mm


@pytest.mark.parametrize("what", EMPTY_MM)
def test_is_open(what):
    for point_mm in EMPTY_MM[what]:
        assert filled_share(what, point_mm) < 1e-6, point_mm


@pytest.mark.parametrize("name", ["mug", "utah_teapot", "pan"])
def test_handle_leaves_a_hole(name):
    assert union(build(name)).genus() == 1


def test_scissors_let_fingers_through_both_loops():
    solid = union(build("scissors"))
    for x_mm in (-19, 19):
        hole = Manifold.cylinder(0.1, 0.011, center=True).translate((1e-3 * x_mm, 0.026, 0.0))
        assert (solid ^ hole).volume() == 0


def test_small_parts_are_where_they_belong():
    boxes = {
        name: {part.name: bounds_mm(part.solid) for part in build(name).parts}
        for name in ("cell_phone", "mouse", "toothbrush")
    }
    tops = {name: box[1, 2] for name, box in boxes["cell_phone"].items()}
    assert tops["menu_key"] > tops["bezel"] > tops["screen"] > tops["front"]
    assert boxes["mouse"]["button_left"][0, 1] >= 0 >= boxes["mouse"]["button_right"][1, 1]
    bristles, head = boxes["toothbrush"]["bristles"], boxes["toothbrush"]["head"]
    assert bristles[0, 1] < head[0, 1] - 5
    assert head[0, 0] < bristles[0, 0] < bristles[1, 0] < head[1, 0] + 0.5
