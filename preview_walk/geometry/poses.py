"""Small rigid-body helpers: homogeneous poses, headings and roll-pitch-yaw.

A pose is a (4, 4) homogeneous matrix that takes coordinates of the frame (metres) to the world.
A *heading frame* is planar: (x, y, yaw).  Angles are Z-Y-X: R = Rz(yaw) Ry(pitch) Rx(roll).
"""

from __future__ import annotations

from math import asin, atan2, cos, sin

import numpy as np

from preview_walk.arguments import LARGEST, finite_number, real_array, shown
from preview_walk.errors import InvalidInput
from preview_walk.geometry.planar import wrap
from preview_walk.types import Array

Heading = tuple[float, float, float]
"""x (m), y (m), yaw (rad) of a planar frame in the world."""

_WRONG = (TypeError, ValueError, IndexError, KeyError, OverflowError)
"""What arithmetic and indexing raise for values of the wrong kind."""


def pose_at(
    x: float,
    y: float,
    yaw: float = 0.0,
    z: float = 0.0,
    pitch: float = 0.0,
    roll: float = 0.0,
) -> Array:
    """Return the read-only pose (4, 4) with this origin and these Z-Y-X angles.

    Args:
        x: of the origin, m.
        y: of the origin, m.
        yaw: about z, rad.
        z: of the origin, m.
        pitch: about the yawed y axis, rad.
        roll: about the pitched x axis, rad.

    Raises:
        InvalidInput: a coordinate or an angle is not a finite number.
    """
    try:
        cy, sy, cp, sp, cr, sr = cos(yaw), sin(yaw), cos(pitch), sin(pitch), cos(roll), sin(roll)
        total = x + y + z + yaw + pitch + roll
        good = isinstance(total, float) and abs(total) <= LARGEST
    except _WRONG:
        good = False
    if not good:
        for name, value in (("x", x), ("y", y), ("z", z)):
            finite_number(value, name, "m")
        for name, value in (("yaw", yaw), ("pitch", pitch), ("roll", roll)):
            finite_number(value, name, "rad")
    # fmt: off
    pose = np.array((  # row after row: numpy reads a flat tuple twice as fast as a nested list
        cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr, x,
        sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr, y,
        -sp, cp * sr, cp * cr, z,
        0.0, 0.0, 0.0, 1.0,
    )).reshape(4, 4)
    # fmt: on
    pose.setflags(write=False)
    return pose


def rpy_of(pose: Array) -> tuple[float, float, float]:
    """Return (roll, pitch, yaw) in radians of a pose's rotation; pitch in [-pi/2, pi/2].

    Raises:
        InvalidInput: it is no (4, 4) array of numbers.
    """
    try:
        r20 = min(1.0, max(-1.0, float(pose[2, 0])))
        roll = atan2(float(pose[2, 1]), float(pose[2, 2]))
    except _WRONG:
        raise _no_pose(pose) from None
    return roll, -asin(r20), yaw_of(pose)


def yaw_of(pose: Array) -> float:
    """Return the heading (rad, in [-pi, pi]) of a pose's x axis, seen from above.

    Raises:
        InvalidInput: it is no (4, 4) array of numbers.
    """
    try:
        return atan2(float(pose[1, 0]), float(pose[0, 0]))
    except _WRONG:
        raise _no_pose(pose) from None


def heading_of(pose: Array) -> Heading:
    """Return (x, y, yaw) of a pose.

    Raises:
        InvalidInput: it is no (4, 4) array of numbers.
    """
    try:
        return float(pose[0, 3]), float(pose[1, 3]), yaw_of(pose)
    except _WRONG:
        raise _no_pose(pose) from None


def midfeet(left: Array, right: Array) -> Heading:
    """Return the heading frame halfway between two soles.

    Args:
        left: pose (4, 4) of the left sole.
        right: pose (4, 4) of the right sole.

    Raises:
        InvalidInput: one is no (4, 4) array of numbers.
    """
    (x0, y0, turned), (x1, y1, yaw) = heading_of(left), heading_of(right)
    return 0.5 * (x0 + x1), 0.5 * (y0 + y1), yaw + 0.5 * wrap(turned - yaw)


