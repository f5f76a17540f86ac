"""What a recovery step may be, by hand, for a leg whose pendulum time is one second."""

from __future__ import annotations

import pytest

from preview_walk.constants import GRAVITY
from preview_walk.footsteps.limits import GaitLimits
from preview_walk.geometry.support import Sole
from preview_walk.stabilizer.step_limits import step_limits

LEG = GRAVITY
"""Length (m) of a leg whose pendulum time sqrt(leg / g) is 1 s."""

SOLE = Sole(0.12, 0.05)


def test_reach_and_times_grow_with_the_leg() -> None:
    limits = step_limits(LEG, 0.3, SOLE, 1.5)
    gait = limits.gait
    assert (gait.forward, gait.backward) == pytest.approx((0.7 * LEG, 0.5 * LEG))
    assert gait.max_width == pytest.approx(0.3 + 0.65 * LEG)
    assert limits.swing_time == pytest.approx((1.1, 3.5))
    assert limits.step_out_time == pytest.approx(1.2)
    assert limits.swing_speed == pytest.approx(4.0 * LEG**0.5)
    assert limits.tolerance == pytest.approx(0.03 * LEG)
    assert limits.omega == 1.5


def test_the_zmp_is_held_within_the_length_ahead_and_the_width_aside() -> None:
    limits = step_limits(0.8, 0.2, SOLE, 3.0)
    assert limits.zmp == pytest.approx((0.95 * 0.12, 0.95 * 0.05))
    held = limits.held
    assert (held.half_length, held.half_width) == limits.zmp


def test_what_recovery_does_not_widen_is_as_in_any_walk() -> None:
    gait, usual = step_limits(0.8, 0.2, SOLE, 3.0).gait, GaitLimits.for_leg(0.8, 0.2, SOLE)
    for name in ("sole", "step_width", "min_width", "turn_out", "turn_in", "rise", "clearance"):
        assert getattr(gait, name) == getattr(usual, name)
    assert gait.backward > usual.backward
    assert gait.max_width > usual.max_width
