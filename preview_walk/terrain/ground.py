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
class Plane:
    """A plane without end: what a walker believes that sees nothing.

    Attributes:
        z: height at the origin, m.
        ahead: rise per m along the world's x.
        left: rise per m along the world's y.
    """

    z: float = 0.0
    ahead: float = 0.0
    left: float = 0.0

    @classmethod
    def through(cls, point: Array, normal: Array) -> Plane:
        """Return the plane through a point (3,) with this normal (3,), world axes, m."""
        x, y, z = point.tolist()
        nx, ny, nz = normal.tolist()
        ahead, left = -nx / nz, -ny / nz
        return cls(z - ahead * x - left * y, ahead, left)

    def height(self, x: ArrayLike, y: ArrayLike) -> Array:
        """Return the height (m) at x and y (world, m); see `Ground`."""
        heights: Array = self.z + self.ahead * np.asarray(x) + self.left * np.asarray(y)
        return heights

    def normal(self, x: float, y: float) -> Array:
        """Return the unit normal (3,), the same everywhere."""
        normal = np.array((-self.ahead, -self.left, 1.0))
        normal /= np.linalg.norm(normal)
        return normal


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
