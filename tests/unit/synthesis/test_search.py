"""A session's search: sorted, spread out, repeatable, and better for being refined."""

import numpy as np
import pytest
from synthesis_cases import ball_shown, scene_of
from tests.unit.barrett import BARRETT
from tests.unit.settings import PARAMS

from grasptypes.seeds import rng
from grasptypes.synthesis.energy import closeness
from grasptypes.synthesis.search import search_session

SETTINGS = PARAMS.synthesis
SMALL = SETTINGS.changed(
    candidates=SETTINGS.candidates.changed(number=80),
    refinement=SETTINGS.refinement.changed(parents=4, rounds=2),
)


def search(settings=SMALL, session=1):
    draw = rng("synthesis", "ball", "use", session, 0)
    return search_session(scene_of(), ball_shown(), settings, draw)


@pytest.fixture(scope="module")
def ranked():
    return search()


def test_best_first_and_no_more_than_the_tries(ranked) -> None:
    assert 1 <= len(ranked.energy) <= SMALL.ranking.tries
    assert np.all(np.diff(ranked.energy) >= 0)
    assert np.isfinite(ranked.terms).all()


def test_same_key_same_bytes_and_another_session_differs(ranked) -> None:
    again = search()
    assert again.terms.tobytes() == ranked.terms.tobytes()
    for first, second in zip(ranked.hands[1:], again.hands[1:], strict=True):
        assert first.tobytes() == second.tobytes()
    assert search(session=2).terms.tobytes() != ranked.terms.tobytes()


def test_tries_differ_from_each_other(ranked) -> None:
    T = ranked.hands.T_object_hand
    for index in range(1, len(T)):
        apart = np.linalg.norm(T[:index, :3, 3] - T[index, :3, 3], axis=1)
        cosine = (np.einsum("nij,ij->n", T[:index, :3, :3], T[index, :3, :3]) - 1) / 2
        turned = np.arccos(np.clip(cosine, -1, 1))
        spread = ranked.hands.joint_positions[:, 0]
        turned += np.abs(spread[:index] - spread[index])
        limit = SMALL.ranking.apart_m - 1e-9
        assert np.all(apart + SMALL.ranking.rotation_length_m * turned >= limit)


def test_refinement_lowers_the_energy(ranked) -> None:
    unrefined = SMALL.changed(refinement=SMALL.refinement.changed(rounds=0))
    assert ranked.energy[0] < search(unrefined).energy[0]


def test_a_hopeless_session_still_has_grasps_to_give_its_reason() -> None:
    strict = SMALL.changed(ranking=SMALL.ranking.changed(min_fingers=4))
    found = search(strict)
    assert 1 <= len(found.energy) <= SMALL.ranking.tries
    assert np.isfinite(found.terms).all()
    assert np.all(np.diff(found.energy) >= 0)


def test_refinement_never_takes_what_must_not_be_ranked() -> None:
    # Variations as wide as the ball: most of them overlap it or touch with too few fingers.
    wild = SMALL.refinement.changed(position_sd_m=0.06, rotation_sd_rad=1.0, shrink=1.0)
    found = search(SMALL.changed(refinement=wild))
    poses = found.hands.T_object_hand[:, None] @ BARRETT.link_poses(found.hands.joint_positions)
    close = closeness(scene_of(), poses)
    assert close.penetration_m.max() <= SMALL.ranking.max_depth_m
    assert close.self_depth_m.max() <= SMALL.ranking.max_depth_m
