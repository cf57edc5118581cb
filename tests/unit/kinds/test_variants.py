"""Variants: names, and shapes that stay whole, in range and the same for the same name."""

import numpy as np
import pytest
from tests.unit.settings import RAW

from grasptypes.kinds.catalogue import build, object_names
from grasptypes.kinds.variation import Variation, build_variant, vary
from grasptypes.objects import solids
from grasptypes.objects.parts import Material, ObjectModel, Part
from grasptypes.objects.variants import all_objects, base_of, variant_names, variant_of
from grasptypes.settings.objects import ObjectSettings, VariationRanges

RANGES = VariationRanges(
    size=(0.85, 1.2), stretch=(0.88, 1.14), balance=(-0.06, 0.06), taper=(-0.12, 0.12)
)
GREY = Material((0.5, 0.5, 0.5, 1.0))


def union(model):
    return solids.union(*(part.solid for part in model.parts))


def box_of(model):
    return np.array(union(model).bounding_box()).reshape(2, 3)


def bar(shell_thickness_m=None):
    """A bar of 0.2 x 0.04 x 0.02, cut in two at a quarter of its length."""
    low, high = solids.box((0.2, 0.04, 0.02)).split_by_plane((1.0, 0.0, 0.0), -0.05)[::-1]
    parts = (Part("head", low, GREY), Part("handle", high, GREY, density_kg_m3=700.0))
    return ObjectModel(parts, 1000.0, shell_thickness_m)


def test_names_go_there_and_back():
    assert variant_names("mug", 2) == ["mug_v01", "mug_v02"]
    assert variant_of("wine_glass_v12") == ("wine_glass", 12)
    assert variant_of("mug") == ("mug", 0)
    assert base_of("mug_v01") == "mug"
    own = {"ladle": {"file": "ladle.stl", "unit": "m", "mass_kg": 0.1}}
    changes = {"names": ["mug", "pan"], "variants": 1, "own": own}
    objects = ObjectSettings.check(RAW["objects"] | changes)
    assert all_objects(objects) == ["mug", "pan", "mug_v01", "pan_v01", "ladle"]


def test_nothing_varied_changes_nothing():
    same = vary(bar(), Variation(1.0, (1.0, 1.0, 1.0), (0.0, 0.0, 0.0), 0.0))
    assert box_of(same) == pytest.approx(box_of(bar()))
    assert [part.name for part in same.parts] == ["head", "handle"]
    assert same.parts[1].density_kg_m3 == 700.0


def test_every_number_does_what_it_says():
    varied = vary(
        bar(shell_thickness_m=0.002), Variation(1.1, (1.0, 1.2, 1.0), (0.05, 0.0, 0.0), 0.1)
    )
    low, high = box_of(varied)
    assert (high - low)[0] == pytest.approx(1.1 * 0.2)
    assert (high - low)[1] == pytest.approx(1.1 * 1.2 * 0.04 * 1.1)
    # A quarter of the length becomes 0.25 + 4 x 0.05 x 0.25 x 0.75 of it.
    joint_m = box_of(ObjectModel(varied.parts[:1], 1.0))[1, 0]
    assert (joint_m - low[0]) / (high - low)[0] == pytest.approx(0.2875)
    head = box_of(ObjectModel(varied.parts[:1], 1.0))
    assert (head[1] - head[0])[1] == pytest.approx(1.1 * 1.2 * 0.04 * (1 + 0.1 * (2 * 0.2875 - 1)))
    assert varied.shell_thickness_m == pytest.approx(0.0022)


@pytest.mark.parametrize("name", object_names())
def test_variants_are_whole_in_range_and_come_back_the_same(name):
    base, varied = build(name), build_variant(f"{name}_v01", RANGES, 0)
    solid = union(varied)
    # A bubble of rounding has no volume.
    assert sum(piece.volume() > 1e-12 for piece in solid.decompose()) == 1
    assert solid.genus() <= union(base).genus()
    ratio = np.ptp(box_of(varied), axis=0) / np.ptp(box_of(base), axis=0)
    assert (ratio > 0.85 * 0.88 * 0.88).all()
    assert (ratio < 1.2 * 1.14 * 1.12).all()
    assert [part.name for part in varied.parts] == [part.name for part in base.parts]
    again = build_variant(f"{name}_v01", RANGES, 0)
    for part, same in zip(varied.parts, again.parts, strict=True):
        assert np.array_equal(solids.to_mesh(part.solid)[0], solids.to_mesh(same.solid)[0])


def test_number_and_seed_give_other_shapes():
    first = box_of(build_variant("cup_v01", RANGES, 0))
    assert not np.allclose(first, box_of(build_variant("cup_v02", RANGES, 0)))
    assert not np.allclose(first, box_of(build_variant("cup_v01", RANGES, 1)))
