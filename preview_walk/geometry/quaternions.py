"""Vectors turned by unit quaternions, many at a time."""

from __future__ import annotations

import numpy as np

from preview_walk.types import Array


def rotate(quaternion: Array, vector: Array) -> Array:
    """Return vectors (..., 3) turned by unit quaternions (..., 4), given as x, y, z, w."""
    axis, w = quaternion[..., :3], quaternion[..., 3:]
    twice = 2.0 * np.cross(axis, vector)
    turned: Array = vector + w * twice + np.cross(axis, twice)
    return turned
