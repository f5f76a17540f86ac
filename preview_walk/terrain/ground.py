"""What every ground can tell, and the flat one."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike

from preview_walk.types import Array


class Ground(Protocol):
    """The ground under a walk, seen from above."""

    def height(self, x: ArrayLike, y: ArrayLike) -> Array:
        """Return its height (m) at x and y (world, m), of their common shape."""

    def normal(self, x: float, y: float) -> Array:
        """Return its unit normal (3,), world axes, at x, y (world, m)."""


@dataclass(frozen=True)
class FlatGround:
    """A level plane.

    Attributes:
        z: its height, m.
    """

    z: float = 0.0

    def height(self, x: ArrayLike, y: ArrayLike) -> Array:
        """Return `z`, wherever it is; see `Ground`."""
        return np.full(np.broadcast(x, y).shape, self.z)

    def normal(self, x: float, y: float) -> Array:
        """Return (0, 0, 1), wherever it is."""
        return np.array((0.0, 0.0, 1.0))
