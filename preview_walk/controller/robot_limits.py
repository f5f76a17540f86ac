"""What a robot's body means for a plan: the steps that its legs and hips can make."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import replace
from functools import lru_cache
from math import sqrt

import numpy as np
import pinocchio as pin

from preview_walk.arguments import instance_of
from preview_walk.controller.motor_limits import MotorLimits
from preview_walk.footsteps.limits import GaitLimits
from preview_walk.footsteps.planner import FootstepPlanner
from preview_walk.footsteps.velocity import follow_velocity
from preview_walk.robots.robot import Robot


def gait_limits(robot: Robot) -> GaitLimits:
    """Return the bounds of the steps that the robot's legs can make, and its motors.

    Raises:
        InvalidInput: it is no robot.
    """
    instance_of(robot, Robot, "robot")
    limits = GaitLimits.for_leg(robot.leg_length, robot.step_width, robot.sole)
    return replace(limits, motors=MotorLimits(robot))


USUAL_LENGTH, USUAL_SHARE = 0.25, 0.31
"""Step length of a walk that nobody gave one: so much (m), and no more than this share of the leg,
which TALOS's just is not short of."""

USUAL_BEAT = 3.13
"""Step time of such a walk over the pendulum time sqrt(leg / g): 0.9 s for TALOS."""


def usual_planner(robot: Robot) -> FootstepPlanner:
    """Return a planner of steps that suit a robot of this size: an easy walk.

    Raises:
        InvalidInput: it is no robot.
    """
    leg = instance_of(robot, Robot, "robot").leg_length
    length = min(USUAL_LENGTH, round(USUAL_SHARE * leg, 3))
    time = round(USUAL_BEAT * sqrt(leg / robot.gravity), 2)
    return FootstepPlanner(length, robot.step_width, time)


SPEED_SHARE = 0.72
"""Share of the hips' speed limits that the way of a swinging foot may take; its lift needs more."""

_PEAK = 1.875
"""Peak over mean speed of a swing, which is a quintic: 15 / 8."""

COMMANDED = 0.85
"""Share of what a step may ask of the motors that a commanded walk asks for: it goes on for as
long as it is told to, and turns and sways besides."""

_HALVINGS = 5
"""The longest step that the motors hold is found to a thirtieth of the legs' reach."""

_FASTER = 100.0
"""A command (m/s) that no legs hold: it is scaled down to the limits."""

_LONG_ENOUGH = 6.0
"""So long (s) a command is followed that the walk comes to its full speed."""


def command_limits(robot: Robot) -> GaitLimits:
    """Return the bounds of the steps made by velocity commands: `gait_limits`, cut where needed.

    The turn of a step is cut to what the hips' yaw joints can turn in a slow swing, its length to
    what the hips' pitch joints can swing at full speed, and further to the fastest walk that the
    motors have enough for; a commanded velocity then saturates there.

    Raises:
        InvalidInput: it is no robot.
    """
    return _command_limits(instance_of(robot, Robot, "robot"))


@lru_cache(maxsize=32)
def _command_limits(robot: Robot) -> GaitLimits:
    motors, limits = MotorLimits(robot), _within_hip_speeds(robot)
    forward = _held(limits.forward, lambda m: _holds(motors, replace(limits, forward=m), 1.0))
    # The rhythm of a walk backwards is that of its speed on the way to the longest step forward.
    limits = replace(limits, forward=forward)
    backward = _held(limits.backward, lambda m: _holds(motors, replace(limits, backward=m), -1.0))
    return replace(limits, backward=backward)


def _held(size: float, holds: Callable[[float], bool]) -> float:
    """Return the longest step (m) up to a size that is held; the size where none is.

    Args:
        size: the longest step otherwise, m.
        holds: tells whether the motors hold a walk with this longest step, m.
    """
    if holds(size):
        return size
    low, high = 0.0, float(size)
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if holds(middle) else (low, middle)
    # Where steps on the spot ask for too much already, shorter ones are no help.
    return low or size


def _holds(motors: MotorLimits, limits: GaitLimits, sign: float) -> bool:
    """Return whether the motors have enough for the fastest walk that these limits command."""
    stand = FootstepPlanner(step_width=limits.step_width).stand()
    plan = follow_velocity(stand, 0.0, (sign * _FASTER, 0.0, 0.0), limits, _LONG_ENOUGH)
    return all(need.share <= COMMANDED for _, need in motors.needs(plan))


def _within_hip_speeds(robot: Robot) -> GaitLimits:
    """Return `gait_limits`, cut to what the hips' speeds allow."""
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
