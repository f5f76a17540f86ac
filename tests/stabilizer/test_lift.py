"""The lift observer: Newton's law, by hand."""

from __future__ import annotations

import numpy as np
import pytest

from preview_walk.stabilizer.lift import (
    LIFTED,
    RELEASED,
    Lift,
    Rise,
    Twist,
    observe_lift,
    observe_twist,
)

G = 9.81
DT = 0.002


def observed(lift: float, load: float, planned: float, ticks: int, before: Lift) -> Lift:
    """Return what is observed of a CoM that a constant lift and load (of the weight) move."""
    last = before.last or Rise(0.0, 0.0, load, planned)
    for k in range(ticks + 1):
        velocity = last.velocity + G * (lift + load - 1.0) * DT * k
        now = Rise(last.t + DT * k, velocity, load, planned)
        if k or before.last is None:
            before = observe_lift(before, now, G)
    return before


def test_a_lift_is_told_within_twenty_milliseconds() -> None:
    lift = observed(1.02, 0.9, 0.9, 10, Lift())
    assert lift.lifted
    assert observed(1.02, 0.0, 0.0, 50, Lift()).share == pytest.approx(1.02, abs=1e-3)


@pytest.mark.parametrize("load", [0.0, 0.4, 1.0, 2.5])
def test_falling_standing_and_landing_lift_nobody(load: float) -> None:
    assert observed(0.0, load, load, 50, Lift()).share == pytest.approx(0.0, abs=1e-9)


def test_dead_sensors_lift_nobody() -> None:
    """The robot rests on a ground that nothing measures, as the tracker planned it."""
    lift = Lift()
    for k in range(50):
        lift = observe_lift(lift, Rise(DT * k, 0.0, 0.0, 1.0), G)
    assert lift.share == pytest.approx(0.0, abs=1e-9)


def test_who_is_lifted_stays_so_until_most_of_it_is_gone() -> None:
    between = 0.5 * (LIFTED + RELEASED)
    assert not observed(between, 0.0, 0.0, 50, Lift()).lifted
    lift = observed(between, 0.0, 0.0, 50, observed(1.1, 0.0, 0.0, 50, Lift()))
    assert lift.lifted
    assert not observed(0.0, 0.0, 0.0, 50, lift).lifted


def test_what_turns_a_lifted_robot_is_the_rate_of_its_angular_momentum() -> None:
    twist: Twist | None = None
    for k in range(50):
        twist = observe_twist(twist, DT * k, np.array((1.0, 3.0 * DT * k, 0.0)))
    assert twist is not None
    assert twist.moment == pytest.approx((0.0, 3.0, 0.0), abs=0.01)
