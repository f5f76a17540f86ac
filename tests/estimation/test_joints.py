"""A joint whose encoder is stuck goes on as planned; one that stands still is not stuck."""

from __future__ import annotations

import numpy as np

from preview_walk.estimation.joints import Joints
from preview_walk.estimation.measurement import Measurement

DT = 0.002


def reading(angle: float, speed: float) -> Measurement:
    zero = np.zeros(3)
    return Measurement(np.array((angle, 0.0)), np.array((speed, 0.0)), zero, zero, {})


def test_a_stuck_encoder_is_made_good_for() -> None:
    """At 2 rad/s, slowing by 5 rad/s^2, stuck for 0.06 s."""
    joints, slows = Joints(np.zeros(2)), np.array((-5.0, 0.0))
    for k in range(80):
        t = k * DT
        true, speed = 2.0 * t - 2.5 * t * t, 2.0 - 5.0 * t
        stuck = k >= 50
        held = 2.0 * 0.098 - 2.5 * 0.098**2
        m = reading(held, 0.0) if stuck else reading(true, speed)
        joints.update(m, slows, DT)
        if stuck and k > 53:
            # The readings before it was noticed are lost: 6 ms at 2 rad/s and what followed.
            assert abs(joints.angles[0] - true) < 0.022
            assert abs(joints.speeds[0] - speed) < 0.3
    assert joints.refused > 0


def test_a_joint_at_rest_is_not_stuck() -> None:
    """Friction holds it, whatever acceleration was asked for."""
    joints = Joints(np.zeros(2))
    for _ in range(500):
        joints.update(reading(0.0, 0.0), np.array((30.0, -30.0)), DT)
    assert joints.refused == 0
    np.testing.assert_array_equal(joints.angles, 0.0)
    np.testing.assert_array_equal(joints.speeds, 0.0)
