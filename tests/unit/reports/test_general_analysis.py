"""What limits the predictor for unseen objects: agreement of labels, confusions, worst answers."""

import pandas as pd
import pytest

from grasptypes.labels.samples import COUNTS, TYPES, samples_from_counts
from grasptypes.predictors.general_protocol import OCCURS
from grasptypes.reports.general_analysis import (
    CONFUSION_SCHEMA,
    HALVES,
    LIMIT_SCHEMA,
    confusion_rows,
    halves,
    limit_row,
    looked_at,
    touched_role,
)
from grasptypes.settings.tasks import read_tasks

DATASET = pd.DataFrame(
    [
        {"Object": name, "Intent": "use", "Session": session, "GraspType": kind}
        for name, kinds in (
            ("bead", ["Precision"] * 4),
            ("rope", ["Small Wrap", "Precision"] * 2),
            ("sieve", ["Small Wrap", "Invalid"] * 2),
        )
        for session, kind in enumerate(kinds, start=1)
    ]
)
WHERE = {"shown": "kinds", "labels": "simulated", "answer": HALVES}


def test_halves_agree_where_sessions_are_alike():
    odd, even = halves(DATASET)
    assert list(odd["object"]) == list(even["object"]) == ["bead", "rope"]
    alike, unlike = (
        limit_row(odd[odd["object"] == name], even[even["object"] == name], WHERE, sets=False)
        for name in ("bead", "rope")
    )
    assert alike["similarity"] == pytest.approx(1)
    assert unlike["similarity"] == pytest.approx(0)
    LIMIT_SCHEMA.validate(pd.DataFrame([limit_row(odd, even, WHERE, sets=True)]))


def test_confusions_count_what_was_found_and_what_was_right():
    counts = [
        dict.fromkeys(COUNTS, 0) | {COUNTS[0]: 20},
        dict.fromkeys(COUNTS, 0) | {COUNTS[1]: 20},
    ]
    named = [{"object": f"thing{n}", "task": "use", **row} for n, row in enumerate(counts)]
    scored = samples_from_counts(pd.DataFrame(named)).assign(
        similarity=[1.0, 0.0], **{name: 0.1 for name in OCCURS}
    )
    scored[OCCURS[0]] = 0.9
    table = pd.DataFrame(confusion_rows(scored, ["handle", "bail"]))
    CONFUSION_SCHEMA.validate(table)
    row = table.set_index(["by", "name"]).loc[("type", TYPES[0])]
    assert (row.found, row.right, row.similarity) == (1, 0.5, 1)
    assert table.set_index("name").similarity["bail"] == 0


def test_worst_answers_come_first_and_objects_only_once():
    scored = pd.DataFrame(
        {
            "object": ["a", "a", "b", "c", "d"],
            "task": ["use", "handoff", "use", "use", "use"],
            "similarity": [0.1, 0.2, 0.3, 0.5, 0.9],
        }
    )
    worst, rest = looked_at(scored, 2)
    assert list(worst["object"]) == ["a", "b"]
    assert list(rest["object"]) == ["c", "d"]


def test_the_touched_role_is_what_people_touch_most():
    assert touched_role(["working_end", "handle"], read_tasks()["use"]) == "handle"
