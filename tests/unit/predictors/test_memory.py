"""What was learned is recognised and answered from memory; everything else is left to the head."""

from dataclasses import replace

import numpy as np
import pytest
from tests.unit.settings import PARAMS

from grasptypes.predictors.general_inputs import Inputs, Targets
from grasptypes.predictors.memory import Memory

NAMES = np.array(["bead", "rope", "vase"])
TASKS = np.array([[-1.0], [1.0]])
VIEWS = 6
SETTINGS = PARAMS.general.head.memory.changed(last_features=4, size_spread=0.1, mass_spread=0.3)
# The features of images of each object; the first one says nothing.
LOOKS = np.array([[7.0, 1, 0, 0, 1], [-7, 5, 0, 0, 0], [0, 0, 5, 0, 0]])
# Probability of the types by the head.
OCCURS, SHARES = np.array([[0.5, 0.5, 0.5]]), np.array([[0.2, 0.3, 0.5]])


def facts_of(number):
    return np.array([-2.0, -2.5, -3.0, -1.0]) + number


@pytest.fixture(scope="module")
def memory():
    """Three objects that look different; each has a type of its own. Nobody has used the vase."""
    random = np.random.default_rng(0)
    object_, task = (each.ravel() for each in np.meshgrid(range(3), range(2), indexing="ij"))
    known = ~((object_ == 2) & (task == 0))
    object_, task = np.repeat(object_[known], VIEWS), np.repeat(task[known], VIEWS)
    features = LOOKS[object_] + random.normal(0, 0.1, size=(len(object_), LOOKS.shape[1]))
    inputs = Inputs(
        features,
        np.zeros((len(features), 0)),
        np.stack([facts_of(number) for number in object_]),
        TASKS[task],
        np.ones(len(features)),
    )
    types = np.eye(3)[object_]
    return Memory.of(inputs, Targets(types, types, np.ones(len(types)), NAMES[object_]), SETTINGS)


def asked(shown, facts, task):
    inputs = LOOKS[[shown]], np.zeros((1, 0)), np.array([facts]), np.array([task])
    return Inputs(*inputs, np.ones(1))


def test_an_image_tells_which_object_it_may_be_and_the_size_whether_it_is_one(memory):
    nothing = np.full(4, np.nan)
    unknown, right, wrong = (
        memory.chances(LOOKS[[1]], facts[None])[0] for facts in (nothing, facts_of(1), facts_of(9))
    )
    assert unknown[:3].argmax() == right[:3].argmax() == 1
    assert unknown[-1] == pytest.approx(1 - SETTINGS.known)
    assert right[-1] < 0.1
    assert wrong[-1] > 0.99
    only_longest = np.array([facts_of(1)[0], *nothing[1:]])
    partly = memory.chances(LOOKS[[1]], only_longest[None])[0]
    assert right[-1] < partly[-1] < unknown[-1]


def test_several_images_tell_more_than_one_and_less_than_independent_ones(memory):
    looks = np.array([[0, 1.0, 0.97, 0, 0]])
    nothing = np.full((1, 4), np.nan)
    one, four = (memory.chances(looks, nothing, np.array([count]))[0] for count in (1, 4))
    alone = memory.settings.changed(images_power=1.0)
    independent = replace(memory, settings=alone).chances(looks, nothing, np.array([4]))[0]
    assert one[:3].max() < four[:3].max() < independent[:3].max()
    assert one[-1] == pytest.approx(four[-1])


def test_images_of_an_object_are_asked_about_together():
    rows = Inputs(
        np.array([[1.0], [5.0], [3.0]]),
        np.zeros((3, 0)),
        np.stack([facts_of(2), facts_of(1), facts_of(2)]),
        TASKS[[0, 0, 0]],
        np.ones(3),
    ).together(np.array(["b", "a", "b"]))
    np.testing.assert_array_equal(rows.features, [[5], [2]])
    np.testing.assert_array_equal(rows.images, [1, 2])
    np.testing.assert_array_equal(rows.facts, [facts_of(1), facts_of(2)])


def test_what_is_recognised_is_answered_from_memory(memory):
    occurs, shares = memory.mixed(OCCURS, SHARES, asked(1, facts_of(1), TASKS[0]))
    assert occurs[0, 1] > 0.9
    assert shares.sum() == pytest.approx(1)
    occurs, shares = memory.mixed(OCCURS, SHARES, asked(1, facts_of(9), TASKS[0]))
    np.testing.assert_allclose([occurs, shares], [OCCURS, SHARES], atol=0.02)


def test_other_tasks_and_unlabelled_objects_are_left_to_the_head(memory):
    asked_for = asked(1, facts_of(1), [0.3])
    np.testing.assert_array_equal(memory.mixed(OCCURS, SHARES, asked_for)[0], OCCURS)
    occurs, _ = memory.mixed(OCCURS, SHARES, asked(2, facts_of(2), TASKS[0]))
    assert np.isfinite(occurs).all()
    assert occurs[0, 2] < 0.6


def test_one_image_of_each_object_is_enough():
    facts = np.stack([facts_of(number) for number in range(3)])
    inputs = Inputs(LOOKS, np.zeros((3, 0)), facts, TASKS[[0, 0, 0]], np.ones(3))
    memory = Memory.of(inputs, Targets(np.eye(3), np.eye(3), np.ones(3), NAMES), SETTINGS)
    chances = memory.chances(LOOKS, facts)
    assert np.isfinite(chances).all()
    assert list(chances.argmax(axis=1)) == [0, 1, 2]
