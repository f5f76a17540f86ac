"""Unit quaternions x, y, z, w, many at a time: of rotations, and vectors turned by them."""

from __future__ import annotations

import numpy as np
from scipy.spatial.transform import Rotation

from preview_walk.types import Array


def rotate(quaternion: Array, vector: Array) -> Array:
    """Return vectors (..., 3) turned by unit quaternions (..., 4), given as x, y, z, w."""
    axis, w = quaternion[..., :3], quaternion[..., 3:]
    twice = 2.0 * np.cross(axis, vector)
    turned: Array = vector + w * twice + np.cross(axis, twice)
    return turned


def quaternions_of(turns: Array) -> Array:
    """Return quaternions xyzw (N, 4), w >= 0, of rotations (N, 3, 3); nan where these are."""
    found = np.full((len(turns), 4), np.nan)
    known = np.isfinite(turns).all(axis=(1, 2))
    if known.any():
        found[known] = Rotation.from_matrix(turns[known]).as_quat(canonical=True)
    return found
