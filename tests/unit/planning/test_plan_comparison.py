"""Counting what a plan costs, and the types that predictors choose for objects left out."""

import numpy as np
import pandas as pd
import pytest
from learning import OBJECTS, SETTINGS, TASKS, examples
from synthesis_cases import ball_object
from tests.unit.settings import PARAMS

from grasptypes.labels.grasp_type import GRASP_TYPES
from grasptypes.planning import plan_comparison
from grasptypes.planning.plan_comparison import (
    ANY,
    CHOICES,
    LABELLED,
    PLANNING_SCHEMA,
    PREDICTED,
    Case,
    held_out_types,
    outcome,
    savings,
    summary,
    text,
    unseen_types,
)
from grasptypes.planning.sessions import PlanningContext
from grasptypes.predictors.general_protocol import OCCURS, SHARES, VIEWS_WITH_SIZE
from grasptypes.predictors.problem import LearningProblem

TYPES = {PREDICTED: ["Precision"], LABELLED: ["Small Wrap", "Large Wrap"]}


@pytest.fixture
def planned(monkeypatch):
    """A plan that costs nothing: five tries of three sessions, of which two hold."""
    attempts = pd.DataFrame(
        {
            "session": [1, 1, 2, 2, 3],
            "moved_m": [0.0, 0.001, 0.2, 0.0, 0.002],
            "grasp_type": ["Invalid", "Small Wrap", "Invalid", "Invalid", "Large Wrap"],
            "valid": [False, True, False, False, True],
            "energy": [0.2, 0.5, 0.1, 0.4, 0.3],
        }
    )
    # What the plan chose of each session plays no part.
    grasps = attempts.drop_duplicates("session")
    asked = {}
    contacts = plan_comparison.__name__ + ".plan_contacts"
    monkeypatch.setattr(contacts, lambda task, measured, grips, *rest: asked.update(grips=grips))
    found = lambda *rest: (attempts, grasps)  # noqa: E731
    monkeypatch.setattr(plan_comparison.__name__ + ".plan_sessions", found)
    monkeypatch.setattr(plan_comparison.MapTask, "of_object", lambda *rest: None)
    return asked


@pytest.mark.parametrize(
    ("choice", "grips"),
    [
        (PREDICTED, ("pinch",)),
        (LABELLED, ("wrap",)),
        (ANY, ("wrap", "enclose", "tripod", "pinch")),
    ],
)
def test_tests_and_valid_grasps_are_counted_for_each_choice(planned, tmp_path, choice, grips):
    context = PlanningContext(ball_object(tmp_path), "use", "ball", tmp_path, PARAMS)
    row = outcome(Case(context, choice, TYPES))
    assert planned["grips"] == grips
    assert (row["sessions"], row["tests"], row["valid"]) == (3, 3, 2)
    assert (row["valid_predicted"], row["valid_labelled"]) == (0, 2)
    assert (row["energy"], row["energy_labelled"]) == (0.3, 0.3)
    assert np.isnan(row["energy_predicted"])
    PLANNING_SCHEMA.validate(pd.DataFrame([row]))


def table():
    rows = []
    for number, name in enumerate(("apple", "mug")):
        for place, choice in enumerate(CHOICES):
            # Of the labels' types, one choice has no grasp of the mug.
            labelled = np.nan if (name, choice) == ("mug", ANY) else 0.5 - 0.1 * place
            energies = {"": 0.1 * (place + number), "_predicted": 0.7, "_labelled": labelled}
            row = {"object": name, "task": "use", "choice": choice, "types": "Precision"}
            row |= {"sessions": 3, "tests": 12}
            for kind, energy in energies.items():
                row |= {f"valid{kind}": 2 + place, f"energy{kind}": energy}
            rows.append(row)
    return PLANNING_SCHEMA.validate(pd.DataFrame(rows))


def test_energies_are_compared_where_all_choices_have_a_grasp():
    totals = summary(table())
    assert totals.tests.tolist() == [24, 24, 24]
    assert totals.tests_per_valid.tolist() == [6, 4, 3]
    np.testing.assert_allclose(totals.energy, [0.05, 0.15, 0.25])
    np.testing.assert_allclose(totals.energy_labelled, [0.5, 0.4, 0.3])  # of the apple alone


def test_the_summary_is_a_table_of_markdown():
    lines, sentences = (part.splitlines() for part in text(table()).split("\n\n"))
    assert len({line.count("|") for line in lines}) == 1
    assert lines[-1].startswith("| all types | 24 | 8: 3.00 |")
    assert sentences[0].startswith(
        "predicted types: other grips than with all types in 2 of 2 plans"
    )


def test_savings_are_those_of_plans_that_differ():
    plans = table()
    everywhere = savings(plans)
    # 24 tests of 4 and of 8 valid grasps; each object alone makes the same difference.
    assert everywhere.loc[PREDICTED].tolist() == pytest.approx([2, 2, 6 - 3, 0])
    assert everywhere.loc[LABELLED, "saving"] == pytest.approx(24 / 6 - 24 / 8)
    chosen = (plans.object == "mug") & (plans.choice == PREDICTED)
    plans.loc[chosen, "types"] = "; ".join(GRASP_TYPES[:-1])
    alone = savings(plans).loc[PREDICTED]
    assert (alone["plans"], alone["saving"]) == (1, 3)
    assert np.isnan(alone["error"])


def test_the_error_of_a_saving_is_that_of_a_mean_over_objects():
    plans = table()
    tests = {("apple", PREDICTED): 8, ("mug", PREDICTED): 16}
    for (name, choice), count in tests.items():
        plans.loc[(plans.object == name) & (plans.choice == choice), "tests"] = count
    # 4 and 8 tests a valid grasp, 3 with all types: 1 and 5, whose mean has the error 2.
    assert savings(plans).loc[PREDICTED, ["saving", "error"]].tolist() == pytest.approx([3, 2])


def test_general_chooses_what_is_more_likely_than_not():
    occurs = [0.9, 0.6, 0.4, 0.1, 0.1, 0.1]
    row = {"object": "mug", "task": "use", **dict(zip(OCCURS, occurs, strict=True))}
    row |= dict.fromkeys(SHARES, 1 / 6)
    rows = [
        row | {"shown": shown, "model": model}
        for shown, model in (("objects", VIEWS_WITH_SIZE), ("kinds", VIEWS_WITH_SIZE))
    ]
    rows.append(row | {"shown": "objects", "model": "constant", "object": "cup"})
    assert held_out_types(pd.DataFrame(rows)) == {("mug", "use"): ["Large Wrap", "Medium Wrap"]}


def test_every_object_left_out_gets_types_for_every_task():
    problem = LearningProblem(
        "simulated", "task_vector", TASKS, examples("task_vector"), SETTINGS, None, None
    )
    found = unseen_types(problem, seeds=1, seed=0)
    assert found.keys() == {(name, task) for name in OBJECTS for task in TASKS}
    for types in found.values():
        assert types
        assert set(types) <= set(GRASP_TYPES[:-1])
    assert unseen_types(problem, seeds=1, seed=0) == found
