"""The disturbance observer against a pendulum simulated in closed form."""

from __future__ import annotations

from math import exp

import numpy as np
import pytest

from preview_walk.stabilizer.disturbance import SMOOTHING_TIME, Disturbance, observe
from preview_walk.types import Array

OMEGA, DT = 3.3, 0.006


def pushed(rate: Array, zmp: Array, ticks: int) -> Disturbance:
    """Return the estimate after so many observations of a pendulum under a constant push."""
    xi, seen = np.array((0.01, 0.02)), Disturbance()
    for k in range(ticks):
        seen = observe(seen, k * DT, xi, zmp, OMEGA)
        # xi' = omega (xi - zmp) + rate, exactly over one observation.
        rest = zmp - rate / OMEGA
        xi = rest + (xi - rest) * exp(OMEGA * DT)
    return seen


def test_a_constant_push_is_found() -> None:
    rate = np.array((0.25, -0.1))
    # The mean of two ends stands for the integral: (omega dt)^2 / 12 of what xi moves, below 1e-4.
    assert pushed(rate, np.array((0.03, -0.01)), 60).rate == pytest.approx(rate, abs=1e-4)


def test_what_the_zmp_explains_is_no_push() -> None:
    assert pushed(np.zeros(2), np.array((0.05, 0.02)), 30).rate == pytest.approx(0.0, abs=1e-4)


def test_the_estimate_is_a_first_order_lag() -> None:
    """An observation shows 1 / (1 + tau / dt) of a push, the next one as much of the rest."""
    share = 1.0 / (1.0 + SMOOTHING_TIME / DT)
    rate = np.array((0.2, 0.0))
    for ticks, seen in ((2, share), (3, 1.0 - (1.0 - share) ** 2)):
        assert pushed(rate, np.zeros(2), ticks).rate[0] == pytest.approx(0.2 * seen, rel=1e-3)


def test_the_first_observation_tells_nothing() -> None:
    seen = observe(Disturbance(), 1.0, np.array((0.3, 0.1)), np.zeros(2), OMEGA)
    assert (seen.rate == 0.0).all()
    assert seen.time == 1.0
