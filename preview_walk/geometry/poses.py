"""Small rigid-body helpers: homogeneous poses, headings and roll-pitch-yaw.

A pose is a (4, 4) homogeneous matrix that takes coordinates of the frame (metres) to the world.
A *heading frame* is planar: (x, y, yaw).  Angles are Z-Y-X: R = Rz(yaw) Ry(pitch) Rx(roll).
"""

from __future__ import annotations

from collections.abc import Sequence
from math import asin, atan2, cos, pi, sin

import numpy as np

from preview_walk.errors import InvalidInput
from preview_walk.types import Array

Heading = tuple[float, float, float]
"""x (m), y (m), yaw (rad) of a planar frame in the world."""


def pose_at(
    x: float,
    y: float,
    yaw: float = 0.0,
    z: float = 0.0,
    pitch: float = 0.0,
    roll: float = 0.0,
) -> Array:
    """Return the (4, 4) read-only pose with this origin (m) and these Z-Y-X angles (rad)."""
    cy, sy, cp, sp, cr, sr = cos(yaw), sin(yaw), cos(pitch), sin(pitch), cos(roll), sin(roll)
    pose = np.array(
        [
            [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr, x],
            [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr, y],
            [-sp, cp * sr, cp * cr, z],
            [0.0, 0.0, 0.0, 1.0],
        ]
    )
    pose.setflags(write=False)
    return pose


def rpy_of(pose: Array) -> tuple[float, float, float]:
    """Return (roll, pitch, yaw) in radians of a pose's rotation; pitch in [-pi/2, pi/2]."""
    r20 = min(1.0, max(-1.0, float(pose[2, 0])))
    roll = atan2(float(pose[2, 1]), float(pose[2, 2]))
    return roll, -asin(r20), atan2(float(pose[1, 0]), float(pose[0, 0]))


def yaw_of(pose: Array) -> float:
    """Return the heading (rad, in [-pi, pi]) of a pose's x axis, seen from above."""
    return atan2(float(pose[1, 0]), float(pose[0, 0]))


def wrap(angle: float) -> float:
    """Return the same angle (rad) in [-pi, pi)."""
    return (angle + pi) % (2.0 * pi) - pi


def compose(frame: Heading, dx: float, dy: float, dyaw: float = 0.0) -> Heading:
    """Return the planar frame that stands at (dx, dy, dyaw), given in `frame`'s coordinates."""
    x, y, yaw = frame
    c, s = cos(yaw), sin(yaw)
    return x + c * dx - s * dy, y + s * dx + c * dy, yaw + dyaw


def relative(frame: Heading, other: Heading) -> Heading:
    """Return `other` in the coordinates of `frame`; the yaw in [-pi, pi)."""
    dx, dy = other[0] - frame[0], other[1] - frame[1]
    c, s = cos(frame[2]), sin(frame[2])
    return c * dx + s * dy, c * dy - s * dx, wrap(other[2] - frame[2])


def heading_of(pose: Array) -> Heading:
    """Return (x, y, yaw) of a pose."""
    return float(pose[0, 3]), float(pose[1, 3]), yaw_of(pose)


def midfeet(left: Array, right: Array) -> Heading:
    """Return the heading frame halfway between two sole poses."""
    yaw = yaw_of(right)
    return (
        0.5 * float(left[0, 3] + right[0, 3]),
        0.5 * float(left[1, 3] + right[1, 3]),
        yaw + 0.5 * wrap(yaw_of(left) - yaw),
    )


def as_pose(value: object, name: str) -> Array:
    """Return `value` as a read-only (4, 4) pose.

    Raises:
        InvalidInput: when it is not a finite homogeneous matrix with a rotation in its corner.
    """
    if isinstance(value, np.ndarray) and value.dtype == np.float64 and not value.flags.writeable:
        pose = value
    else:
        try:
            pose = np.array(value, dtype=np.float64)
        except (TypeError, ValueError):
            pose = np.empty(0)
        pose.setflags(write=False)
    if pose.shape != (4, 4) or not _is_rigid(pose):
        raise InvalidInput(
            f"{name} must be a finite (4, 4) homogeneous pose with an orthonormal right-handed "
            f"rotation, got {_describe(value)}."
        )
    return pose


def as_heading(value: Sequence[float], name: str) -> Heading:
    """Return (x, y) or (x, y, yaw) as a heading frame.

    Raises:
        InvalidInput: when it does not hold two or three finite numbers.
    """
    try:
        numbers = [float(v) for v in value]
    except (TypeError, ValueError):
        numbers = []
    if len(numbers) not in (2, 3) or not np.isfinite(numbers).all():
        raise InvalidInput(f"{name} must be (x, y) or (x, y, yaw) in m and rad, got {value!r}.")
    return numbers[0], numbers[1], numbers[2] if len(numbers) == 3 else 0.0


def _is_rigid(pose: Array) -> bool:
    (a, b, c, x), (d, e, f, y), (g, h, i, z), last = pose.tolist()
    products = (a * a + d * d + g * g, b * b + e * e + h * h, a * b + d * e + g * h)
    cross = (d * h - g * e - c, g * b - a * h - f, a * e - d * b - i)
    error = max(abs(products[0] - 1), abs(products[1] - 1), abs(products[2]), *map(abs, cross))
    return bool(error < 1e-6) and last == [0.0, 0.0, 0.0, 1.0] and abs(x) + abs(y) + abs(z) < 1e9


def _describe(value: object) -> str:
    shape = getattr(value, "shape", None)
    return repr(value) if shape is None or shape == (4, 4) else f"an array of shape {shape}"
