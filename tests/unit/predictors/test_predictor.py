"""BatchedMLP: four layers, the task at the second, and many side by side."""

from dataclasses import replace

import numpy as np
import pytest
import torch
from scipy.special import softmax

from grasptypes.predictors.predictor import LAYERS, Architecture, BatchedMLP, loss

SIZES = Architecture(inputs=10, tasks=3, hidden=(8, 7, 5), outputs=6)


@pytest.mark.parametrize("layer", [1, 2, 3, 4])
def test_the_task_can_join_at_any_layer(layer):
    heads = BatchedMLP(replace(SIZES, task_layer=layer), [("a",), ("b",)]).eval()
    plain = replace(SIZES, tasks=0).shapes()
    wider = [a[0] - b[0] for a, b in zip(heads.architecture.shapes(), plain, strict=True)]
    assert wider == [3 * (number == layer) for number in (1, 2, 3, 4)]
    x, tasks = torch.randn(2, 3, 20), torch.eye(3).expand(2, -1, -1)
    centre, projection = torch.randn(2, 1, 20), torch.randn(2, 20, 10)
    expected = heads((x - centre) @ projection, tasks)
    answers = heads.absorb(centre, projection)(x, tasks)
    torch.testing.assert_close(answers, expected, rtol=1e-4, atol=1e-4)
    same = x[:, :1].expand(-1, 3, -1)  # one image for three tasks
    assert not torch.allclose(heads.absorb(centre, projection)(same, tasks)[:, 0], answers[:, 1])


def test_the_head_has_four_layers_and_the_task_joins_at_the_second():
    assert SIZES.shapes() == [(10, 8), (11, 7), (7, 5), (5, 6)]
    heads = BatchedMLP(SIZES, [("a",), ("b",)])
    assert len(heads.weights) == LAYERS == 4
    assert heads(torch.zeros(2, 9, 10), torch.zeros(2, 9, 3)).shape == (2, 9, 6)


def test_a_head_side_by_side_is_the_head_alone():
    x, t = torch.randn(1, 9, 10), torch.randn(1, 9, 3)
    both = BatchedMLP(SIZES, [("a",), ("b",)]).eval()(x.expand(2, -1, -1), t.expand(2, -1, -1))
    alone = BatchedMLP(SIZES, [("b",)]).eval()(x, t)
    torch.testing.assert_close(both[1], alone[0])
    assert not torch.allclose(both[0], both[1])


def test_dropout_of_a_head_is_its_own():
    x, t = torch.randn(1, 9, 10), torch.randn(1, 9, 3)
    both = BatchedMLP(SIZES, [("a",), ("b",)], 0.5).train()(
        x.expand(2, -1, -1), t.expand(2, -1, -1)
    )
    alone = BatchedMLP(SIZES, [("b",)], 0.5).train()
    first, second = alone(x, t)[0], alone(x, t)[0]
    torch.testing.assert_close(both[1], first)
    assert not torch.allclose(first, second)
    assert not torch.allclose(first, alone.eval()(x, t)[0])


def test_absorbing_a_projection_changes_no_output():
    heads = BatchedMLP(SIZES, [("a",), ("b",)]).eval()
    x, t = torch.randn(2, 9, 20), torch.randn(2, 9, 3)
    centre, projection = torch.randn(2, 1, 20), torch.randn(2, 20, 10)
    wide = heads.absorb(centre, projection)
    expected = heads((x - centre) @ projection, t)
    torch.testing.assert_close(wide(x, t), expected, rtol=1e-4, atol=1e-4)
    assert wide.architecture.inputs == 20


def test_loss_by_hand():
    logits = np.array([1.0, -2.0])
    labels, probabilities = np.array([1.0, 0.0]), np.array([1.0, 0.0])
    binary = (np.log1p(np.exp(-1.0)) + np.log1p(np.exp(-2.0))) / 2
    vector = -np.log(softmax(logits, axis=-1)[0])
    value = loss(*(torch.tensor(x) for x in (logits, labels, probabilities)), 3.0)
    assert value.item() == pytest.approx(binary + 3 * vector)
