"""Every flaw has its reason, every session its row, and every row meets its schema."""

from dataclasses import dataclass, field

import numpy as np
import pandas as pd
import pandera.pandas as pa
import pytest
from synthesis_cases import ball_shown, closed, palm_at, scene_of
from tests.unit.barrett import BARRETT, COUPLING
from tests.unit.settings import PARAMS

from grasptypes.contact_maps.contact_map import ContactMap
from grasptypes.hands import configuration
from grasptypes.hands.surface import depth_in_hand
from grasptypes.physics.engine import Contact
from grasptypes.physics.holding import HoldResult
from grasptypes.synthesis.energy import closeness
from grasptypes.synthesis.grasps import ATTEMPT_SCHEMA, GRASP_SCHEMA
from grasptypes.synthesis.tester import GraspTester
from grasptypes.synthesis.trials import SynthesisTask, synthesize_sessions
from grasptypes.tables import read_table, write_table

VALIDITY = PARAMS.physics.validity
T = palm_at(0.035)
ANGLES = closed(T, 0.0)[0]


@dataclass
class World:
    """Physics of which the outcome is known: the n-th grasp holds if the n-th entry says so."""

    holds: list[bool]
    links: tuple[int, ...] = (6, 7, 8)
    sink_m: float = 0.0
    seen: int = field(default=0)
    bears: tuple[bool, ...] = (True,)

    def hold(self, T_object_hand, joint_positions):
        bears_load = self.bears[self.seen % len(self.bears)]
        dropped = not self.holds[self.seen % len(self.holds)]
        self.seen += 1
        pose = T_object_hand.copy()
        pose[2, 3] -= self.sink_m
        down = np.array([0.0, 0.0, -1.0])
        contacts = [Contact(link, -0.03 * down, down, 2.0) for link in self.links]
        moved, state = (0.001, 0.01), (pose, joint_positions, contacts, (1, 0, 0))
        return HoldResult(dropped, *moved, *state, bears_load)


def tried(world, T_object_hand=T[0], angles=ANGLES):
    return GraspTester(scene_of(), world.hold, VALIDITY).try_grasp(T_object_hand, angles)


def test_a_held_grasp_is_valid() -> None:
    assert tried(World([True])).reason == ""


def test_reasons() -> None:
    beyond, crossed = ANGLES.copy(), BARRETT.couple(np.radians([90.0, 110.0, 110.0, 0.0]))
    beyond[2] = np.radians(144.0)
    world = World([True])
    assert tried(world, angles=beyond).reason == "joint_limit"
    assert tried(world, palm_at(5.0)[0], crossed).reason == "self_collision"
    assert tried(world, palm_at(0.025)[0], np.zeros(8)).reason == "penetrates"
    assert tried(world, palm_at(0.5)[0], np.zeros(8)).reason == "no_contact"
    assert world.seen == 0
    assert tried(World([False])).reason == "dropped"
    assert tried(World([True], links=(6,))).reason == "no_contact"
    assert tried(World([True], sink_m=0.01)).reason == "penetrates"


def test_a_grasp_must_hold_in_all_engines_and_the_first_one_is_recorded() -> None:
    first, others = World([True], sink_m=0.001), [World([True]), World([False])]
    alone = tried(first)
    tests = [other.hold for other in others]
    agreed = GraspTester(scene_of(), first.hold, VALIDITY, tests[:1]).try_grasp(T[0], ANGLES)
    refused = GraspTester(scene_of(), first.hold, VALIDITY, tests).try_grasp(T[0], ANGLES)
    assert not alone.reason
    assert not agreed.reason
    assert np.array_equal(agreed.T_object_hand, alone.T_object_hand)
    assert refused.reason == "dropped"
    assert np.array_equal(refused.T_object_hand, T[0])


def test_a_grasp_that_the_first_engine_refuses_is_not_tested_again() -> None:
    other = World([True])
    for first in (World([False]), World([True], sink_m=0.01), World([True], links=(6,))):
        GraspTester(scene_of(), first.hold, VALIDITY, [other.hold]).try_grasp(T[0], ANGLES)
    assert other.seen == 0


@pytest.mark.parametrize(("degrees", "reason"), [(1.5, ""), (2.5, "joint_limit")])
def test_a_fingertip_that_was_pushed_behind_its_finger_is_no_state_of_the_hand(
    degrees, reason
) -> None:
    @dataclass
    class Pushing(World):
        def hold(self, T_object_hand, joint_positions):
            held = super().hold(T_object_hand, joint_positions)
            pushed = held.joint_positions.copy()
            pushed[7] = COUPLING * pushed[4] - np.radians(degrees)
            return held._replace(joint_positions=pushed)

    assert tried(Pushing([True])).reason == reason


def test_a_thin_wall_between_the_hand_s_points_penetrates() -> None:
    wall = T[0, :3, 3] + [[0.0, 0.0, 0.004]]
    scene = scene_of()
    cut = scene._replace(surface_m=np.vstack([scene.surface_m, wall]))
    trial = GraspTester(cut, World([True]), VALIDITY).try_grasp(T[0], ANGLES)
    assert trial.reason == "penetrates"
    assert trial.penetration_m == pytest.approx(0.004, abs=0.001)


