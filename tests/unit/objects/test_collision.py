"""Collision hulls are convex, bounded in number and leave openings open."""

import numpy as np
import pytest
from manifold3d import Manifold, OpType
from tests.unit.settings import PARAMS

from grasptypes.kinds.catalogue import build
from grasptypes.kinds.modelling import build_shape
from grasptypes.objects import collision, solids
from grasptypes.objects.preparation import scaled_parts

RESOLUTION = PARAMS.objects.resolution


@pytest.fixture(scope="module")
def mug_hulls():
    return collision.convex_parts([part.solid for part in build("mug").parts], RESOLUTION)


def test_hulls_are_convex_few_and_light(mug_hulls):
    assert len(mug_hulls) <= 64
    for hull in mug_hulls:
        assert hull.hull().volume() == pytest.approx(hull.volume(), rel=1e-6)
        assert hull.num_vert() <= 160


def test_fingers_fit_through_the_handle_and_into_the_mug(mug_hulls):
    finger = (
        Manifold.cylinder(0.06, 0.009, center=True)
        .rotate((90, 0, 0))
        .translate((0.0485, 0, 0.0047))
    )
    hand = Manifold.cylinder(0.05, 0.032, center=True).translate((-0.0036, 0, 0.02))
    for hull in mug_hulls:
        assert (hull ^ finger).is_empty()
        assert (hull ^ hand).is_empty()


def test_hulls_cover_the_mug(mug_hulls):
    mug = solids.union(*(part.solid for part in build("mug").parts))
    missing = mug - solids.union(*mug_hulls)
    assert missing.volume() < 0.05 * mug.volume()


def test_convex_solid_stays_whole():
    hulls = collision.convex_parts([solids.box((0.05, 0.04, 0.03))], RESOLUTION)
    assert len(hulls) == 1
    assert hulls[0].volume() == pytest.approx(0.05 * 0.04 * 0.03)


def test_round_hulls_are_lightened_evenly():
    ball = Manifold.sphere(0.04, 128)
    (hull,) = collision.convex_parts([ball], RESOLUTION)
    assert hull.num_vert() <= 160
    assert hull.volume() == pytest.approx(ball.volume(), rel=0.06)
    assert np.abs(hull.bounding_box()) == pytest.approx(np.full(6, 0.04), abs=1e-3)


def test_thin_slivers_keep_their_hull():
    """The bowl's wall is cut into slivers that simplify to nothing."""
    parts = [part.solid for part in build("bowl").parts]
    hulls = collision.convex_parts(parts, RESOLUTION.changed(collision_max_parts=64))
    assert not any(hull.is_empty() for hull in hulls)
    wall = Manifold.cylinder(0.001, 0.2, 0.2, 64, True) ^ _united(parts)
    left = wall - _united(hulls)
    # Hulls are simplified by up to 0.4 mm, which takes a little off the wall.
    assert left.volume() < 0.03 * wall.volume()


def test_parts_thinner_than_the_tolerance_keep_their_volume():
    """The ring of the microphone collapses to a disc, of which engines make no body."""
    disc = Manifold.cylinder(RESOLUTION.collision_tolerance_m / 2, 0.03, 0.03, 64)
    (hull,) = collision.convex_parts([disc], RESOLUTION)
    assert hull.volume() > disc.volume() / 2


def test_flat_remnants_of_cuts_are_left_out():
    """One edge of the letter block is cut into pieces without a volume."""
    model = build_shape("letter_block_s01")
    parts = [part.solid for part in scaled_parts(model.model, model.scale)]
    hulls = collision.convex_parts(parts, RESOLUTION)
    assert min(hull.volume() for hull in hulls) > 1e-15


def _united(solids_: list) -> Manifold:
    return Manifold.batch_boolean(solids_, OpType.Add)
