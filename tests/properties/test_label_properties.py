"""The labelling rule gives every grasp one type, the same in any unit and order."""

import numpy as np
import pandas as pd
from examples_of import numbers
from hypothesis import given
from hypothesis import strategies as st
from tests.unit.barrett import BARRETT

from grasptypes.labels.contacts import Contacts
from grasptypes.labels.grasp_type import (
    GRASP_TYPES,
    Measures,
    classify,
    explain,
    fingertip_span,
    sideways_share,
)
from grasptypes.labels.samples import COUNTS, LABELS, PROBABILITIES, samples_from_counts
from grasptypes.settings.grasp_types import Thresholds

LINKS = len(BARRETT.link_names)


@st.composite
def measured(draw, count=8):
    """Thresholds, and measures some of which lie exactly on them."""
    thresholds = draw(numbers(0.01, 0.2, 4))
    values = draw(numbers(-0.01, 0.3, (count, 4)))
    exact = draw(st.lists(st.booleans(), min_size=4 * count, max_size=4 * count))
    values = np.where(np.reshape(exact, values.shape), thresholds, values)
    return Measures(*values.T), thresholds


@st.composite
def contacts(draw, count=3):
    """Contacts of any kind."""
    vectors = [draw(numbers(-1, 1, (count, LINKS, 3))) for _ in range(3)]
    lengths = [np.linalg.norm(v, axis=-1, keepdims=True) for v in vectors]
    units = [v / np.where(n > 0, n, 1) for v, n in zip(vectors, lengths, strict=True)]
    gap, weight = draw(numbers(-0.01, 0.1, (count, LINKS))), draw(numbers(0, 1, (count, LINKS)))
    return Contacts(gap, vectors[0], units[1], units[2], weight)


def by_hand(palm, small, sideways, span, at):
    """The tree of docs/grasp_types.md, one grasp at a time."""
    if palm <= at[0]:
        if small <= at[1]:
            return "Small Wrap"
        if sideways > at[2]:
            return "Power Sphere"
        return "Large Wrap" if span > at[3] else "Medium Wrap"
    return "Precision Sphere" if sideways > at[2] else "Precision"


@given(measured())
def test_every_grasp_has_the_type_its_thresholds_say(drawn):
    measures, thresholds = drawn
    types = [GRASP_TYPES[index] for index in classify(measures, thresholds)]
    assert types == [by_hand(*values, thresholds) for values in zip(*measures, strict=True)]
    assert "Invalid" not in types


@given(measured())
def test_explanations_agree_with_the_types_and_measure_the_margin(drawn):
    measures, thresholds = drawn
    named = Thresholds(**dict(zip(Thresholds.model_fields, thresholds.tolist(), strict=True)))
    types = classify(measures, thresholds)
    for label, index in zip(explain(measures, named), types, strict=True):
        assert label.grasp_type == GRASP_TYPES[index]
        assert label.margin >= 0
        assert label.virtual_fingers == (3 if "Sphere" in label.grasp_type else 2)


@given(measured(), st.integers(-8, 8))
def test_the_unit_of_length_does_not_count(drawn, power):
    measures, thresholds = drawn
    factors = [2.0**power, 2.0**power, 1.0, 2.0**power]  # exact, and the share has no unit
    scaled = Measures(*(m * f for m, f in zip(measures, factors, strict=True)))
    limits = thresholds * factors
    np.testing.assert_array_equal(classify(scaled, limits), classify(measures, thresholds))


@given(measured(), st.permutations(range(8)))
def test_the_order_of_grasps_does_not_count(drawn, order):
    measures, thresholds = drawn
    shuffled = Measures(*(values[order] for values in measures))
    np.testing.assert_array_equal(
        classify(shuffled, thresholds), classify(measures, thresholds)[order]
    )


@given(contacts(), st.floats(0.1, 10), st.permutations(BARRETT.finger_links))
def test_shares_are_shares_whatever_the_force_and_the_finger(drawn, factor, order):
    share = sideways_share(BARRETT, drawn)
    assert ((share >= 0) & (share <= 1 + 1e-12)).all()
    stronger = drawn._replace(weight=drawn.weight * factor)
    np.testing.assert_allclose(sideways_share(BARRETT, stronger), share, atol=1e-12)
    weight, push = drawn.weight.copy(), drawn.push.copy()
    weight[:, list(BARRETT.finger_links)] = drawn.weight[:, order]
    push[:, list(BARRETT.finger_links)] = drawn.push[:, order]
    swapped = drawn._replace(weight=weight, push=push)
    np.testing.assert_allclose(sideways_share(BARRETT, swapped), share, atol=1e-12)


@given(contacts(), st.integers(-8, 8))
def test_spans_grow_with_the_hand(drawn, power):
    larger = drawn._replace(position_m=drawn.position_m * 2.0**power)
    np.testing.assert_allclose(
        fingertip_span(BARRETT, larger), fingertip_span(BARRETT, drawn) * 2.0**power
    )


@given(st.lists(st.integers(0, 20), min_size=6, max_size=6).filter(any), st.integers(2, 9))
def test_samples_tell_which_types_occur_not_how_often(counts, factor):
    def sample(numbers):
        row = {"object": "mug", "task": "use", **dict(zip(COUNTS, numbers, strict=True))}
        return samples_from_counts(pd.DataFrame([row])).iloc[0]

    one, more = sample(counts), sample([factor * count for count in counts])
    names = [*LABELS, *PROBABILITIES]
    assert one[names].tolist() == more[names].tolist()
    assert [bool(v) for v in one[list(LABELS)]] == [count > 0 for count in counts]
    assert abs(sum(one[list(PROBABILITIES)]) - 1) < 1e-12
    assert (one.n_valid, more.n_valid) == (sum(counts), factor * sum(counts))
