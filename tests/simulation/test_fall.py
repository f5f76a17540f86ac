"""A fall is seen by its height and by its tilt, each by itself."""

from __future__ import annotations

import numpy as np
import pinocchio as pin

from preview_walk.robots.robot import Robot
from preview_walk.simulation.fall import FALL_HEIGHT, FALL_TILT, fall_reason
from preview_walk.tracking.dynamics import Dynamics


def tilted(robot: Robot, angle: float) -> Dynamics:
    """Return the robot in its posture, turned as a whole by `angle` (rad) forward."""
    dynamics, q = Dynamics(robot), np.array(robot.posture)
    turn = pin.SE3(pin.utils.rotate("y", angle), np.zeros(3))
    q[:7] = pin.SE3ToXYZQUAT(turn * pin.XYZQUATToSE3(q[:7]))
    dynamics.update(q, np.zeros(robot.pin.nv))
    return dynamics


def test_who_stands_has_not_fallen(talos: Robot) -> None:
    assert fall_reason(tilted(talos, 0.0), talos.com_height) is None
    assert fall_reason(tilted(talos, 0.9 * FALL_TILT), 0.5 * talos.com_height) is None


def test_a_tilt_is_a_fall_even_where_the_com_is_high(talos: Robot) -> None:
    for angle in (1.01 * FALL_TILT, -1.01 * FALL_TILT):
        reason = fall_reason(tilted(talos, angle), 0.1)
        assert reason == f"the torso leaned {np.degrees(1.01 * FALL_TILT):.0f} degrees"


def test_a_low_com_is_a_fall_even_upright(talos: Robot) -> None:
    height = talos.com_height
    assert fall_reason(tilted(talos, 0.0), 0.99 * height / FALL_HEIGHT) is None
    reason = fall_reason(tilted(talos, 0.0), 1.01 * height / FALL_HEIGHT)
    assert reason is not None
    assert reason.startswith(f"the CoM sank to {height:.2f} m of ")
