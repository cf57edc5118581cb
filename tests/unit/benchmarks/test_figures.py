"""Values beside references."""

import numpy as np
import pytest
from benchmarks.figures import FIGURE_SCHEMA, figure, line, rates, seconds, table


def test_works_take_turns_and_the_warm_up_is_not_counted():
    calls: list[str] = []
    taken_s = seconds(lambda: calls.append("ours"), lambda: calls.append("theirs"), rounds=3)
    assert calls == ["ours", "theirs"] * 4
    assert taken_s.shape == (3, 2)
    assert (taken_s >= 0).all()
    assert seconds(calls.clear, rounds=2, warm_up=False).shape == (2, 1)


def test_the_ratio_is_that_of_the_rounds_even_if_one_was_disturbed():
    # The machine halved its pace in the second round and slept through the reference of the third.
    taken_s = np.array([[2.0, 1.0], [4.0, 2.0], [2.0, 9.0]])
    found = rates("x", "1/s", taken_s, done=10)
    assert found.value == pytest.approx(5.0)
    assert found.ratio == pytest.approx(0.5)


def test_the_table_has_what_was_measured_with_four_digits():
    found = FIGURE_SCHEMA.validate(table([figure("a", 1234567, "s", 3.0), figure("b", 1, "s", 8)]))
    assert found["value"].tolist() == [1235000.0, 1.0]
    assert found["ratio"].tolist() == [411500.0, 0.125]
    assert line(figure("a", 1234.5, "s", 0.5)).split() == ["a", "1,234", "s", "0.500", "2469.00"]
