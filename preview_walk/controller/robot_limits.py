"""What a robot's body means for a plan: the steps that its legs and hips can make."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

import numpy as np
import pinocchio as pin

from preview_walk.arguments import instance_of
from preview_walk.footsteps.limits import GaitLimits
from preview_walk.pattern.com_height import LegGeometry
from preview_walk.robots.robot import Robot


def gait_limits(robot: Robot) -> GaitLimits:
    """Return the bounds of the steps that the robot's legs can make.

    Raises:
        InvalidInput: it is no robot.
    """
    instance_of(robot, Robot, "robot")
    return GaitLimits.for_leg(robot.leg_length, robot.step_width, robot.sole)


def leg_geometry(robot: Robot) -> LegGeometry:
    """Return what the CoM's height over long steps depends on, from the walking posture."""
    data = robot.pin.createData()
    pin.framesForwardKinematics(robot.pin, data, robot.posture)
    hip, sole = data.oMi[robot.legs["left"].hip], data.oMf[robot.soles["left"].frame]
    height = hip.translation[2] - sole.translation[2]
    return LegGeometry(robot.leg_length, float(height), robot.com_height)


SPEED_SHARE = 0.72
"""Share of the hips' speed limits that the way of a swinging foot may take; its lift needs more."""

_PEAK = 1.875
"""Peak over mean speed of a swing, which is a quintic: 15 / 8."""


def command_limits(robot: Robot) -> GaitLimits:
    """Return the bounds of the steps made by velocity commands: `gait_limits`, cut where needed.

    The turn of a step is cut to what the hips' yaw joints can turn in a slow swing, its length to
    what the hips' pitch joints can swing at full speed; a commanded velocity then saturates there.
    """
    limits = gait_limits(robot)
    swing = limits.slow_step_time * (1.0 - limits.slow_double_support)
    # Both hips share the turn between the soles.
    turn = 2.0 * SPEED_SHARE * _hip_speed(robot, 2) * swing / _PEAK
    turns = min(1.0, turn / (limits.turn_out + limits.turn_in))
    # The swing foot travels two step lengths, and the hips, which go on steadily, one.
    time = limits.fast_step_time
    swing = time * (1.0 - limits.fast_double_support)
    data = robot.pin.createData()
    pin.framesForwardKinematics(robot.pin, data, robot.posture)
    hip = float(data.oMi[robot.legs["left"].hip].translation[2])
    length = SPEED_SHARE * _hip_speed(robot, 1) * hip / (2.0 * _PEAK / swing - 1.0 / time)
    return replace(
        limits,
        forward=min(limits.forward, length),
        backward=min(limits.backward, length),
        turn_out=turns * limits.turn_out,
        turn_in=turns * limits.turn_in,
    )


def _hip_speed(robot: Robot, axis: int) -> float:
    """Return the least speed limit (rad/s) of the leg joints before the knees about a world axis.

    `axis`: 1 lateral, 2 vertical; a joint counts that is within 45 degrees of it in the posture.
    """
    axes = pin.computeJointJacobians(robot.pin, robot.pin.createData(), robot.posture)[3 + axis]
    speeds = (float(robot.v_limit[i]) for i in _hip(robot) if abs(axes[6 + i]) > 0.7)
    return min(speeds, default=np.inf)


def _hip(robot: Robot) -> Iterable[int]:
    """Yield the indices of the leg joints before the knees."""
    for leg in robot.legs.values():
        for joint in leg.joints[: leg.joints.index(leg.knee)]:
            yield robot.pin.joints[joint].idx_v - 6
