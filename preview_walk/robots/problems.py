"""What will not work: motors too weak for one leg, soles too small, shapes that collide."""

from __future__ import annotations

import numpy as np
import pinocchio as pin

from preview_walk.errors import InvalidInput, RobotError
from preview_walk.geometry.poses import pose_at
from preview_walk.robots.building.posture import walking_posture
from preview_walk.robots.building.stand import CLEARANCE
from preview_walk.robots.building.statics import carrying_torques
from preview_walk.robots.finding.overlaps import overlaps
from preview_walk.robots.robot import Robot
from preview_walk.robots.standing import stance_of, standing_configuration
from preview_walk.types import Array

SMALL_SOLE = 0.1
"""A sole shorter or narrower than this share of the leg's length leaves the ZMP hardly any room:
those of the robots that walk well are 0.25 of it long and 0.07 and more wide."""


def problems_of(robot: Robot) -> tuple[str, ...]:
    """Return what will not work, one sentence each."""
    return (*one_leg_problems(robot), *_sole_problems(robot), *_collisions(robot))


def _sole_problems(robot: Robot) -> tuple[str, ...]:
    """Return that the soles are too small to walk on, in words."""
    length, width = 2.0 * robot.sole.half_length, 2.0 * robot.sole.half_width
    if length < width:
        return (
            f"the soles are {length:.3f} m long but {width:.3f} m wide: the wrong shapes may have "
            "been found",
        )
    if length >= SMALL_SOLE * robot.leg_length:
        return ()
    return (
        f"the soles are {length:.3f} m long, less than a tenth of the leg's {robot.leg_length:.3f} "
        "m: the wrong shapes may have been found, or the robot can hardly balance on them",
    )


def _collisions(robot: Robot) -> tuple[str, ...]:
    """Return which of the robot's shapes meet in the narrowest stance, in words."""
    width = 2.0 * robot.sole.half_width + CLEARANCE
    left, right = pose_at(0.0, 0.5 * width), pose_at(0.0, -0.5 * width)
    try:
        q = standing_configuration(robot, left, right)
    except InvalidInput:  # it cannot stand so narrowly at all
        return ()
    plan = robot.blueprint
    angles = dict(zip(robot.joint_names, q[7:], strict=True))
    pairs = ", ".join(overlaps(plan.tree, plan.parts.base, angles))
    if not pairs:
        return ()
    return (
        f"in its own scene, with the soles {width:.3f} m apart, its shapes push each other apart: "
        f"{pairs}",
    )


def one_leg_torques(robot: Robot) -> Array:
    """Return the torques (nv - 6,) in N·m that hold the robot still over its left sole.

    Statics: the CoM above the sole's centre, all weight on it.

    Raises:
        RobotError: the legs cannot lean so far.
    """
    model = robot.pin
    data = model.createData()
    pin.framesForwardKinematics(model, data, robot.posture)
    hip = float(data.oMi[robot.legs["left"].hip].translation[2])
    lean = robot.step_width / 2
    q = walking_posture(stance_of(robot), robot.posture, hip / robot.leg_length, lean)
    return carrying_torques(model, q, robot.soles["left"].frame)


def one_leg_problems(robot: Robot) -> tuple[str, ...]:
    """Return which motors are too weak to stand on one leg, in words."""
    try:
        torques = np.abs(one_leg_torques(robot))
    except RobotError as error:
        return (f"standing on one leg: {error}",)
    return tuple(
        f"the joint '{name}' needs {torque:.1f} N·m to stand on one leg, its motor gives "
        f"{effort:.1f} N·m"
        for name, torque, effort in zip(robot.joint_names, torques, robot.effort, strict=True)
        if torque > effort > 0.0
    )
