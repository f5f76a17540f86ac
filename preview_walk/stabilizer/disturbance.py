"""The disturbance observer: how fast something pushes the DCM, from one planning tick to the next.

A pendulum's DCM obeys xi' = omega (xi - p) + d. The observer compares what xi did between two
instants with what omega (xi - p) accounts for, and smooths the difference by a first-order lag.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np

from preview_walk.constants import GRAVITY
from preview_walk.pattern.walking_pattern import ComReference
from preview_walk.types import Array

SMOOTHING_TIME = 0.0072
"""Time constant (s) of the estimate's first-order lag: every touch of a foot disturbs it."""

ROUGH_SMOOTHING_TIME = 0.1
"""The same on ground that is not known: soles rock on edges at some 10 Hz, and an estimate that
follows them moves the wanted centre of pressure to and fro, which rocks them on."""

STEADY_TIME = 0.3
"""Time constant (s) over which a disturbance comes to be taken for one that stays: about half
a step, so that most of what every step does cancels out, and wind is leant against in time."""

MOST_STEADY = 0.15
"""No force that stays is taken for larger than this share of the weight."""


@dataclass(frozen=True, eq=False)
class Disturbance:
    """The observer's estimate and what it needs to go on; the first one knows nothing.

    Attributes:
        rate: (2,) estimated d, world, m/s: the push's force over mass and omega.
        time: of the last observation, s; None before the first.
        dcm: (2,) observed then, m.
    """

    rate: Array = field(default_factory=lambda: np.zeros(2))
    time: float | None = None
    dcm: Array = field(default_factory=lambda: np.zeros(2))


def observe(
    last: Disturbance,
    t: float,
    dcm: Array,
    zmp: Array,
    omega: float,
    *,
    lag: float = SMOOTHING_TIME,
) -> Disturbance:
    """Return the estimate at time t (s).

    Args:
        last: the estimate before.
        t: now, s; after `last.time`.
        dcm: (2,) measured DCM, world, m.
        zmp: (2,) the point that drove the DCM since then, world, m.
        omega: natural frequency of the pendulum, 1/s.
        lag: time constant of the smoothing, s.
    """
    if last.time is None:
        return Disturbance(last.rate, t, dcm)
    elapsed = t - last.time
    explained = omega * (0.5 * (dcm + last.dcm) - zmp)
    now = (dcm - last.dcm) / elapsed - explained
    rate = last.rate + (now - last.rate) / (1.0 + lag / elapsed)
    return Disturbance(rate, t, dcm)


def steady(last: Array, rate: Array, elapsed: float, omega: float) -> Array:
    """Return the part (2,) of a disturbance that stays, world, m/s.

    Args:
        last: the part before.
        rate: (2,) the disturbance now, m/s.
        elapsed: time since then, s.
        omega: natural frequency of the pendulum, 1/s.
    """
    most = MOST_STEADY * GRAVITY / omega
    size = float(np.hypot(rate[0], rate[1]))
    counted = rate if size <= most else rate * (most / size)
    value: Array = last + (counted - last) * (elapsed / (elapsed + STEADY_TIME))
    return value


def leaning(reference: ComReference, lean: Array) -> ComReference:
    """Return the reference of a robot that leans against a disturbance that stays.

    With d for good, xi' = omega (xi - p) + d is the pendulum of xi + d / omega: that is what must
    follow the reference, with its own ZMP. A payload or a CoM that is elsewhere than in the model
    is such a disturbance, and then xi + d / omega is where the DCM really is.

    Args:
        reference: of the CoM now.
        lean: (2,) d / omega, world, m.
    """
    com = np.array(reference.com)
    com[:2] -= lean
    return replace(reference, com=com, zmp=reference.zmp - lean)
