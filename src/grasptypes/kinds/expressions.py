"""Arithmetic between the dimensions of a kind, such as `0.5 * diameter + wall`."""

from __future__ import annotations

import ast
import math
import operator
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

_OPERATORS: dict[type[ast.AST], Callable[..., float]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
    ast.Pow: operator.pow,
    ast.USub: operator.neg,
    ast.UAdd: operator.pos,
}
FUNCTIONS: dict[str, Callable[..., float]] = {
    "min": min,
    "max": max,
    "sqrt": math.sqrt,
    "sin": lambda angle_deg: math.sin(math.radians(angle_deg)),
    "cos": lambda angle_deg: math.cos(math.radians(angle_deg)),
    "tan": lambda angle_deg: math.tan(math.radians(angle_deg)),
}
# Longer ones are hard to read, and Python's parser is not made for deep ones.
LONGEST = 200


@dataclass(frozen=True)
class Expression:
    """A number that depends on dimensions; create it with :func:`parse`.

    Attributes:
        text: as written.
    """

    text: str

    def value(self, names: Mapping[str, float]) -> float:
        """The number for given dimensions.

        Raises:
            ValueError: an unknown name, or no real number, such as a division by zero.
        """
        try:
            number = _value(ast.parse(self.text, mode="eval").body, names)
        except (ArithmeticError, TypeError, ValueError) as error:
            raise ValueError(f"'{self.text}': {error}") from error
        if isinstance(number, complex) or not math.isfinite(number):
            raise ValueError(f"'{self.text}' is not a finite number")
        return float(number)


def parse(written: Any) -> float | Expression:
    """A number, or an expression of numbers, names, + - * / ** and :data:`FUNCTIONS`.

    Raises:
        ValueError: neither of them.
    """
    if isinstance(written, int | float) and not isinstance(written, bool):
        if not math.isfinite(written):
            raise ValueError(f"{written} is not a finite number")
        return float(written)
    if not isinstance(written, str):
        raise ValueError(f"{written!r} is neither a number nor an expression")
    if len(written) > LONGEST:
        raise ValueError(f"the expression is longer than {LONGEST} characters")
    try:
        _check(ast.parse(written, mode="eval").body)
    except (SyntaxError, ValueError, RecursionError, MemoryError) as error:
        said = error.msg if isinstance(error, SyntaxError) else error
        raise ValueError(f"'{written}' is neither a number nor an expression: {said}") from error
    return Expression(written)


def _check(node: ast.AST) -> None:
    """Reject what an expression must not contain."""
    match node:
        case ast.Constant(value=int() | float()) if not isinstance(node.value, bool):
            return
        case ast.Name():
            return
        case ast.BinOp(left=left, op=op, right=right) if type(op) in _OPERATORS:
            _check(left)
            _check(right)
        case ast.UnaryOp(op=op, operand=operand) if type(op) in _OPERATORS:
            _check(operand)
        case ast.Call(func=ast.Name(id=name), args=[_, *_], keywords=[]) if name in FUNCTIONS:
            for argument in node.args:
                _check(argument)
        case _:
            allowed = f"numbers, names, + - * / **, {', '.join(FUNCTIONS)}"
            raise ValueError(f"only {allowed} are allowed")


def _value(node: Any, names: Mapping[str, float]) -> float:
    match node:
        case ast.Constant(value=int() | float() as number):
            return float(number)
        case ast.Name(id=name):
            if name not in names:
                known = ", ".join(names) or "none"
                raise ValueError(f"there is no dimension '{name}'; known: {known}")
            return names[name]
        case ast.BinOp(left=left, op=op, right=right):
            return _OPERATORS[type(op)](_value(left, names), _value(right, names))
        case ast.UnaryOp(op=op, operand=operand):
            return _OPERATORS[type(op)](_value(operand, names))
        case _:
            return FUNCTIONS[node.func.id](*(_value(argument, names) for argument in node.args))
