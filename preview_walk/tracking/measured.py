"""What a measured state may be: finite, upright in form, and no faster than matter moves.

A sensor that fails for one tick gives zeros, nan or nonsense. Such a state has no safe answer and
must not reach the QP: `StateError` stops the walk with a sentence that says what was measured.
"""

from __future__ import annotations

from collections.abc import Mapping
from math import inf, pi

import numpy as np

from preview_walk.arguments import shown
from preview_walk.errors import PreviewWalkError
from preview_walk.robots.robot import Robot
from preview_walk.types import FEET, Array, Foot

FASTEST = 343.0
"""No part of a walking machine moves faster than sound (m/s): a joint that turns so fast that the
end of a leg would is not measured right. Motors of humanoids are twenty times slower."""

TURN = 2.0 * pi
"""No joint is a whole turn (rad) beyond its stops, nor further from its zero if it has none and
less than `TURNS`."""

TURNS = 1e3
"""Nor has a joint without stops been turned further than this (rad) in a walk."""

FARTHEST = 1e6
"""The base is no further (m) from the origin: there a float is off by a tenth of a nanometre."""

SLOW = 100.0
"""Speeds (m/s, rad/s together) below this are no news and need no closer look."""

UNIT = 1e-3
"""Share by which the length of a quaternion may differ from one."""


class StateError(PreviewWalkError):
    """The measured state cannot be."""


def check_state(q: Array, v: Array, robot: Robot) -> None:
    """Raise `StateError` unless a measured state can be; a few microseconds where it can.

    Args:
        q: (nq,) configuration, Pinocchio's conventions.
        v: (nv,) velocity, Pinocchio's conventions.
        robot: whose state it is.
    """
    try:
        # Sums of squares are large or nan if any number is: only then each is looked at.
        joints, turn, base = q[7:], q[3:7], q[:3]
        usual = (
            q.dtype == v.dtype == np.float64
            and joints @ joints < TURN**2
            and -UNIT < turn @ turn - 1.0 < UNIT
            and base @ base < FARTHEST**2
            and v @ v < SLOW**2
            and len(v) == robot.pin.nv
            and len(q) == robot.pin.nq
        )
    except (AttributeError, TypeError, ValueError):
        usual = False
    if not usual:
        _look(q, v, robot)


def check_wrenches(wrenches: Mapping[Foot, Array]) -> None:
    """Raise `StateError` unless the soles' measured wrenches (6,) are finite."""
    for foot in FEET:
        # A sum is finite where all of its terms are.
        if not -inf < float(wrenches[foot].sum()) < inf:
            raise StateError(
                f"the measured state must be finite, got {wrenches[foot].tolist()} for the wrench "
                f"on the {foot} sole."
            )


def _look(q: Array, v: Array, robot: Robot) -> None:
    """Raise `StateError` for the first number of a state that cannot be, if any."""
    for values, size, name in ((q, robot.pin.nq, "q"), (v, robot.pin.nv, "v")):
        if np.shape(values) != (size,) or np.asarray(values).dtype.kind not in "fiu":
            raise StateError(f"the measured {name} must be {size} numbers, got {shown(values)}.")
    for values, kind in ((q, "position"), (v, "velocity")):
        bad = np.flatnonzero(~np.isfinite(values))
        if bad.size:
            where = _place(int(bad[0]) - (len(values) - robot.pin.nv + 6), robot)
            raise StateError(
                f"the measured state must be finite, got {values[bad[0]]} "
                f"for the {kind} of {where}."
            )
    length = float(np.linalg.norm(q[3:7]))
    if not abs(length**2 - 1.0) < UNIT:
        raise StateError(
            f"the measured orientation of the base must be a unit quaternion, got one of length "
            f"{length:.3g}."
        )
    far = np.abs(q[:3]).max()
    if not far < FARTHEST:
        raise StateError(
            f"the measured base must be within {FARTHEST:g} m of the origin, got {far:.3g} m."
        )
    _look_at_joints(q[7:], robot)
    most = np.full(len(v), FASTEST / robot.leg_length)
    most[:3] = FASTEST
    fast = np.flatnonzero(np.abs(v) > most)
    if fast.size:
        joint, unit = int(fast[0]) - 6, "m/s" if fast[0] < 3 else "rad/s"
        raise StateError(
            f"the measured speed of {_place(joint, robot)} must be within {most[fast[0]]:.0f} "
            f"{unit}, at which the leg would be as fast as sound, got {v[fast[0]]:.3g} {unit}."
        )


def _look_at_joints(angles: Array, robot: Robot) -> None:
    """Raise `StateError` for the first joint that is a turn beyond its stops."""
    low = np.where(np.isfinite(robot.q_lower), robot.q_lower - TURN, -TURNS)
    high = np.where(np.isfinite(robot.q_upper), robot.q_upper + TURN, TURNS)
    beyond = np.flatnonzero((angles < low) | (angles > high))
    if beyond.size:
        joint = int(beyond[0])
        raise StateError(
            f"the measured position of {_place(joint, robot)} must be between {low[joint]:.2f} and "
            f"{high[joint]:.2f} rad, a turn beyond its stops, got {angles[joint]:.3g} rad."
        )


def _place(joint: int, robot: Robot) -> str:
    """Return how a sentence names a joint; those below 0 are the base's."""
    return f"joint '{robot.joint_names[joint]}'" if joint >= 0 else "the base"
