"""The slowest rates: refused below the bound, walked at it."""

from __future__ import annotations

import re

import pytest

import preview_walk as pw
from preview_walk.errors import InvalidInput
from preview_walk.footsteps.plan import FootstepPlan
from preview_walk.robots.robot import Robot
from preview_walk.simulation.rates import require_rates
from preview_walk.tracking.gains import TrackingGains


@pytest.mark.parametrize(
    ("physics_hz", "control_hz", "argument", "sentence"),
    [
        (1, 1, "control_hz", "control_hz must be at least 50, twice the fastest feedback"),
        (1000, 49.9, "control_hz", "got 49.9."),
        (99, 99, "physics_hz", "physics_hz must be at least 100 for the feet to stand firm"),
        (1000, float("nan"), "control_hz", "got nan."),
    ],
)
def test_slower_rates_are_refused_with_the_bound(
    physics_hz: float, control_hz: float, argument: str, sentence: str
) -> None:
    with pytest.raises(InvalidInput, match=re.escape(sentence)) as caught:
        require_rates(physics_hz, control_hz, TrackingGains())
    assert caught.value.argument == argument


def test_the_bound_follows_the_gains() -> None:
    require_rates(100, 60, TrackingGains(dcm=30.0))
    with pytest.raises(InvalidInput, match="must be at least 62, twice"):
        require_rates(100, 60, TrackingGains(dcm=31.0))


def test_a_robot_walks_at_the_bound(talos: Robot, short_plan: FootstepPlan) -> None:
    record = pw.simulate(talos, short_plan, physics_hz=100, control_hz=50)
    assert not record.run.fell
    # 0.3 mm is measured; a walk at a rate out of the feedback's reach has centimetres.
    assert max(value or 0.0 for value in record.summary().com_error_rms) < 1e-3
