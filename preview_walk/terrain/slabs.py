"""Ground made of slabs: flat rectangles, level or tilted, over a floor far below.

Stairs, slopes, blocks and stepping stones are all made of them; in a simulation each is a box.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from math import cos, sin

import numpy as np
from numpy.typing import ArrayLike

from preview_walk.arguments import finite_number, items_of, positive_number
from preview_walk.errors import InvalidInput
from preview_walk.geometry.poses import pose_at
from preview_walk.types import Array

STEEPEST = 1.0
"""A slab tilted by more than this (rad) is a wall."""

DEPTH = 1.0
"""The floor lies this far (m) below the lowest ground."""

SEAM = 1e-9
"""Slabs reach this far (m) further: where two meet, rounding must not open a crack to the floor."""


@dataclass(frozen=True)
class Slab:
    """A flat rectangle, seen from above.

    Attributes:
        x, y, z: middle of its upper face, world, m.
        half_length: half of its extent along its heading, measured on the level, m.
        half_width: half of its extent to the side, measured on the level, m.
        yaw: its heading, rad.
        pitch: positive goes down ahead, as of a pose, rad.
        roll: positive goes up to the left, as of a pose, rad.

    Raises:
        InvalidInput: a number is not finite, a size not > 0, or it is a wall.
    """

    x: float
    y: float
    z: float
    half_length: float
    half_width: float
    yaw: float = 0.0
    pitch: float = 0.0
    roll: float = 0.0

    def __post_init__(self) -> None:
        """Check the numbers."""
        for name in ("x", "y", "z"):
            finite_number(getattr(self, name), name, "m")
        for name in ("half_length", "half_width"):
            positive_number(getattr(self, name), name, "m")
        finite_number(self.yaw, "yaw", "rad")
        for name in ("pitch", "roll"):
            if abs(finite_number(getattr(self, name), name, "rad")) > STEEPEST:
                raise InvalidInput(
                    f"{name} of a slab must be at most {STEEPEST} rad, got {getattr(self, name)}.",
                    name,
                )

    @property
    def pose(self) -> Array:
        """Pose (4, 4) of its upper face, x along its heading, z out of it."""
        return pose_at(self.x, self.y, self.yaw, self.z, self.pitch, self.roll)


@dataclass(frozen=True, eq=False)
class SlabGround:
    """The highest of many slabs at every place, and a floor where there is none.

    Attributes:
        slabs: in any order; they may overlap.
        floor: height of the level floor around and below them, m.

    Raises:
        InvalidInput: something else than slabs, or a floor that is no number.
    """

    slabs: tuple[Slab, ...]
    floor: float = 0.0

    def __post_init__(self) -> None:
        """Check the slabs."""
        object.__setattr__(self, "slabs", tuple(items_of(self.slabs, Slab, "slabs")))
        finite_number(self.floor, "floor", "m")

    def __repr__(self) -> str:
        return f"SlabGround({len(self.slabs)} slabs, floor at {self.floor:g} m)"

    def height(self, x: ArrayLike, y: ArrayLike) -> Array:
        """Return the height (m) at x and y (world, m); see `Ground`."""
        x, y = np.asarray(x, dtype=np.float64), np.asarray(y, dtype=np.float64)
        heights: Array = _tops(self._near(x, y), x, y).max(axis=-1, initial=self.floor)
        return heights

    def normal(self, x: float, y: float) -> Array:
        """Return the unit normal (3,) at x, y (world, m); that of the floor beside the slabs."""
        tops = _tops(self._table, np.asarray(x), np.asarray(y))
        best = int(tops.argmax()) if len(self.slabs) else -1
        if best < 0 or tops[best] <= self.floor:
            return np.array((0.0, 0.0, 1.0))
        normal: Array = np.array(self.slabs[best].pose[:3, 2])
        return normal

    @cached_property
    def _table(self) -> Array:
        """Columns: x, y, z, cos yaw, sin yaw, half length, half width, rise ahead, rise left."""
        rows = []
        for slab in self.slabs:
            nx, ny, nz = slab.pose[:3, 2].tolist()
            c, s = cos(slab.yaw), sin(slab.yaw)
            rise = (-(nx * c + ny * s) / nz, -(ny * c - nx * s) / nz)
            size = (slab.half_length, slab.half_width)
            rows.append((slab.x, slab.y, slab.z, c, s, *size, *rise))
        table: Array = np.array(rows, dtype=np.float64).reshape(-1, 9).T
        return table

    def _near(self, x: Array, y: Array) -> Array:
        """Return the columns of the table whose slabs may be under these places."""
        table = self._table
        if not x.size or not y.size:
            return table
        reach = np.hypot(table[5], table[6])
        beside = np.abs(table[0] - 0.5 * (x.max() + x.min())) - 0.5 * (x.max() - x.min()) > reach
        beside |= np.abs(table[1] - 0.5 * (y.max() + y.min())) - 0.5 * (y.max() - y.min()) > reach
        near: Array = table[:, ~beside]
        return near


def _tops(table: Array, x: Array, y: Array) -> Array:
    """Return the height (..., S) of each slab of a table at x and y; -inf beside it."""
    x0, y0, z0, c, s, length, width, ahead, left = table
    dx, dy = x[..., None] - x0, y[..., None] - y0
    along, aside = c * dx + s * dy, c * dy - s * dx
    inside = (np.abs(along) <= length + SEAM) & (np.abs(aside) <= width + SEAM)
    tops: Array = np.where(inside, z0 + ahead * along + left * aside, -np.inf)
    return tops
