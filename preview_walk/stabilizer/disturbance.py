"""The disturbance observer: how fast something pushes the DCM, from one planning tick to the next.

A pendulum's DCM obeys xi' = omega (xi - p) + d. The observer compares what xi did between two
instants with what omega (xi - p) accounts for, and smooths the difference by a first-order lag.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from preview_walk.types import Array

SMOOTHING_TIME = 0.0072
"""Time constant (s) of the estimate's first-order lag: every touch of a foot disturbs it."""

ROUGH_SMOOTHING_TIME = 0.1
"""The same on ground that is not known: soles rock on edges at some 10 Hz, and an estimate that
follows them moves the wanted centre of pressure to and fro, which rocks them on."""


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