def compose(frame: Heading, dx: float, dy: float, dyaw: float = 0.0) -> Heading:
    """Return the planar frame that stands somewhere in another one.

    Args:
        frame: the other one.
        dx: along its x axis, m.
        dy: along its y axis, m.
        dyaw: turn from its heading, rad.

    Raises:
        InvalidInput: the frame is not three numbers, or the place is none.
    """
    try:
        x, y, yaw = frame
        c, s = cos(yaw), sin(yaw)
        return x + c * dx - s * dy, y + s * dx + c * dy, yaw + dyaw
    except _WRONG:
        raise _no_frame(frame, (dx, dy, dyaw)) from None


def relative(frame: Heading, other: Heading) -> Heading:
    """Return a frame in the coordinates of another one; the yaw in [-pi, pi).

    Args:
        frame: the one whose coordinates these are.
        other: the one that is looked at.

    Raises:
        InvalidInput: a frame is not three numbers.
    """
    try:
        dx, dy = other[0] - frame[0], other[1] - frame[1]
        c, s = cos(frame[2]), sin(frame[2])
        x, y, turn = c * dx + s * dy, c * dy - s * dx, wrap(other[2] - frame[2])
    except _WRONG:
        raise _no_frame(frame, other) from None
    if not isinstance(x, float):
        raise _no_frame(frame, other)
    return x, y, turn


def as_pose(value: object, name: str) -> Array:
    """Return `value` as a read-only (4, 4) pose.

    Args:
        value: (4, 4) homogeneous matrix, m.
        name: of the argument, for the sentence of an error.

    Raises:
        InvalidInput: it is not a finite homogeneous matrix with a rotation in its corner.
    """
    form = "a finite (4, 4) homogeneous pose with an orthonormal right-handed rotation"
    if isinstance(value, np.ndarray) and value.dtype == np.float64 and not value.flags.writeable:
        pose = value
    else:
        pose = real_array(value, name, form).copy()
        pose.setflags(write=False)
    if pose.shape != (4, 4) or not _is_rigid(pose):
        came = " ".join(repr(value).split()) if pose.shape == (4, 4) else shown(value)
        raise InvalidInput(f"{name} must be {form}, got {came}.", argument=name)
    return pose


def as_heading(value: object, name: str) -> Heading:
    """Return (x, y) or (x, y, yaw) as a heading frame.

    Args:
        value: two or three numbers, m and rad.
        name: of the argument, for the sentence of an error.

    Raises:
        InvalidInput: it does not hold two or three finite numbers.
    """
    form = "(x, y) or (x, y, yaw) in m and rad"
    numbers = real_array(value, name, form)
    if numbers.shape not in ((2,), (3,)) or not np.abs(numbers).max() <= LARGEST:
        raise InvalidInput(f"{name} must be {form}, got {shown(value)}.", argument=name)
    x, y, *yaw = numbers.tolist()
    return x, y, yaw[0] if yaw else 0.0


def _no_pose(value: object) -> InvalidInput:
    """Return the refusal of what is no pose."""
    return InvalidInput(f"a pose must be a (4, 4) array, got {shown(value)}.", argument="pose")


def _no_frame(frame: object, other: object) -> InvalidInput:
    """Return the refusal of two frames of which one is none."""
    came = f"{shown(frame)} and {shown(other)}"
    return InvalidInput(f"frames must be (x, y, yaw) in m and rad, got {came}.", argument="frame")


def _is_rigid(pose: Array) -> bool:
    """Return whether the rotation is one to 1e-6 and the origin within 1e9 m."""
    (a, b, c, x), (d, e, f, y), (g, h, i, z), last = pose.tolist()
    return bool(
        abs(a * a + d * d + g * g - 1.0) < 1e-6
        and abs(b * b + e * e + h * h - 1.0) < 1e-6
        and abs(a * b + d * e + g * h) < 1e-6
        and abs(d * h - g * e - c) < 1e-6
        and abs(g * b - a * h - f) < 1e-6
        and abs(a * e - d * b - i) < 1e-6
        and abs(x) + abs(y) + abs(z) <= LARGEST
        and last == [0.0, 0.0, 0.0, 1.0]
    )
