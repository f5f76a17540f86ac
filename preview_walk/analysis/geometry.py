"""Poses of a record as the plane sees them: yaw, heading, sole corners."""

from __future__ import annotations

import numpy as np

from preview_walk.simulation.record import Record
from preview_walk.types import Array


def yaw(pose: Array) -> Array:
    """Return the yaw (rad) of poses (..., 4, 4): the direction of their x axis in the plane."""
    angle: Array = np.arctan2(pose[..., 1, 0], pose[..., 0, 0])
    return angle


def wrap(angle: Array) -> Array:
    """Return angles (rad) brought into [-pi, pi)."""
    return (angle + np.pi) % (2 * np.pi) - np.pi


def mid_yaw(left: Array, right: Array) -> Array:
    """Return the yaw (rad) half way between two sets of poses (..., 4, 4)."""
    start = yaw(left)
    return start + 0.5 * wrap(yaw(right) - start)


def turn(points: Array, angle: Array | float) -> Array:
    """Return plane vectors (..., 2) turned by `angle` (rad, one or one per vector)."""
    c, s = np.cos(angle), np.sin(angle)
    x, y = points[..., 0], points[..., 1]
    return np.stack([c * x - s * y, s * x + c * y], axis=-1)


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
