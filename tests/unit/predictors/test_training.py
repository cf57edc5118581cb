"""Training: it learns what can be learnt, and the same from the same seed."""

import learning
import numpy as np
import pytest

from grasptypes.predictors.members import Member, members_by_group
from grasptypes.predictors.scoring import score
from grasptypes.predictors.training import fit, predict

KEY = ("predictor", "test")


def trained(model, settings=learning.SETTINGS, seeds=1):
    examples = learning.examples(model)
    members = members_by_group(examples.index["fold"], seeds)
    heads, curves = fit(examples, members, settings, KEY)
    logits = [predict(heads, k, examples, member.test) for k, member in enumerate(members)]
    return score(examples, members, logits)[0], curves, logits


def test_members_are_every_group_and_seed():
    members = members_by_group([0, 0, 1, 2], 2)
    assert [(m.group, m.seed) for m in members] == [(g, s) for s in (0, 1) for g in ("0", "1", "2")]
    np.testing.assert_array_equal(members[0].train, [2, 3])
    np.testing.assert_array_equal(members[0].test, [0, 1])


@pytest.mark.parametrize("model", ["task_vector", "task_in_image", "ignores_task"])
def test_what_the_inputs_tell_is_learnt(model):
    metrics, curves, _ = trained(model)
    assert metrics["angular_similarity"].min() > 0.9
    assert metrics["multilabel_accuracy"].min() > 0.97
    assert curves[-1, :, 0].mean() < 0.7 * curves[0, :, 0].mean()
    assert np.isfinite(curves).all()


def test_an_estimator_learns_how_often_types_occur():
    metrics = trained("e_mobilenet_v2", learning.SETTINGS.changed(epochs=40))[0]
    assert metrics["frequency_similarity"].min() > 0.9
    sets = trained("ignores_task", learning.SETTINGS.changed(epochs=40))[0]
    assert metrics["frequency_similarity"].mean() > sets["frequency_similarity"].mean() + 0.05


def test_without_the_task_it_cannot_be_known():
    assert trained("no_task")[0]["multilabel_accuracy"].max() < 0.9


def test_the_same_again_and_another_seed_differs():
    quick = learning.SETTINGS.changed(epochs=2, dropout=0.2)
    first, again = trained("task_vector", quick, seeds=2), trained("task_vector", quick, seeds=2)
    np.testing.assert_array_equal(first[2], again[2])
    np.testing.assert_array_equal(first[1], again[1])
    assert not np.allclose(first[2][0], first[2][4])  # fold 0 of the two seeds


def test_splits_of_different_sizes_that_hold_fewer_examples_than_components():
    examples = learning.examples("ignores_task")
    members = [
        Member("0", 0, np.arange(0, 60, 6), np.arange(3)),
        Member("1", 0, np.arange(0, 60, 5), np.arange(2)),
    ]
    large = learning.SETTINGS.changed(components=500, batch=64, epochs=2)
    heads, curves = fit(examples, members, large, KEY)
    assert heads.architecture.inputs == 24
    assert np.isfinite(curves).all()
    assert predict(heads, 1, examples, np.arange(4)).shape == (4, 6)
    untested = Member("all", 0, np.arange(0, 80, 8), np.arange(0))
    assert np.isnan(fit(examples, [untested], large, KEY)[1][..., 1]).all()
