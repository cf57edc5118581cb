"""The head for unseen objects: it learns size, falls back on the mean answer, and is calibrated."""

from dataclasses import replace

import numpy as np
import pandas as pd
import pytest
from tests.unit.settings import PARAMS

from grasptypes.errors import InputError
from grasptypes.labels.samples import COUNTS, samples_from_counts
from grasptypes.predictors.families import family_folds
from grasptypes.predictors.general import fit_head, probabilities
from grasptypes.predictors.general_examples import Known
from grasptypes.predictors.general_inputs import FACTS, Pictures, TaskCode
from grasptypes.predictors.general_protocol import (
    ANSWER_SCHEMA,
    CONSTANT,
    IMAGE,
    KINDS,
    SIZE_ONLY,
    VIEWS_WITH_SIZE,
    WITH_SIZE,
    hold_out_kinds,
)
from grasptypes.reports.general_trials import TRIAL_SCHEMA, draw_curve, try_settings
from grasptypes.reports.table3 import TABLE_SCHEMA, markdown, tabulate
from grasptypes.settings.general import GeneralSettings
from grasptypes.settings.tasks import read_tasks

MEMORY = PARAMS.general.head.memory.changed(last_features=0)
HEAD = PARAMS.general.head.changed(pictures=4, classes=3, weight_decay=0.003, memory=MEMORY)
TASKS = {name: read_tasks()[name] for name in ("use", "handoff")}
NUMBER, VIEWS = 40, 3


@pytest.fixture(scope="module")
def known():
    """Objects whose types follow from their size, and for handoff are all the same."""
    random = np.random.default_rng(0)
    names = [f"thing{number}" for number in range(NUMBER)]
    sizes = np.linspace(-4, -1, NUMBER)
    facts = pd.DataFrame(
        np.column_stack([sizes, sizes - 0.3, sizes - 0.6, 3 * sizes]), names, list(FACTS)
    )
    rows = []
    for name, size in zip(names, sizes, strict=True):
        used = [0, 0, 0, 0, 0, 20] if size < -2.5 else [20, 0, 0, 0, 0, 0]
        for task, counts in (("use", used), ("handoff", [0, 0, 0, 10, 10, 0])):
            rows.append({"object": name, "task": task, **dict(zip(COUNTS, counts, strict=True))})
    shown = NUMBER * VIEWS
    pictures = Pictures(
        np.repeat(names, VIEWS), random.normal(size=(shown, 6)), random.normal(size=(shown, 5))
    )
    families = {name: frozenset([f"family{number // 2}"]) for number, name in enumerate(names)}
    return Known(pictures, facts, samples_from_counts(pd.DataFrame(rows)), families, TASKS)


@pytest.fixture(scope="module")
def answers(known):
    return hold_out_kinds(known, HEAD, 4, 0)


def test_heads_learn_what_size_tells(known, answers):
    ANSWER_SCHEMA.validate(answers)
    table = tabulate(answers, {"simulated": known.samples}, [], 10)
    TABLE_SCHEMA.validate(table)
    row = table.set_index("model")
    assert row.similarity[SIZE_ONLY] > row.similarity[CONSTANT] + 0.1
    assert row.similarity[VIEWS_WITH_SIZE] > row.similarity[IMAGE] + 0.1
    assert row.over_constant[CONSTANT] == 0
    assert row.calibration_error[SIZE_ONLY] < 0.15
    assert markdown(table).count("\n") > len(table)


def test_without_evidence_the_answer_is_the_mean(known):
    code = TaskCode.of(TASKS)
    inputs, targets = known.examples(code)
    head = fit_head(inputs, targets, HEAD.changed(weight_decay=10_000.0))
    occurs, shares = probabilities(head.logits(inputs))
    np.testing.assert_allclose(occurs, np.tile(targets.occurs.mean(0), (len(inputs), 1)), atol=0.02)
    np.testing.assert_allclose(shares, np.tile(targets.shares.mean(0), (len(inputs), 1)), atol=0.02)


def test_relatives_are_never_learned_from(known, answers):
    for fold in family_folds(known.families, 4, 0):
        left = known.without(fold)
        assert not {family for name in left.facts.index for family in known.families[name]} & fold
    one = answers[answers["model"] == WITH_SIZE]
    assert len(one) == NUMBER * VIEWS * len(TASKS)


def test_a_new_task_has_coordinates_between_those_learned():
    code = TaskCode.of(TASKS)
    use, handoff = (code(task)[0] for task in TASKS.values())
    assert use == pytest.approx(-handoff)
    assert abs(code(read_tasks()["stow"])[0]) < 3 * abs(use)


def test_images_may_be_missing_for_no_label(known):
    blind = Known(known.pictures.of(["thing1"]), known.facts, known.samples, known.families, TASKS)
    with pytest.raises(InputError, match="thing0"):
        blind.examples(TaskCode.of(TASKS))


def test_trials_change_one_setting_at_a_time(known):
    settings = PARAMS.general.changed(
        head=HEAD,
        trials={"kinds": (4, 40), "facts": (False,), "backbone": ("mobilenet_v2",)},
        protocol=PARAMS.general.protocol.changed(folds=2),
    )
    telling = known.facts.loc[known.pictures.objects].to_numpy()
    others = {"mobilenet_v2": replace(known.pictures, features=telling)}
    table = try_settings(known, others, settings, 0)
    TRIAL_SCHEMA.validate(table)
    row = table[table["shown"] == KINDS].set_index(["setting", "value", "model"])
    few, many, blind = (
        row.loc[(*key, WITH_SIZE)] for key in (("kinds", "4"), ("kinds", "40"), ("facts", "False"))
    )
    assert few.learned == 4
    assert few.similarity < many.similarity
    assert blind.similarity < many.similarity
    told, untold = (
        row.loc[(*key, IMAGE)] for key in (("backbone", "mobilenet_v2"), ("kinds", "40"))
    )
    assert told.similarity > untold.similarity + 0.1
    assert len(draw_curve(table).axes[0].lines) >= 4


def test_an_impossible_trial_is_named():
    with pytest.raises(InputError, match=r"trials.weight_decay.1: -1"):
        GeneralSettings.check(
            PARAMS.general.model_dump() | {"trials": {"weight_decay": [0.1, -1.0]}}
        )
    with pytest.raises(InputError, match=r"trials.backbone.0: vgg16"):
        GeneralSettings.check(PARAMS.general.model_dump() | {"trials": {"backbone": ["vgg16"]}})
