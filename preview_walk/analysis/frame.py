"""A record as seen from its start, so that a walk looks the same wherever it began."""

from __future__ import annotations

from preview_walk.geometry.planar import mid_yaw, turn
from preview_walk.record.record import Record
from preview_walk.types import Array


def start_frame(record: Record) -> tuple[Array, float]:
    """Return the origin (2,) in m and the yaw (rad) of the middle of the first planned soles."""
    left, right = record.left_foot_ref[0], record.right_foot_ref[0]
    origin: Array = 0.5 * (left[:2, 3] + right[:2, 3])
    return origin, float(mid_yaw(left, right))


def from_start(record: Record, points: Array) -> Array:
    """Return plane points (..., 2) in m as seen from `start_frame`: x along the first heading."""
    origin, angle = start_frame(record)
    return turn(points - origin, -angle)
