"""CoM, ZMP and DCM, planned and measured, as rows of numbers: what plots and marks show."""

from __future__ import annotations

from collections import deque
from collections.abc import Mapping
from typing import Any

import numpy as np

from preview_walk.record.record import Record
from preview_walk.simulation.recording import tick_row
from preview_walk.simulation.walk import Walk
from preview_walk.types import Array

POINTS = ("com", "zmp", "dcm")
"""Each is planned (`_ref`) and measured, along x and along y."""

SPAN = 6.0
"""Seconds of the past that a plot shows."""

WIDTH = 1 + 4 * len(POINTS) + 2
"""Numbers of a row: time, then x and y of each point measured and planned; height of the CoM, and
of the lower sole."""


def rows_of(values: Mapping[str, Any]) -> Array:
    """Return the rows (n, `WIDTH`) of n ticks.

    Args:
        values: fields of a record by name, first axis the ticks.
    """
    parts = [values["time"]]
    for axis in (0, 1):
        for point in POINTS:
            parts += [values[point][:, axis], values[f"{point}_ref"][:, axis]]
    soles = values["left_foot"][:, 2, 3], values["right_foot"][:, 2, 3]
    return np.stack([*parts, values["com"][:, 2], np.minimum(*soles)], axis=1)


def recorded(record: Record) -> Array:
    """Return the rows (n, `WIDTH`) of all ticks of a record."""
    return rows_of(record.arrays())


def place(row: Array, point: str) -> Array:
    """Return where a measured point (3,) of a row is, m; the ZMP and the DCM on the ground."""
    column = 1 + 2 * POINTS.index(point)
    height = row[-2] if point == "com" else row[-1]
    return np.array((row[column], row[column + 2 * len(POINTS)], height))


class LiveTraces:
    """The rows of the last seconds of a running walk, one for each picture.

    Args:
        walk: whose they are.
        pictures: per second.
    """

    def __init__(self, walk: Walk, pictures: float) -> None:
        self._walk = walk
        self._rows: deque[Array] = deque(maxlen=round(SPAN * pictures))

    @property
    def rows(self) -> Array:
        """The rows (n, `WIDTH`) so far, the latest at the end."""
        return np.array(self._rows).reshape(-1, WIDTH)

    def add(self) -> None:
        """Take the row of the last tick, if there is one and it is new."""
        walk = self._walk
        if walk.walker.body.solution is None:
            return
        if not self._rows or self._rows[-1][0] != walk.time:
            none = np.zeros(walk.robot.pin.nv - 6)
            values = tick_row(walk.time, walk.plant, walk.walker, none, 0.0)
            self._rows.append(rows_of({k: np.asarray(v)[None] for k, v in values.items()})[0])
