"""The three measures are measures: bounded, one for equals, blind to the order of types."""

import numpy as np
from examples_of import numbers
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from grasptypes.predictors.metrics import (
    angular_similarity,
    multilabel_accuracy,
    multilabel_precision,
)

TYPES = 6
# Six numbers, not all tiny: a direction.
VECTORS = numbers(0, 10, (4, TYPES)).filter(lambda v: (v.max(axis=1) > 1e-6).all())
SETS = arrays(bool, (4, TYPES))
LOGITS = numbers(-50, 50, (4, TYPES))
ORDERS = st.permutations(range(TYPES))


@given(VECTORS, VECTORS, VECTORS)
def test_angles_are_distances(a, b, c):
    ab, bc, ac = (angular_similarity(*pair) for pair in ((a, b), (b, c), (a, c)))
    for values in (ab, bc, ac):
        assert ((values >= -1e-12) & (values <= 1)).all()
    np.testing.assert_allclose(angular_similarity(b, a), ab, atol=1e-12)
    assert (1 - ac <= (1 - ab) + (1 - bc) + 1e-9).all()


@given(VECTORS, VECTORS, ORDERS, st.floats(1e-3, 1e3))
def test_neither_length_nor_order_counts(a, b, order, factor):
    same = angular_similarity(a, b)
    np.testing.assert_allclose(angular_similarity(a * factor, b), same, atol=1e-9)
    np.testing.assert_allclose(angular_similarity(a[:, order], b[:, order]), same, atol=1e-9)
    np.testing.assert_allclose(angular_similarity(a, a * factor), 1, atol=1e-7)


@given(SETS, SETS)
def test_sets_are_compared_within_bounds(a, b):
    accuracy, precision = multilabel_accuracy(a, b), multilabel_precision(a, b)
    assert ((accuracy >= 0) & (accuracy <= precision) & (precision <= 1)).all()
    np.testing.assert_array_equal(multilabel_accuracy(b, a), accuracy)
    equal = (a == b).all(axis=1)
    np.testing.assert_array_equal(accuracy == 1, equal)
    # All that is predicted is right, and something is, unless there is nothing to predict.
    right = ~(a & ~b).any(axis=1) & (a.any(axis=1) | equal)
    np.testing.assert_array_equal(precision == 1, right)
