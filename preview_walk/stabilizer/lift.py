"""The lift observer: what holds a robot up beside the ground.

Newton's law for the whole robot: mass (acceleration + g) less what the soles carry. Unlike
`disturbance` it needs no pendulum; walks, landings and pushes along the ground leave it below a
tenth of the weight. A sole carries what its sensor reads or what the tracker planned, whichever is
more: where the sensors are dead nothing lifts the robot.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from preview_walk.stabilizer.disturbance import SMOOTHING_TIME
from preview_walk.types import Array

LIFTED = 0.9
"""A robot is lifted from this share of its weight on: less leaves its feet on the ground."""

RELEASED = 0.5
"""And no longer below this share."""


class Rise(NamedTuple):
    """What the lift observer looks at in one instant: numbers alone, as it does so every tick.

    Attributes:
        t: when, s.
        velocity: of the CoM, upward, m/s.
        load: of both soles as measured, as a share of the weight.
        planned: the same as the tracker planned it until now.
    """

    t: float
    velocity: float
    load: float
    planned: float


class Lift(NamedTuple):
    """The observer's estimate and what it needs to go on; the first one knows nothing.

    Attributes:
        share: of the weight, upward, smoothed.
        lifted: whether the robot is taken to be lifted.
        last: what was looked at last; None before the first.
    """

    share: float = 0.0
    lifted: bool = False
    last: Rise | None = None


def observe_lift(before: Lift, now: Rise, gravity: float) -> Lift:
    """Return the estimate of an instant.

    Args:
        before: the estimate before.
        now: what there is to look at, later than the last time.
        gravity: m/s^2.
    """
    last = before.last
    if last is None:
        return Lift(last=now)
    elapsed = now.t - last.t
    acceleration = (now.velocity - last.velocity) / elapsed
    carried = max(now.planned, 0.5 * (now.load + last.load))
    share = acceleration / gravity + 1.0 - carried
    follow = 1.0 / (1.0 + SMOOTHING_TIME / elapsed)
    share = before.share + follow * (share - before.share)
    return Lift(share, share > (RELEASED if before.lifted else LIFTED), now)


@dataclass(frozen=True, eq=False)
class Twist:
    """What turns a lifted robot about its CoM, as observed since it was lifted.

    Attributes:
        t: when, s.
        momentum: (3,) angular, about the CoM, world axes, N·m·s.
        moment: (3,) about the CoM, world axes, smoothed, N·m.
    """

    t: float
    momentum: Array
    moment: Array


def observe_twist(before: Twist | None, t: float, momentum: Array) -> Twist:
    """Return what turns a lifted robot at time t (s).

    Args:
        before: the same a tick before; None if the robot was not lifted then.
        t: now, s.
        momentum: (3,) angular, about the CoM, world axes, N·m·s.
    """
    if before is None:
        return Twist(t, momentum, np.zeros(3))
    elapsed = t - before.t
    change = (momentum - before.momentum) / elapsed
    follow = 1.0 / (1.0 + SMOOTHING_TIME / elapsed)
    return Twist(t, momentum, before.moment + follow * (change - before.moment))
