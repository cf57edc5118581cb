"""The vessels, the cookware and the other turned objects meet their frames and stay open."""

from dataclasses import replace

import numpy as np
import pytest

from grasptypes.objects import cookware, solids, vessels
from grasptypes.objects.catalogue import OBJECTS

# Bounds in mm of ContactDB's scans: (x, y, z) lows, then highs.
BOUNDS_MM = {
    "bowl": ((-74.5, -74.0, -41.1), (74.5, 73.9, 35.5)),
    "cup": ((-42.1, -42.1, -49.2), (42.1, 42.1, 50.3)),
    "light_bulb": ((-62.9, -31.0, -30.9), (47.6, 31.1, 31.1)),
    "mug": ((-44.7, -41.1, -48.3), (71.2, 41.1, 56.3)),
    "pan": ((-85.3, -75.0, -13.0), (150.7, 75.0, 21.6)),
    "utah_teapot": ((-104.2, -68.0, -44.2), (115.9, 68.0, 60.6)),
    "water_bottle": ((-30.1, -30.1, -60.6), (30.1, 30.1, 75.9)),
    "wine_glass": ((-35.4, -35.4, -102.7), (35.4, 35.4, 69.3)),
}
INSIDE_MM = {"bowl": (0, 0, 0), "cup": (0, 0, 0), "mug": (0, 0, 0), "wine_glass": (0, 0, 20)}


def whole(name):
    return solids.union(*(part.solid for part in OBJECTS[name]().parts))


@pytest.mark.parametrize("name", BOUNDS_MM)
def test_bounds_match_the_scans(name):
    bounds_mm = 1e3 * np.reshape(whole(name).bounding_box(), (2, 3))
    assert bounds_mm == pytest.approx(np.array(BOUNDS_MM[name]), abs=1.0)


@pytest.mark.parametrize("name", [*BOUNDS_MM, "apple", "banana"])
def test_is_one_body(name):
    assert len(whole(name).decompose()) == 1


@pytest.mark.parametrize("name", INSIDE_MM)
def test_vessel_is_hollow(name):
    probe = solids.sphere(0.005).translate(tuple(1e-3 * np.array(INSIDE_MM[name])))
    assert (whole(name) ^ probe).is_empty()


@pytest.mark.parametrize("name", ["mug", "utah_teapot", "pan"])
def test_handle_leaves_a_hole(name):
    assert whole(name).genus() == 1


def test_apple_and_banana_have_market_sizes():
    apple = np.ptp(np.reshape(whole("apple").bounding_box(), (2, 3)), axis=0)
    banana = np.ptp(np.reshape(whole("banana").bounding_box(), (2, 3)), axis=0)
    assert apple[:2] == pytest.approx([0.075, 0.075], abs=0.002)
    assert banana[:2] == pytest.approx([0.190, 0.036], abs=0.002)


def test_dimensions_make_variants():
    wide = vessels.mug(replace(vessels.Mug(), handle_reach_m=0.04))
    flat = cookware.pan(replace(cookware.Pan(), tilt_deg=0.0))
    assert solids.union(*(p.solid for p in wide.parts)).bounding_box()[3] > 0.08
    assert solids.union(*(p.solid for p in flat.parts)).bounding_box()[2] > -0.0115
