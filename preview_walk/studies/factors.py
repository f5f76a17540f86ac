"""What a study varies: lists whose product is a grid, rows that are listed, random draws."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import product
from typing import Any, Protocol, TypeAlias, runtime_checkable

import numpy as np

from preview_walk.arguments import shown
from preview_walk.errors import InvalidInput


@runtime_checkable
class Draw(Protocol):
    """A random factor: one of `scipy.stats`'s frozen distributions, or what has its `rvs`."""

    def rvs(self, *, random_state: np.random.Generator) -> Any:
        """Return one value."""


Levels: TypeAlias = Any
"""The values of a factor: a list of them, a `Draw`, or one value that stands in every case."""

Factors: TypeAlias = Mapping[str, Levels] | Sequence[Mapping[str, Any]]
"""A grid as levels by name, or its rows listed one by one."""


@dataclass(frozen=True)
class Cell:
    """What its repeats have in common: one point of the grid.

    Attributes:
        values: of the factors that are not random, by name.
        draws: the random ones, by name.
    """

    values: Mapping[str, Any]
    draws: Mapping[str, Draw]


def cells_of(factors: Factors) -> Iterator[Cell]:
    """Yield the cells of a grid, the last factor changing fastest, or those of a list."""
    if not isinstance(factors, Mapping):
        for row in factors:
            yield Cell({name: plain(value) for name, value in row.items()}, {})
        return
    draws = {name: levels for name, levels in factors.items() if isinstance(levels, Draw)}
    lists = {name: _levels(levels) for name, levels in factors.items() if name not in draws}
    for values in product(*lists.values()):
        yield Cell(dict(zip(lists, values, strict=True)), draws)


def count_cells(factors: Factors) -> int:
    """Return how many cells there are."""
    if not isinstance(factors, Mapping):
        return len(factors)
    sizes = [len(_levels(levels)) for levels in factors.values() if not isinstance(levels, Draw)]
    return int(np.prod(sizes, dtype=object)) if sizes else 1


def names_of(factors: Factors) -> tuple[str, ...]:
    """Return the factors' names, which are those of the function's arguments."""
    if isinstance(factors, Mapping):
        return tuple(factors)
    return tuple(factors[0]) if factors else ()


def check_factors(factors: Factors) -> None:
    """Check that factors are a grid or a list of rows with the same names.

    Raises:
        InvalidInput: they are not, or a factor has no level.
    """
    form = "factors must be levels by name, or a list of rows by name"
    if not isinstance(factors, Mapping):
        rows = factors if isinstance(factors, list | tuple) else []
        if not rows or not all(isinstance(row, Mapping) for row in rows):
            raise InvalidInput(f"{form}, got {shown(factors)}.", argument="factors")
        for number, row in enumerate(rows, 1):
            if set(row) != set(rows[0]):
                raise InvalidInput(
                    f"row {number} of factors must have the names {', '.join(rows[0])}, "
                    f"got {', '.join(row) or 'none'}.",
                    argument="factors",
                )
    for name in names_of(factors):
        if not isinstance(name, str) or not name.isidentifier():
            raise InvalidInput(
                f"a factor must have the name of an argument, got {shown(name)}.",
                argument="factors",
            )
    if isinstance(factors, Mapping):
        for name, levels in factors.items():
            if not isinstance(levels, Draw) and not _levels(levels):
                raise InvalidInput(f"factor '{name}' must have a value.", argument="factors")


def plain(value: Any) -> Any:
    """Return a value without NumPy's types, as files and tables hold it."""
    if isinstance(value, np.generic | np.ndarray):
        value = value.tolist()
    return [plain(item) for item in value] if isinstance(value, list | tuple) else value


def named(value: Any) -> str:
    """Return how files name a level: as text that is the same in every process.

    Raises:
        InvalidInput: the text of the value names a place in memory, which differs.
    """
    if isinstance(value, Draw):
        frozen: Any = value
        inner = getattr(frozen, "dist", None)
        if inner is not None:
            return f"{inner.name}{tuple(frozen.args)}{dict(frozen.kwds) or ''}"
    text = repr(value)
    if " at 0x" in text:
        raise InvalidInput(
            "the values of a study must be plain, or have a text of their own that tells them "
            f"apart, got {shown(value)}.",
            argument="factors",
        )
    return text


def _levels(levels: Levels) -> list[Any]:
    if isinstance(levels, np.ndarray):
        levels = levels.tolist()
    if isinstance(levels, range):
        levels = list(levels)
    return [plain(level) for level in levels] if isinstance(levels, list | tuple) else [levels]
