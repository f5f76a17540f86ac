"""Readers of an option's text: a value, or an error that says what is allowed and what came."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from math import isfinite
from typing import Any

Reader = Callable[[str], Any]
"""Reads an option's text; its docstring says what is allowed."""


def value(allowed: str, read: Callable[[str], Any], accept: Callable[[Any], bool]) -> Reader:
    """Return a reader by `read`, which may raise ValueError, of the values that `accept` takes."""

    def convert(text: str) -> Any:
        try:
            found = read(text)
        except ValueError:
            found = None
        if found is None or not accept(found):
            raise argparse.ArgumentTypeError(f"must be {allowed}, got '{text}'.")
        return found

    convert.__doc__ = allowed  # quoted when the value is missing
    return convert


def whole(low: int, high: int) -> Reader:
    """Return a reader of whole numbers in [low, high]."""
    return value(f"a whole number from {low} to {high}", int, lambda n: low <= n <= high)


def number(allowed: str, accept: Callable[[float], bool]) -> Reader:
    """Return a reader of a finite number."""
    return value(allowed, float, lambda x: isfinite(x) and accept(x))


def numbers(
    names: str, rule: str = "", accept: Callable[[list[float]], bool] = lambda _: True
) -> Reader:
    """Return a reader of finite numbers separated by commas, as many as there are names."""
    count = names.count(",") + 1
    return value(
        f"{count} numbers {names} separated by commas{rule}",
        lambda text: [float(part) for part in text.split(",")],
        lambda xs: len(xs) == count and all(map(isfinite, xs)) and accept(xs),
    )


def named_numbers(
    form: str, names: tuple[str, ...], accept: Callable[[dict[str, float]], bool]
) -> Reader:
    """Return a reader of `NAME=NUMBER,...` with each of the names once, in any order."""

    def read(text: str) -> dict[str, float]:
        pairs = [part.split("=") for part in text.split(",")]
        if sorted(pair[0].strip() for pair in pairs) != sorted(names):
            raise ValueError
        return {name.strip(): float(number) for name, number in pairs}

    return value(form, read, lambda xs: all(map(isfinite, xs.values())) and accept(xs))


def text(allowed: str) -> Reader:
    """Return a reader of any text that is not empty and that a file's name may hold."""
    return value(allowed, str, lambda found: bool(found) and "\0" not in found)