def test_what_is_stored_is_what_was_looked_at() -> None:
    @dataclass
    class Apart(World):
        def hold(self, T_object_hand, joint_positions):
            held = super().hold(T_object_hand, joint_positions)
            angles = joint_positions.copy()
            angles[:2] = 0.2, 0.0
            angles[2] = -0.005
            return held._replace(joint_positions=angles)

    trial = tried(Apart([True]))
    assert trial.joint_positions[0] == trial.joint_positions[1] == pytest.approx(0.1)
    assert trial.joint_positions[2] == 0.0
    poses = trial.T_object_hand @ BARRETT.link_poses(trial.joint_positions)
    of_hand = closeness(scene_of(), poses[None]).penetration_m[0]
    of_ball = depth_in_hand(BARRETT, scene_of().surface_m, poses)
    assert trial.penetration_m == max(of_hand, of_ball)
    assert trial.reason == ""


def contact_map(sessions=3) -> ContactMap:
    person = ball_shown()
    count = len(person.points_m)
    return ContactMap(
        points=person.points_m.astype(np.float32),
        normals=person.normals.astype(np.float32),
        part_index=np.zeros(count, np.int16),
        part_names=np.array(["ball"]),
        probability=person.contact.astype(np.float32),
        sessions=np.tile(person.contact.astype(np.float32), (sessions, 1)),
        style=np.array(["power"] * sessions),
        grip=np.array(["enclose"] * sessions),
        part=np.array(["*"] * sessions),
        approach=np.tile(np.float32(person.approach), (sessions, 1)),
        closing=np.tile(np.float32(person.closing), (sessions, 1)),
        centre_m=np.zeros((sessions, 3), np.float32),
        height=np.zeros(sessions, np.float32),
        hand_length_m=np.full(sessions, 0.2, np.float32),
    )


def synthesized(world, sessions=3, kept=3.0, searches=2):
    settings = PARAMS.synthesis
    settings = settings.changed(
        candidates=settings.candidates.changed(number=60),
        refinement=settings.refinement.changed(parents=4, rounds=1),
        grip_shape=settings.grip_shape.changed(kept=kept),
        ranking=settings.ranking.changed(searches=searches),
    )
    task = SynthesisTask("ball", "use", None, contact_map(sessions), 0)
    tester = GraspTester(scene_of(), world.hold, VALIDITY)
    return synthesize_sessions(task, scene_of(), tester, settings)


def test_every_attempt_is_kept_and_the_first_valid_one_is_the_grasp(tmp_path) -> None:
    grasps, attempts = synthesized(World([False, True]))
    assert grasps.session.tolist() == [1, 2, 3]
    assert grasps.valid.all()
    assert grasps.tries.sum() == len(attempts)
    assert attempts.reason.tolist().count("") == 3
    for row in grasps.itertuples():
        assert configuration.unpack(row.hand_configuration).rank_index == row.rank
        assert len(row.contact_points_m) == 3 * len(row.contact_links)
    for name, table, schema in (("g", grasps, GRASP_SCHEMA), ("a", attempts, ATTEMPT_SCHEMA)):
        write_table(table, tmp_path / f"{name}.parquet", schema)
        assert len(read_table(tmp_path / f"{name}.parquet", schema)) == len(table)


def test_of_valid_grasps_that_left_the_grip_the_one_that_left_it_least_is_chosen() -> None:
    grasps, attempts = synthesized(World([False, True]), kept=-1.0)
    for row in grasps.itertuples():
        tried = attempts[attempts.session == row.session]
        valid = tried[tried.valid]
        assert len(valid) > 1
        assert row.grip_deviation == valid.grip_deviation.min()
        assert tried["rank"][tried.chosen].tolist() == [row.rank]
        assert row.tries == len(tried)


def test_a_grasp_that_bears_the_load_is_preferred_within_some_tries() -> None:
    tries = PARAMS.synthesis.ranking.load_tries
    grasps, _ = synthesized(World([True], bears=(False, True)), sessions=1)
    assert grasps[["rank", "tries", "bears_load"]].to_numpy().tolist() == [[1, 2, True]]
    grasps, _ = synthesized(World([True], bears=(False,)), sessions=1)
    assert grasps[["rank", "tries", "bears_load"]].to_numpy().tolist() == [[0, tries + 1, False]]


def test_without_a_valid_grasp_the_best_is_kept_with_its_reason() -> None:
    grasps, attempts = synthesized(World([False]))
    assert not grasps.valid.any()
    assert (grasps["rank"] == 0).all()
    assert (grasps.reason == "dropped").all()
    assert len(attempts) > len(grasps)


def test_a_session_without_a_valid_grasp_searches_again() -> None:
    _, once = synthesized(World([False]), sessions=1, searches=1)
    _, twice = synthesized(World([False]), sessions=1, searches=2)
    first = twice.head(len(once)).reset_index(drop=True)
    pd.testing.assert_frame_equal(first, once)
    assert len(twice) > len(once)
    assert twice["rank"].tolist() == list(range(len(twice)))
    later = World([False] * len(once) + [True])
    grasps, attempts = synthesized(later, sessions=1, searches=5)
    assert len(attempts) == len(once) + 1
    assert grasps["rank"].tolist() == [len(once)]


def test_a_session_does_not_depend_on_the_others() -> None:
    three, _ = synthesized(World([True]))
    one, _ = synthesized(World([True]), sessions=1)
    pd.testing.assert_frame_equal(three.head(1), one)


def test_schema_refuses_a_valid_grasp_with_a_reason() -> None:
    _, attempts = synthesized(World([True]))
    attempts.loc[0, "reason"] = "dropped"
    with pytest.raises(pa.errors.SchemaError):
        ATTEMPT_SCHEMA.validate(attempts)
