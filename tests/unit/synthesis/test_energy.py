"""Each term of the energy does what ContactGrasp's does."""

from dataclasses import replace

import numpy as np
import pytest
from synthesis_cases import ball_shown, closed, palm_at, scene_of
from tests.unit.barrett import BARRETT
from tests.unit.settings import PARAMS

from grasptypes.synthesis.energy import (
    TERMS,
    Targets,
    closeness,
    draw_targets,
    energies,
)

SETTINGS = PARAMS.synthesis.energy


def posed(heights, angles=None):
    T = np.concatenate([palm_at(height) for height in heights])
    if angles is None:
        angles = closed(T, *([1.0] * len(T)))
    return T[:, None] @ BARRETT.link_poses(angles)


def terms(poses, targets):
    close = closeness(scene_of(), poses)
    found = energies(scene_of().model, poses, close, targets, SETTINGS)
    return dict(zip(TERMS, found.T, strict=True))


def targets(attracting):
    person = ball_shown()
    return Targets(person.points_m, person.normals, attracting)


def test_contact_attracts_and_the_rest_repels() -> None:
    poses = posed([0.031, 0.1, 0.5])
    attraction = terms(poses, targets(600))["attraction"]
    assert attraction[0] < attraction[1] < attraction[2]
    repulsion = terms(poses, targets(0))["repulsion"]
    assert repulsion[0] > repulsion[1] > repulsion[2]


def test_terms_stay_constant_out_of_range() -> None:
    far = terms(posed([0.5, 0.9]), targets(300))
    assert far["attraction"][0] == pytest.approx(0.5 * SETTINGS.attraction_weight * 0.02)
    assert far["repulsion"][0] == pytest.approx(-0.5 * SETTINGS.repulsion_weight * 0.02)
    assert far["thumb"][0] == pytest.approx(SETTINGS.thumb_weight * 0.02)
    for values in far.values():
        assert values[0] == values[1]


def test_thumb_term_vanishes_where_finger_3_touches() -> None:
    touching, open_hand = posed([0.1]), posed([0.1], np.zeros((1, 8)))
    assert terms(touching, targets(600))["thumb"][0] < 0.03 * SETTINGS.thumb_weight
    assert terms(open_hand, targets(600))["thumb"][0] > terms(touching, targets(600))["thumb"][0]


def test_thumb_term_is_finger_3_s_distance_also_where_another_link_is_nearer() -> None:
    poses = posed([0.1], np.zeros((1, 8)))
    first, third = (BARRETT.link_names.index(f"distal_{finger}") for finger in (1, 3))
    # Beyond the end of finger 3, out of its bounding sphere; then finger 1 is put onto the point.
    point = poses[0, third, :3, 3] + poses[0, third, :3, 0] * 0.07
    alone = Targets(point[None], np.array([[0.0, 0.0, 1.0]]), 1)
    far = terms(poses, alone)["thumb"][0]
    covered = poses.copy()
    covered[0, first] = poses[0, third]
    covered[0, first, :3, 3] = point
    assert 0.0 < far < SETTINGS.thumb_weight * SETTINGS.range_m
    assert terms(covered, alone)["thumb"][0] == far


def test_penetration_is_the_depth_of_the_deepest_point() -> None:
    poses = posed([0.025], np.zeros((1, 8)))
    assert closeness(scene_of(), poses).penetration_m[0] == pytest.approx(0.005, abs=5e-4)
    assert terms(poses, targets(600))["penetration"][0] == pytest.approx(0.5, abs=0.05)


def test_fingers_that_cross_collide_and_an_open_hand_does_not() -> None:
    crossed = BARRETT.couple(np.radians([[90.0, 110.0, 110.0, 0.0]]))
    assert closeness(scene_of(), posed([5.0], crossed)).self_depth_m[0] > 0.003
    for spread in (0, 45, 90, 180):
        opened = BARRETT.couple(np.radians([[spread, 0.0, 0.0, 0.0]]))
        assert closeness(scene_of(), posed([5.0], opened)).self_depth_m[0] < 1e-3


def test_targets_are_drawn_from_touched_and_untouched_points() -> None:
    drawn = draw_targets(ball_shown(), SETTINGS, np.random.default_rng(0))
    assert drawn.attracting == SETTINGS.attraction_points
    assert np.all(drawn.points[: drawn.attracting, 2] > 0)
    assert np.all(drawn.points[drawn.attracting :, 2] <= 0)


def test_weak_contact_still_has_its_strongest_points() -> None:
    shown = ball_shown()
    weak = replace(shown, contact=0.1 * shown.contact)
    drawn = draw_targets(weak, SETTINGS, np.random.default_rng(0))
    assert drawn.attracting > 0
