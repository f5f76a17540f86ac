"""Readers of the arguments of public calls: each returns the plain value or says what came.

Each takes the value that came, the name of the argument and, for a number, its unit or meaning, and
raises `InvalidInput` with one sentence and that name. What passes is a finite number
of a size that arithmetic can bear, so nothing behind them overflows or divides by zero.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from math import degrees, isfinite, nan
from numbers import Integral, Real
from typing import Any, TypeVar

import numpy as np

from preview_walk.errors import InvalidInput
from preview_walk.types import FEET, Array, Foot

LARGEST, SMALLEST = 1e9, 1e-9
"""Sizes (m, s, rad) larger than the first, and positive ones smaller than the second, are refused:
their products and quotients would leave the range of a float."""

MOST = 100_000
"""Steps of a walk, and the like, are at most this many: a day of walking."""

LARGEST_SEED = 2**63 - 1
"""Seeds of random numbers are at most this, which every file format holds."""

MOST_SAMPLES = 10_000_000
"""Sampled references have at most this many rows: beyond it the memory of a laptop ends."""

_Kind = TypeVar("_Kind")
"""A class that an argument must be of."""


def finite_number(value: object, name: str, unit: str) -> float:
    """Return `value` as a float.

    Raises:
        InvalidInput: it is not a finite real number within `LARGEST`.
    """
    number = value if type(value) is float else as_number(value)
    if -LARGEST <= number <= LARGEST:
        return number
    need = f"between -1e9 and 1e9 {unit}".rstrip() if isfinite(number) else f"finite ({unit})"
    raise InvalidInput(f"{name} must be {need}, got {shown(value)}.", argument=name)


def positive_number(value: object, name: str, unit: str = "") -> float:
    """Return `value` as a float.

    Raises:
        InvalidInput: it is not a real number > 0 between `SMALLEST` and `LARGEST`.
    """
    number = as_number(value)
    if SMALLEST <= number <= LARGEST:
        return number
    need = "between 1e-9 and 1e9" if isfinite(number) and number > 0.0 else "> 0"
    raise InvalidInput(
        f"{name} must be {f'{need} {unit}'.rstrip()}, got {shown(value)}.", argument=name
    )


def number_from_zero(value: object, name: str, unit: str) -> float:
    """Return `value` as a float.

    Raises:
        InvalidInput: it is not a real number >= 0 within `LARGEST`.
    """
    number = as_number(value)
    if 0.0 <= number <= LARGEST:
        return number
    need = "between 0 and 1e9" if isfinite(number) and number > 0.0 else ">= 0"
    raise InvalidInput(f"{name} must be {need} {unit}, got {shown(value)}.", argument=name)


def number_within(value: object, name: str, low: float, high: float, unit: str = "") -> float:
    """Return `value` as a float.

    Raises:
        InvalidInput: it is not a real number from `low` to `high`.
    """
    number = as_number(value)
    if low <= number <= high:
        return number
    need = f"{name} must be between {low:g} and {high:g} {unit}".rstrip()
    raise InvalidInput(f"{need}, got {shown(value)}.", argument=name)


def share_of(value: object, name: str, whole: str) -> float:
    """Return `value` as a float.

    Raises:
        InvalidInput: it is not a real number in (0, 1).
    """
    number = as_number(value)
    if 0.0 < number < 1.0:
        return number
    raise InvalidInput(
        f"{name} must be in (0, 1), the share of {whole}, got {shown(value)}.", argument=name
    )


def time_of(value: object, name: str = "t") -> float:
    """Return a time (s) to look something up at; infinity is before or after everything.

    Raises:
        InvalidInput: it is not a real number.
    """
    number = as_number(value)
    if number == number:
        return number
    raise InvalidInput(f"{name} must be a time in s, got {shown(value)}.", argument=name)


def count_of(value: object, name: str, most: int = MOST) -> int:
    """Return `value` as an int.

    Raises:
        InvalidInput: it is not an integer from 0 to `most`.
    """
    count = -1 if type(value) is bool or not isinstance(value, Integral) else int(value)
    if 0 <= count <= most:
        return count
    need = f"at most {most}" if count > most else "an integer >= 0"
    raise InvalidInput(f"{name} must be {need}, got {shown(value)}.", argument=name)


def sample_count(duration: float, dt: float) -> int:
    """Return the number of samples every `dt` seconds over a time, both ends included.

    Raises:
        InvalidInput: they are more than `MOST_SAMPLES`.
    """
    if duration > MOST_SAMPLES * dt:
        raise InvalidInput(
            f"dt must give at most {MOST_SAMPLES} samples in {duration:g} s, got {dt:g} s.",
            argument="dt",
        )
    return round(duration / dt) + 1


def foot_of(value: object, name: str) -> Foot:
    """Return `value` as a foot.

    Raises:
        InvalidInput: it is neither "left" nor "right".
    """
    if isinstance(value, str) and value in FEET:
        return value
    raise InvalidInput(f"{name} must be 'left' or 'right', got {shown(value)}.", argument=name)


def instance_of(value: object, kind: type[_Kind], name: str) -> _Kind:
    """Return `value`, which is of this type.

    Raises:
        InvalidInput: it is not.
    """
    if isinstance(value, kind):
        return value
    raise InvalidInput(f"{name} must be a {kind.__name__}, got {shown(value)}.", argument=name)


def function_of(value: Callable[..., Any] | None, name: str) -> Callable[..., Any] | None:
    """Return `value`, which can be called, or is None.

    Raises:
        InvalidInput: it cannot.
    """
    if value is None or callable(value):
        return value
    raise InvalidInput(f"{name} must be a function or None, got {shown(value)}.", argument=name)


def items_of(value: Iterable[object], kind: type[_Kind], name: str) -> Iterator[_Kind]:
    """Yield the items of an iterable, which are all of this type.

    Raises:
        InvalidInput: it is not iterable, an item is of another type, or there are more than `MOST`.
    """
    need = f"{name} must hold a {kind.__name__} each"
    try:
        items = iter(value)
    except TypeError:
        raise InvalidInput(f"{need}, got {shown(value)}.", argument=name) from None
    for number, item in enumerate(items, 1):
        if not isinstance(item, kind):
            raise InvalidInput(f"{need}, got {shown(item)} as number {number}.", argument=name)
        if number > MOST:
            raise InvalidInput(f"{name} must hold at most {MOST} items.", argument=name)
        yield item


def real_array(value: object, name: str, form: str) -> Array:
    """Return `value` as a float64 array, itself if it is one; shape and range are not looked at.

    Raises:
        InvalidInput: it does not hold real numbers; the sentence says that it must be `form`.
    """
    try:
        array = np.asarray(value)
    except (TypeError, ValueError, OverflowError):
        array = np.empty(0, dtype=np.str_)
    if array.dtype.kind in "fiu":
        return array.astype(np.float64, copy=False)
    raise InvalidInput(f"{name} must be {form}, got {shown(value)}.", argument=name)


def shown(value: object) -> str:
    """Return how a sentence names a value that came: short, arrays by their shape."""
    if isinstance(value, np.ndarray) and value.ndim:
        return f"an array of shape {value.shape}"
    try:
        text = str(value) if isinstance(value, Real) else repr(value)
    except Exception:  # of an integer too long to print, or of somebody's class
        text = f"a {type(value).__name__}"
    text = " ".join(text.split())
    return text if len(text) <= 80 else f"{text[:60]} (and more)"


def angle(value: float) -> str:
    """Return how a sentence gives an angle (rad): "0.600 rad (34.4 degrees)"."""
    return f"{value:.3f} rad ({degrees(value):.1f} degrees)"


def as_number(value: object) -> float:
    """Return a real number as a float; nan for anything else."""
    if type(value) is float:
        return value
    if isinstance(value, np.ndarray) and value.ndim == 0:
        value = value[()]
    if type(value) is bool or not isinstance(value, Real):
        return nan
    try:
        return float(value)
    except OverflowError:
        return nan
