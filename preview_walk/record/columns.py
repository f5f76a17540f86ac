"""Columns that grow by a row a tick."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from preview_walk.record.fields import FieldInfo

ROOM = 4096
"""Ticks that are made room for at first; it doubles when full."""


class Columns:
    """Growing arrays, one per field.

    Args:
        table: the fields by name.
        sizes: nq, nv and nu of the robot.
        capacity: number of rows to make room for at first; it doubles when full.
    """

    def __init__(
        self, table: Mapping[str, FieldInfo], sizes: Mapping[str, int], capacity: int = ROOM
    ) -> None:
        self._n = 0
        self._arrays: dict[str, NDArray[Any]] = {}
        for name, info in table.items():
            shape = (capacity, *(sizes[k] if isinstance(k, str) else k for k in info.shape))
            # What is never written shows: nan, or -1 where there is no nan.
            empty = np.nan if info.dtype is np.float64 else -1
            self._arrays[name] = np.full(shape, empty, dtype=info.dtype)

    def __getstate__(self) -> dict[str, Any]:
        """Leave out the room that nothing is written in yet."""
        return {"_n": self._n, "_arrays": self.rows()}

    def __setstate__(self, state: dict[str, Any]) -> None:
        """Take the rows, and make room of its own: what comes to a worker may be read-only."""
        vars(self).update(state)
        self._grow()

    def __len__(self) -> int:
        return self._n

    def write(self, values: Mapping[str, Any]) -> None:
        """Store a row by field name (6 to 10 microseconds for a tick's); values are copied.

        A row interrupted half way is not counted.
        """
        i, arrays = self._n, self._arrays
        if i == len(next(iter(arrays.values()))):
            self._grow()
        for name, value in values.items():
            arrays[name][i] = value
        self._n = i + 1

    def rows(self) -> dict[str, NDArray[Any]]:
        """Return what is written so far: views."""
        return {name: array[: self._n] for name, array in self._arrays.items()}

    def _grow(self) -> None:
        for name, array in self._arrays.items():
            empty = np.nan if array.dtype == np.float64 else -1
            more = np.full((max(len(array), ROOM), *array.shape[1:]), empty, dtype=array.dtype)
            self._arrays[name] = np.concatenate([array, more])
