"""A record as seen from its start: where it began, and sole corners in the plane."""

from __future__ import annotations

import numpy as np

from preview_walk.geometry.planar import mid_yaw, turn
from preview_walk.record.record import Record
from preview_walk.types import Array


def start_frame(record: Record) -> tuple[Array, float]:
    """Return the origin (2,) in m and the yaw (rad) of the middle of the first planned soles."""
    left, right = record.left_foot_ref[0], record.right_foot_ref[0]
    origin: Array = 0.5 * (left[:2, 3] + right[:2, 3])
    return origin, float(mid_yaw(left, right))


def sole_corners(pose: Array, half_length: float, half_width: float) -> Array:
    """Return the corners (4, 2) in m, seen from above, of a sole at `pose` (4, 4)."""
    signs = np.array([[1, 1], [-1, 1], [-1, -1], [1, -1]], dtype=np.float64)
    local = signs * (half_length, half_width)
    corners: Array = pose[:2, 3] + local @ pose[:2, :2].T
    return corners


def from_start(record: Record, points: Array) -> Array:
    """Return plane points (..., 2) in m as seen from `start_frame`: x along the first heading."""
    origin, angle = start_frame(record)
    return turn(points - origin, -angle)
