"""What every public call of this room asks of its numbers, and values that cannot be changed."""

from __future__ import annotations

import math
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import ArrayLike

from preview_walk.arguments import shown
from preview_walk.errors import InvalidInput
from preview_walk.types import Array


@dataclass(frozen=True, eq=False)
class Value:
    """A frozen dataclass whose arrays are read-only, also after pickling and deep-copying."""

    def __post_init__(self) -> None:
        for value in vars(self).values():
            if isinstance(value, np.ndarray):
                value.flags.writeable = False

    def __reduce__(self) -> tuple[type, tuple[object, ...]]:
        """Pickle the fields alone: what is derived from them is derived again."""
        names = [field.name for field in fields(self)]
        return type(self), tuple(getattr(self, name) for name in names)


@contextmanager
def computable(argument: str) -> Iterator[None]:
    """Say in a sentence which argument is too large, too small or too near to singular to solve.

    Raises:
        InvalidInput: If linear algebra fails inside.

    """
    try:
        with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
            yield
    except np.linalg.LinAlgError as error:
        raise InvalidInput(
            f"expected a system and weights of sizes that can be computed with, got: "
            f"{str(error).rstrip('.')}.",
            argument=argument,
        ) from error


def read_only(array: Array) -> Array:
    """Make an array read-only and return it."""
    array.flags.writeable = False
    return array


def real_array(name: str, value: object, allowed: str = "real numbers") -> Array:
    """Return a fresh float array of any shape, finite or not."""
    try:
        raw = np.asarray(value)
        if raw.dtype.kind not in "biuf":
            raise TypeError
        return np.array(raw, dtype=float)
    except (TypeError, ValueError, OverflowError):
        raise InvalidInput(
            f"expected {name} to be {allowed}, got {shown(value)}.", argument=name
        ) from None


def finite_vector(name: str, value: ArrayLike | None, default: Array) -> Array:
    """Return (len(default),) finite numbers; the default where the value is None."""
    if value is None:
        return default
    allowed = f"{len(default)} finite numbers"
    vector = np.atleast_1d(real_array(name, value, allowed))
    if vector.shape != default.shape or not np.isfinite(vector).all():
        raise InvalidInput(f"expected {name} to be {allowed}, got {shown(value)}.", argument=name)
    return vector


def sequence(name: str, value: object, columns: int) -> Array:
    """Return a finite sequence of shape (M, columns), M >= 1; (M,) is taken where columns = 1."""
    rows = real_array(name, value)
    if columns == 1 and rows.ndim == 1:
        rows = rows[:, None]
    article = "an" if name[0] in "aeiou" else "a"
    if rows.ndim != 2 or rows.shape[1] != columns or len(rows) < 1:
        raise InvalidInput(
            f"expected {article} {name} of shape (M, {columns}) with M >= 1, got shape "
            f"{np.asarray(value).shape}.",
            argument=name,
        )
    if not np.isfinite(rows).all():
        raise InvalidInput(f"expected a finite {name}, got NaN or infinity.", argument=name)
    return rows


def positive(name: str, value: object, unit: str) -> float:
    """Return a positive, finite number as a float, of whatever type it came."""
    try:
        if isinstance(value, str | bytes | bool | np.bool_):
            raise TypeError
        number = float(value)  # type: ignore[arg-type]
    except (TypeError, ValueError, OverflowError):
        number = math.nan
    if not 0.0 < number < math.inf:
        raise InvalidInput(
            f"expected {name} to be a positive number of {unit}, got {shown(value)}.",
            argument=name,
        )
    return number


def require_type(name: str, value: object, kind: type) -> None:
    """Refuse what is not of a type."""
    if not isinstance(value, kind):
        raise InvalidInput(
            f"expected {name} to be a {kind.__name__}, got a {type(value).__name__}.",
            argument=name,
        )
