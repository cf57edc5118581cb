"""What each variant sees and answers."""

import learning
import numpy as np
import pytest

from grasptypes.errors import InputError
from grasptypes.labels.samples import COUNTS, LABELS
from grasptypes.predictors.examples import assemble
from grasptypes.predictors.variants import VARIANTS


def row_of(examples, **where):
    table = examples.index
    mask = np.logical_and.reduce([table[key] == value for key, value in where.items()])
    return int(np.flatnonzero(mask)[0])


def test_the_task_is_in_the_picture_or_in_the_vector_or_nowhere():
    inputs = learning.features()
    for model, encoding in [
        ("no_task", "none"),
        ("task_vector", "none"),
        ("task_in_image", "show"),
    ]:
        examples = learning.examples(model)
        row = row_of(examples, object="mug", view=7, task="show")
        np.testing.assert_array_equal(examples.inputs[row], inputs["mug"][encoding][7])
        assert (examples.task_vectors is not None) == (model == "task_vector")
    vectors = learning.examples("task_vector").task_vectors
    assert vectors is not None
    np.testing.assert_array_equal(vectors[row], [0, 0, 1])
    assert len(vectors) == 4 * 20 * 3


def test_labels_are_those_of_object_and_task():
    examples = learning.examples("no_task")
    table = learning.samples().set_index(["object", "task"])
    row = row_of(examples, object="pan", view=0, task="handoff")
    expected = table.loc[("pan", "handoff"), list(LABELS)].to_numpy(float)
    np.testing.assert_array_equal(examples.labels[row], expected)
    np.testing.assert_allclose(examples.probabilities[row], expected / expected.sum())


def test_joint_labels_hold_the_types_of_all_tasks():
    examples = learning.examples("ignores_task")
    assert len(examples.inputs) == 4 * 20
    table = learning.samples().set_index("object")
    union = table.loc["knife", list(LABELS)].max().to_numpy(float)
    np.testing.assert_array_equal(examples.labels[row_of(examples, object="knife")], union)


def test_frequencies_are_shares_of_the_grasps_and_only_learnt_where_asked():
    counts = learning.samples().set_index("object").loc["knife", list(COUNTS)].sum().to_numpy(float)
    for model in ("ignores_task", "e_mobilenet_v2"):
        examples = learning.examples(model)
        row = row_of(examples, object="knife")
        np.testing.assert_allclose(examples.frequencies[row], counts / counts.sum(), rtol=1e-6)
        learnt = counts if model == "e_mobilenet_v2" else counts > 0
        np.testing.assert_allclose(examples.probabilities[row], learnt / learnt.sum(), rtol=1e-6)
        np.testing.assert_array_equal(examples.labels[row], counts > 0)
    alone = learning.examples("no_task")
    table = learning.samples().set_index(["object", "task"])
    numbers = table.loc[("knife", "show"), list(COUNTS)].to_numpy(float)
    row = row_of(alone, object="knife", task="show")
    np.testing.assert_allclose(alone.frequencies[row], numbers / numbers.sum(), rtol=1e-6)


def test_what_is_missing_is_named():
    inputs, samples, folds = learning.features(), learning.samples(), learning.folds()
    variant, tasks = VARIANTS["task_in_image"], list(learning.TASKS)
    without_label = samples.query("not (object == 'mug' and task == 'show')")
    with pytest.raises(InputError, match="samples: mug, show"):
        assemble(variant, inputs, without_label, folds, tasks)
    with pytest.raises(InputError, match=r"mug\.npz: use: 19 images"):
        assemble(
            variant, inputs | {"mug": {"use": inputs["mug"]["use"][:19]}}, samples, folds, tasks
        )
    with pytest.raises(InputError, match=r"mug\.npz: use: .*missing"):
        assemble(variant, inputs | {"mug": {}}, samples, folds, tasks)
    with pytest.raises(InputError, match="mug"):
        assemble(variant, {k: v for k, v in inputs.items() if k != "mug"}, samples, folds, tasks)
