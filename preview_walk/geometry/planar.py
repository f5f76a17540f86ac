"""The plane seen from above, for arrays of poses and points: yaw, turning, wrapping.

`poses` has the same for one pose, with the scalar functions of `math`: a planning tick is made of
those.
"""

from __future__ import annotations

from typing import TypeVar

import numpy as np

from preview_walk.types import Array

_Angle = TypeVar("_Angle", float, Array)
"""One angle, or an array of them (rad)."""


def yaw(pose: Array) -> Array:
    """Return the yaw (rad) of poses (..., 4, 4): the direction of their x axis in the plane."""
    angle: Array = np.arctan2(pose[..., 1, 0], pose[..., 0, 0])
    return angle


def wrap(angle: _Angle) -> _Angle:
    """Return an angle, or an array of them, brought into [-pi, pi) (rad)."""
    return (angle + np.pi) % (2.0 * np.pi) - np.pi


def mid_yaw(left: Array, right: Array) -> Array:
    """Return the yaw (rad) half way between two sets of poses.

    Args:
        left: poses (..., 4, 4).
        right: as many.
    """
    start = yaw(left)
    return start + 0.5 * wrap(yaw(right) - start)


def turn(points: Array, angle: Array | float) -> Array:
    """Return plane vectors (..., 2), turned.

    Args:
        points: vectors (..., 2).
        angle: by which they are turned, rad, one or one per vector.
    """
    c, s = np.cos(angle), np.sin(angle)
    x, y = points[..., 0], points[..., 1]
    return np.stack([c * x - s * y, s * x + c * y], axis=-1)
