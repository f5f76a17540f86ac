"""Values that nobody can change: arrays of one's own, and mappings that pickle."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
from numpy.typing import DTypeLike, NDArray

from preview_walk.errors import InvalidInput


class ReadOnlyMapping(Mapping[str, Any]):
    """A mapping by text that cannot be changed, nor can what it holds.

    `types.MappingProxyType` would do, but it neither pickles nor deep-copies.
    """

    def __init__(self, items: Mapping[str, Any]) -> None:
        self._items = {str(key): read_only(value) for key, value in items.items()}

    def __getitem__(self, key: str) -> Any:
        return self._items[key]

    def __iter__(self) -> Iterator[str]:
        return iter(self._items)

    def __len__(self) -> int:
        return len(self._items)

    def __hash__(self) -> int:
        return hash(frozenset(self._items.items()))

    def __repr__(self) -> str:
        """Return the items as a dict shows them."""
        return repr(self._items)


class ReadOnlyArrays:
    """Base of dataclasses whose arrays stay read-only when they are pickled or copied."""

    def __setstate__(self, state: dict[str, Any]) -> None:
        for value in state.values():
            if isinstance(value, np.ndarray):
                value.setflags(write=False)
        self.__dict__.update(state)


def read_only(value: Any) -> Any:
    """Return a plain value with its mappings, lists and arrays made unchangeable, all the way in.

    Raises:
        TypeError: it holds something that JSON does not know.
    """
    if isinstance(value, np.ndarray | np.generic):
        value = value.tolist()
    if value is None or isinstance(value, bool | int | float | str):
        return value
    if isinstance(value, Mapping):
        return ReadOnlyMapping(value)
    if isinstance(value, list | tuple):
        return tuple(map(read_only, value))
    raise TypeError(f"{type(value).__name__} is not a plain value")


def plain(value: Any) -> Any:
    """Return the dicts and lists of which `read_only` made a value; None for nan."""
    if isinstance(value, Mapping):
        return {key: plain(item) for key, item in value.items()}
    if isinstance(value, tuple):
        return [plain(item) for item in value]
    return None if value != value else value


def own_array(value: Any, dtype: DTypeLike, name: str) -> NDArray[Any]:
    """Return `value` as an array that nobody can write to: a copy, unless it is one already.

    Raises:
        InvalidInput: it is no array of numbers, or `dtype` is a whole number's and cannot hold it.
    """
    kind = np.dtype(dtype)
    try:
        given = np.asarray(value)
    except (TypeError, ValueError):
        given = np.empty(0, dtype=object)
    if given.dtype.kind not in "biuf":
        raise InvalidInput(
            f"{name} must be an array of {kind} numbers, got {given.dtype}.", argument=name
        )
    with np.errstate(invalid="ignore"):
        array = given.astype(kind, copy=False)
    if kind.kind == "i" and array is not given and not np.array_equal(array, given):
        raise InvalidInput(f"{name} must hold whole numbers of {kind}.", argument=name)
    base: Any = array
    while isinstance(base, np.ndarray) and not base.flags.writeable:
        base = base.base
    if base is not None and not isinstance(base, bytes):
        array = array.copy()
        array.setflags(write=False)
    return array
