"""Odd values as Python expressions, so that a case can be read and run again."""

from __future__ import annotations

from random import Random
from typing import Any

import numpy as np

NUMBERS = (
    "0", "-1", "1", "2", "0.5", "1e-9", "1e9", "1e10", "1e30", "1e308", "-1e308", "5e-324", "nan",
    "inf", "-inf", "10**400", "True", "1j", "np.float32(0.1)", "np.int8(3)", "np.float64('nan')",
    "2**31", "2**63", "2**64", "-0.0", "Fraction(1, 3)", "Decimal('0.1')", "1e5", "1e15",
)  # fmt: skip
OTHERS = (
    "None", "''", "'text'", "'left'", "'\\0'", "'x' * 5000", "b'bytes'", "[]", "()", "{}",
    "object()",
    "len", "int", "set()", "range(3)", "iter([1, 2])", "np.eye(4)", "np.zeros(0)",
    "lambda *a: None",
    "np.ma.masked", "slice(None)", "np.datetime64('2020')", "{'foot': 'left'}", "'1.0'",
    "'\\udcff'",
    "np.array([None])", "float", "Exception('x')", "type", "memoryview(b'abc')", "...",
)  # fmt: skip
SHAPES = ("(2,)", "(3,)", "(4, 4)", "(1,)", "(0, 3)", "(6,)", "(2, 2, 2)", "(50, 2)", "()")
KINDS = ("float", "int", "complex", "bool", "object", "'f4'", "'U3'", "'datetime64[s]'")


def draw_value(rng: Random, depth: int = 2) -> str:
    """Return an expression: a number, something else, an array, or a container of such."""
    kind = rng.random()
    if kind < 0.35 or depth == 0:
        return rng.choice(NUMBERS)
    if kind < 0.6:
        return rng.choice(OTHERS)
    if kind < 0.75:
        return f"np.full({rng.choice(SHAPES)}, {rng.choice(NUMBERS)})"
    if kind < 0.8:
        return f"np.zeros({rng.choice(SHAPES)}).astype({rng.choice(KINDS)})"
    items = [draw_value(rng, depth - 1) for _ in range(rng.randint(1, 4))]
    return f"({', '.join(items)},)" if kind < 0.9 else f"[{', '.join(items)}]"


def value_of(expression: str, **names: Any) -> Any:
    """Return the value of an expression of `draw_value`, with these names known."""
    from decimal import Decimal
    from fractions import Fraction

    known = {"np": np, "nan": np.nan, "inf": np.inf, "Fraction": Fraction, "Decimal": Decimal}
    return eval(expression, {**known, **names})
