"""Candidates come the shown's way or along the normals, and keep out of the object."""

from dataclasses import replace

import numpy as np
from synthesis_cases import CLOSING, ball_shown, scene_of
from tests.unit.barrett import BARRETT
from tests.unit.settings import PARAMS

from grasptypes.synthesis.candidates import draw_candidates, frames
from grasptypes.synthesis.energy import closeness

SETTINGS = PARAMS.synthesis.candidates


def drawn(shown, **changes):
    settings = SETTINGS.changed(**changes)
    draw = np.random.default_rng(3)
    return draw_candidates(scene_of(), shown, settings, CLOSING, draw)


def test_frames_are_rotations_that_look_along_the_approach() -> None:
    draw = np.random.default_rng(0)
    approach, side = draw.normal(size=(2, 50, 3))
    R = frames(approach, side)
    np.testing.assert_allclose(R @ np.swapaxes(R, 1, 2), np.tile(np.eye(3), (50, 1, 1)), atol=1e-9)
    np.testing.assert_allclose(np.linalg.det(R), 1.0)
    np.testing.assert_allclose(R[..., 2], approach / np.linalg.norm(approach, axis=1)[:, None])
    assert np.all(np.einsum("ni,ni->n", R[..., 1], side) >= 0)


def test_candidates_keep_out_of_the_object_and_within_limits() -> None:
    hands = drawn(ball_shown())
    poses = hands.T_object_hand[:, None] @ BARRETT.link_poses(hands.joint_positions)
    # Where the grid interpolates, a distance can be too large by some micrometres.
    assert closeness(scene_of(), poses).penetration_m.max() < 1e-5
    assert not BARRETT.beyond_limits(hands.joint_positions, 1e-9).any()


def test_followers_come_the_persons_way() -> None:
    shown = ball_shown()
    hands = drawn(shown, follow_share=1.0)
    assert np.median(hands.T_object_hand[:, :3, 2] @ shown.approach) > 0.95
    fingers = np.abs(hands.T_object_hand[:, :3, 1] @ shown.closing)
    assert np.median(fingers) > 0.95


def test_the_others_come_to_where_the_person_touched() -> None:
    hands = drawn(ball_shown(), follow_share=0.0)
    above = hands.T_object_hand[:, 2, 3] > -0.02
    assert above.mean() > 0.9
    assert (hands.T_object_hand[:, 2, 2] < 0.3).mean() > 0.9


def test_precision_grips_keep_the_palm_away() -> None:
    def distance(grip):
        return np.linalg.norm(drawn(ball_shown(grip)).T_object_hand[:, :3, 3], axis=1)

    assert np.median(distance("tripod")) > np.median(distance("enclose")) + 0.01
    assert distance("pinch").min() > 0.03


def test_hands_start_before_the_object_however_long_it_is() -> None:
    """A rod along the approach, longer than any distance at which hands start."""
    shown = ball_shown()
    rod = np.outer(np.linspace(-1.0, 0.0, 50), shown.approach) + shown.points_m[:50]
    long = replace(
        shown,
        points_m=np.vstack([shown.points_m, rod]),
        normals=np.vstack([shown.normals, shown.normals[:50]]),
        contact=np.concatenate([shown.contact, np.zeros(50)]),
    )
    short, far = drawn(shown, follow_share=1.0), drawn(long, follow_share=1.0)
    np.testing.assert_allclose(far.T_object_hand, short.T_object_hand, atol=2e-3)
