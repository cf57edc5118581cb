"""Expressions between dimensions: ordinary arithmetic, and nothing else."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from grasptypes.kinds.expressions import Expression, parse

POSITIVE = st.floats(0.001, 10)


def value(text: str, **names: float) -> float:
    parsed = parse(text)
    assert isinstance(parsed, Expression)
    return parsed.value(names)


@given(a=POSITIVE, b=POSITIVE)
def test_expressions_are_arithmetic(a, b):
    assert value("a + 2 * b - -a / b", a=a, b=b) == a + 2 * b - -a / b
    assert value("min(a, b) ** 2 + sqrt(max(a, b))", a=a, b=b) == min(a, b) ** 2 + max(a, b) ** 0.5


def test_angles_are_degrees():
    assert value("sin(30)") == pytest.approx(0.5)


@pytest.mark.parametrize(
    "text",
    ["a.real", "a[0]", "(lambda: 1)()", "open('x')", "a if b else c", "'x' * 9", "min(*a)", "True"],
)
def test_anything_but_arithmetic_is_rejected(text):
    with pytest.raises(ValueError, match="allowed"):
        parse(text)


@pytest.mark.parametrize("written", [True, None, [1], float("nan"), "1 +", "1" * 300])
def test_what_is_no_number_is_rejected(written):
    with pytest.raises(ValueError, match=r"number|longer"):
        parse(written)


@pytest.mark.parametrize("text", ["1 / (a - a)", "9 ** 999999.0", "sqrt(-a)", "(-a) ** 0.5", "b"])
def test_what_has_no_value_names_the_expression(text):
    with pytest.raises(ValueError, match="'"):
        value(text, a=1.0)
