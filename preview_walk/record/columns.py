"""Columns that grow by a row a tick."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from preview_walk.record.fields import FieldInfo

ROOM = 4096
"""Ticks that are made room for at a time."""

Arrays = dict[str, NDArray[Any]]


class Columns:
    """Growing arrays, one per field, in pieces: what is written is not moved again.

    Args:
        table: the fields by name.
        sizes: nq, nv and nu of the robot.
        room: number of rows to make room for at a time.
    """

    def __init__(
        self, table: Mapping[str, FieldInfo], sizes: Mapping[str, int], room: int = ROOM
    ) -> None:
        self._full: list[Arrays] = []
        self._n, self._room = 0, room
        self._arrays: Arrays = {}
        for name, info in table.items():
            shape = (room, *(sizes[k] if isinstance(k, str) else k for k in info.shape))
            self._arrays[name] = _empty(shape, np.dtype(info.dtype))

    def __getstate__(self) -> dict[str, Any]:
        """Leave out the room that nothing is written in yet."""
        return {"_full": [self.rows()], "_n": 0, "_arrays": self._next(0), "_room": self._room}

    def __setstate__(self, state: dict[str, Any]) -> None:
        """Take the rows, and make room of its own."""
        vars(self).update(state)
        self._arrays = self._next(self._room)

    def __len__(self) -> int:
        return sum(len(next(iter(piece.values()))) for piece in self._full) + self._n

    def write(self, values: Mapping[str, Any]) -> None:
        """Store a row by field name (6 to 10 microseconds for a tick's); values are copied.

        A row interrupted half way is not counted.
        """
        if self._n == self._room:
            self._full.append(self._arrays)
            self._arrays, self._n = self._next(self._room), 0
        i, arrays = self._n, self._arrays
        for name, value in values.items():
            arrays[name][i] = value
        self._n = i + 1

    def rows(self, since: int = 0) -> Arrays:
        """Return what is written so far, from a row on: read-only arrays.

        All rows together are kept in the place of their pieces: an hour's are not held twice.
        """
        pieces = []
        for piece in (*self._full, {name: a[: self._n] for name, a in self._arrays.items()}):
            count = len(next(iter(piece.values())))
            if since < count:
                pieces.append({name: array[since:] for name, array in piece.items()})
            since = max(0, since - count)
        joined = {}
        for name, array in self._arrays.items():
            joined[name] = np.concatenate([array[:0], *(piece[name] for piece in pieces)])
            joined[name].setflags(write=False)
        if len(pieces) > 1 and sum(len(next(iter(p.values()))) for p in pieces) == len(self):
            self._full, self._arrays, self._n = [joined], self._next(self._room), 0
        return joined

    def _next(self, room: int) -> Arrays:
        """Return empty arrays with room for so many rows."""
        return {
            name: _empty((room, *array.shape[1:]), array.dtype)
            for name, array in self._arrays.items()
        }


def _empty(shape: tuple[int, ...], kind: np.dtype[Any]) -> NDArray[Any]:
    """Return an array in which shows what is never written: nan, or -1 where there is no nan."""
    return np.full(shape, np.nan if kind == np.float64 else -1, dtype=kind)
