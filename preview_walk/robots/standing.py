"""How a robot stands: on two soles anywhere, and with its CoM at another height."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pinocchio as pin

from preview_walk.arguments import as_number, instance_of, shown
from preview_walk.errors import InvalidInput
from preview_walk.geometry.poses import as_pose, midfeet, pose_at
from preview_walk.pattern.com_height import LONGEST_STRETCH, LOWEST_HIPS
from preview_walk.robots.building.inverse_kinematics import Stop, gauss_newton, sole_rows
from preview_walk.robots.building.posture import Stance, walking_posture
from preview_walk.robots.robot import Robot
from preview_walk.types import FEET, Array

_SOLES = Stop(tolerance=1e-9, iterations=50, exact=12)


def stance_of(robot: Robot) -> Stance:
    """Return the stance of a robot's walking posture."""
    soles = {foot: robot.soles[foot].frame for foot in FEET}
    return Stance(robot.pin, soles, robot.legs, robot.step_width)


def standing_configuration(robot: Robot, left: Array, right: Array) -> Array:
    """Return the configuration in which a robot stands on two soles.

    The walking posture, moved to the soles; where they are not as far apart as in the posture, the
    legs follow by inverse kinematics with the CoM above midfeet at its usual height.

    Args:
        robot: the robot.
        left: pose (4, 4) of the left sole in the world, m.
        right: pose (4, 4) of the right sole in the world, m.

    Returns:
        Pinocchio's configuration (nq,).

    Raises:
        InvalidInput: a pose that is none, or soles that the legs cannot reach.
    """
    instance_of(robot, Robot, "robot")
    model, stance = robot.pin, stance_of(robot)
    soles = dict(zip(FEET, (as_pose(left, "left"), as_pose(right, "right")), strict=True))
    targets = {foot: pin.SE3(np.array(pose)) for foot, pose in soles.items()}
    x, y, yaw = midfeet(soles["left"], soles["right"])
    z = 0.5 * float(soles["left"][2, 3] + soles["right"][2, 3])
    q = np.array(robot.posture)
    q[:7] = pin.SE3ToXYZQUAT(pin.SE3(pose_at(x, y, yaw, z)) * pin.XYZQUATToSE3(q[:7]))
    com = np.array((x, y, z + robot.com_height))
    upright = pin.XYZQUATToSE3(q[:7]).rotation
    data = model.createData()

    def residual(q: Array) -> tuple[Array, Array]:
        pin.computeJointJacobians(model, data, q)
        pin.updateFramePlacements(model, data)
        terms = [
            sole_rows(model, data, stance.soles[foot], targets[foot], robot.legs[foot].unplaced)
            for foot in FEET
        ]
        errors, rows = map(list, zip(*terms, strict=True))
        errors.append(pin.centerOfMass(model, data, q) - com)
        rows.append(pin.jacobianCenterOfMass(model, data, q))
        errors.append(pin.log3(upright.T @ data.oMi[1].rotation))
        rows.append(pin.getJointJacobian(model, data, 1, pin.ReferenceFrame.LOCAL)[3:])
        return np.concatenate(errors), np.vstack(rows)

    q, left_over = gauss_newton(model, q, stance.free, residual, _SOLES)
    if not left_over < _SOLES.tolerance:
        apart = float(np.linalg.norm(soles["left"][:3, 3] - soles["right"][:3, 3]))
        raise InvalidInput(
            f"step_width: {robot.name} cannot stand on soles {apart:.3f} m apart at its walking "
            f"height; it stands on soles {robot.step_width:.3f} m apart.",
            argument="step_width",
        )
    return q


def at_com_height(robot: Robot, com_height: float) -> Robot:
    """Return a robot whose walking posture has its CoM at another height.

    Args:
        robot: the robot.
        com_height: height of the CoM above the soles, m.

    Raises:
        InvalidInput: a height that asks for a locked knee or a squat.
    """
    instance_of(robot, Robot, "robot")
    data = robot.pin.createData()
    pin.framesForwardKinematics(robot.pin, data, robot.posture)
    hip = float(data.oMi[robot.legs["left"].hip].translation[2])
    low, high = (
        robot.com_height + share * robot.leg_length - hip
        for share in (LOWEST_HIPS, LONGEST_STRETCH)
    )
    wanted = as_number(com_height)
    if not low <= wanted <= high:
        raise InvalidInput(
            f"com_height must be between {low:.3f} and {high:.3f} m for the legs of {robot.name}, "
            f"got {shown(com_height)}.",
            argument="com_height",
        )
    stance, posture, height = stance_of(robot), robot.posture, robot.com_height
    while abs(height - wanted) > 1e-9:
        hip += wanted - height
        posture = walking_posture(stance, posture, hip / robot.leg_length)
        height = float(pin.centerOfMass(robot.pin, data, posture)[2])
    return replace(robot, posture=posture, com_height=height)
