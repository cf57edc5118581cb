"""The fit finds the numbers that made the labels, and never sees what is left out."""

import numpy as np
import pytest
from tests.unit.contact_maps.shapes import box, held_object, mallet, rod
from tests.unit.settings import PARAMS

from grasptypes.contact_maps.hold_fit import (
    fit_parameters,
    free_parameters,
    girth_m,
    hold_problem,
    leave_out_relatives,
    relatives_of,
    wrap_shares,
)
from grasptypes.contact_maps.holds import find_holds
from grasptypes.contact_maps.placement import HumanHand
from grasptypes.contact_maps.places import find_places
from grasptypes.reports.hold_similarity import (
    PARAMETER_SCHEMA,
    SIMILARITY_SCHEMA,
    compare_holds,
    compare_parameters,
    session_counts,
)
from grasptypes.settings.holds import read_hold_table
from grasptypes.settings.tasks import read_tasks

TABLE, TASKS, SETTINGS = read_hold_table(), read_tasks(), PARAMS.hold_fit
HAND = HumanHand.of_length(0.183, PARAMS.contact_maps.hand)
RULE = PARAMS.grasp_types.thresholds, PARAMS.grasp_types.softness
OBJECTS = {
    "mallet": mallet(0.6),
    "stick": mallet(0.05),
    "can": held_object([("wall", "container_wall", (), rod(0.03, 0.15))]),
    "tub": held_object([("wall", "container_wall", (), rod(0.09, 0.09))]),
    "ball": held_object([("flesh", "ball", (), rod(0.04, 0.08))]),
    "bar": held_object([("body", "grip_body", (), box((0.03, 0.16, 0.05)))]),
}
PARAMETERS = free_parameters(TABLE, SETTINGS)


@pytest.fixture(scope="module")
def problems():
    return {
        (name, task): hold_problem(held, TASKS[task], TABLE, HAND, RULE)
        for name, held in OBJECTS.items()
        for task in ("use", "handoff")
    }


def in_table():
    """The table's own values of the free numbers."""
    return np.array(
        [np.log(each.in_table) if each.logarithmic else each.in_table for each in PARAMETERS]
    )


def published(problems, values):
    return {key: 1e3 * each.type_shares(values, 0.0) for key, each in problems.items()}


def test_the_problem_has_the_shares_of_the_table(problems):
    for (name, task), problem in problems.items():
        found = find_holds(OBJECTS[name], TASKS[task], TABLE, HAND)
        shares = problem.hold_shares(in_table())
        common = [shares[problem.grips == grip].sum() >= TABLE.rarest for grip in problem.grips]
        for grip in ("wrap", "enclose", "tripod", "pinch"):
            expected = sum(hold.probability for hold in found if hold.grip == grip)
            kept = shares[common][problem.grips[common] == grip].sum() / shares[common].sum()
            assert kept == pytest.approx(expected), (name, task, grip)


def test_the_fit_recovers_the_shares_that_made_the_labels(problems):
    true = in_table() + 0.5
    counts = published(problems, true)
    certain = SETTINGS.changed(grasps=1000.0, label_noise=0.0)
    values = fit_parameters(
        PARAMETERS, list(problems.values()), np.array(list(counts.values())), certain
    )
    for key, problem in problems.items():
        assert problem.type_shares(values, 0.0) == pytest.approx(
            counts[key] / counts[key].sum(), abs=0.02
        )


def test_without_labels_the_numbers_are_the_expected_ones(problems):
    vague = SETTINGS.changed(grasps=1e-9)
    counts = np.ones((len(problems), 6))
    values = fit_parameters(PARAMETERS, list(problems.values()), counts, vague)
    assert values == pytest.approx([each.expected for each in PARAMETERS], abs=1e-4)


def test_labels_of_what_is_left_out_change_nothing(problems):
    settings = SETTINGS.changed(relatives=(("can", "tub"),))
    counts = published(problems, in_table())
    fitted_on = [name for name in OBJECTS if name != "bar"]
    before = leave_out_relatives(PARAMETERS, problems, counts, fitted_on, settings)
    for out in ("can", "tub", "bar"):
        for task in ("use", "handoff"):
            counts[out, task] = np.array([0, 0, 0, 0, 0, 18.0])
    after = leave_out_relatives(PARAMETERS, problems, counts, fitted_on, settings)
    assert np.array_equal(before["can"], after["can"])
    assert np.array_equal(before["tub"], after["tub"])
    assert not np.array_equal(before["bar"], after["bar"])
    assert relatives_of("can", settings.relatives) == {"can", "tub"}
    assert relatives_of("ball", settings.relatives) == {"ball"}


def test_wraps_are_small_medium_and_large():
    for diameter_m, kind in ((0.02, 2), (0.065, 1), (0.15, 0)):
        shares = wrap_shares(diameter_m, *RULE)
        assert shares.argmax() == kind
        assert shares.sum() == pytest.approx(1.0)


def test_a_fist_around_an_attached_handle_encloses_the_wall():
    free = mallet()
    handle = find_places(free, TASKS["use"], TABLE, HAND.breadth_m)[0]
    assert girth_m(free, handle, HAND) == pytest.approx(0.028, abs=0.004)
    wall, bar = rod(0.04, 0.1), box((0.01, 0.02, 0.08), (0.06, 0.0, 0.0))
    mug = held_object([("wall", "container_wall", (), wall), ("handle", "handle", (), bar)])
    handle = find_places(mug, TASKS["use"], TABLE, HAND.breadth_m)[0]
    assert handle.group == "handle"
    assert girth_m(mug, handle, HAND) > 0.08


def test_the_tables_show_what_was_left_out(problems):
    counts = published(problems, in_table())
    fitted_on = [name for name in OBJECTS if name != "bar"]
    options = PARAMETERS, problems, counts, fitted_on
    table = SIMILARITY_SCHEMA.validate(compare_holds(*options, 20, TABLE.rarest, SETTINGS))
    rows = table.set_index(["object", "task"])
    assert rows.loc[("ball", "use"), "fitted_on"] == "4 other objects"
    assert np.isnan(rows.loc[("bar", "use"), "in_sample"])
    assert rows.loc[("mean of all", "mean"), "held_out"] == pytest.approx(
        rows.held_out.iloc[: len(problems)].mean(), abs=1e-3
    )
    fitted = PARAMETER_SCHEMA.validate(
        compare_parameters(PARAMETERS, problems, counts, fitted_on, SETTINGS)
    )
    assert fitted.set_index("key").loc["groups.handle.grips.wrap", "expected"] == 1.0


def test_sessions_follow_shares_by_largest_remainders():
    counts = session_counts(np.array([0.5, 0.26, 0.24, 0, 0, 0]), 10)
    assert counts.tolist() == [5, 3, 2, 0, 0, 0]
