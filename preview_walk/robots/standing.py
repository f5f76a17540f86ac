"""How a robot stands: on two soles anywhere, and with its CoM at another height."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pinocchio as pin

from preview_walk.errors import InvalidInput
from preview_walk.geometry.poses import midfeet, pose_at
from preview_walk.pattern.com_height import LONGEST_STRETCH, LOWEST_HIPS
from preview_walk.robots.building.posture import walking_posture
from preview_walk.robots.robot import Robot
from preview_walk.types import FEET, Array


def standing_configuration(robot: Robot, left: Array, right: Array) -> Array:
    """Return the configuration (nq,) in which the robot stands on two soles at these poses (4, 4).

    The walking posture, moved to the soles; where they are not as far apart as in the posture, the
    legs follow by inverse kinematics with the CoM above midfeet at its usual height.

    Raises `InvalidInput` where the legs cannot reach the soles.
    """
    model = robot.pin
    x, y, yaw = midfeet(left, right)
    z = 0.5 * float(left[2, 3] + right[2, 3])
    frame = pin.SE3(pose_at(x, y, yaw, z))
    q = np.array(robot.posture)
    q[:7] = pin.SE3ToXYZQUAT(frame * pin.XYZQUATToSE3(q[:7]))
    soles = {"left": pin.SE3(np.array(left)), "right": pin.SE3(np.array(right))}
    data = model.createData()
    legs = [model.joints[joint].idx_v for leg in robot.legs.values() for joint in leg.joints]
    free = [*range(6), *legs]
    com = np.array((x, y, z + robot.com_height))
    upright = pin.XYZQUATToSE3(q[:7]).rotation
    for _ in range(50):
        errors, rows = [], []
        pin.computeJointJacobians(model, data, q)
        pin.updateFramePlacements(model, data)
        for foot in FEET:
            id_ = robot.soles[foot].frame
            miss = soles[foot].actInv(data.oMf[id_])
            errors.append(pin.log6(miss).vector)
            rows.append(
                pin.Jlog6(miss) @ pin.getFrameJacobian(model, data, id_, pin.ReferenceFrame.LOCAL)
            )
        if max(np.abs(error).max() for error in errors) < 1e-9:
            return q
        errors.append(pin.centerOfMass(model, data, q) - com)
        rows.append(pin.jacobianCenterOfMass(model, data, q))
        errors.append(pin.log3(upright.T @ data.oMi[1].rotation))
        rows.append(pin.getJointJacobian(model, data, 1, pin.ReferenceFrame.LOCAL)[3:])
        step = np.zeros(model.nv)
        step[free] = np.linalg.lstsq(np.vstack(rows)[:, free], -np.concatenate(errors), rcond=1e-8)[
            0
        ]
        q = pin.integrate(model, q, step * min(1.0, 0.3 / np.abs(step).max()))
    apart = float(np.linalg.norm(left[:3, 3] - right[:3, 3]))
    raise InvalidInput(
        f"step_width: {robot.name} cannot stand on soles {apart:.3f} m apart at its walking "
        f"height; it stands on soles {robot.step_width:.3f} m apart."
    )


def at_com_height(robot: Robot, com_height: float) -> Robot:
    """Return a robot whose walking posture has its CoM at this height (m) above the soles.

    Raises `InvalidInput` for a height that asks for a locked knee or a squat.
    """
    data = robot.pin.createData()
    pin.framesForwardKinematics(robot.pin, data, robot.posture)
    hip = float(data.oMi[robot.legs["left"].hip].translation[2])
    low, high = (
        robot.com_height + share * robot.leg_length - hip
        for share in (LOWEST_HIPS, LONGEST_STRETCH)
    )
    if not low <= com_height <= high:
        raise InvalidInput(
            f"com_height must be between {low:.3f} and {high:.3f} m for the legs of {robot.name}, "
            f"got {com_height}."
        )
    soles = {foot: robot.soles[foot].frame for foot in FEET}
    posture, height = robot.posture, robot.com_height
    while abs(height - com_height) > 1e-9:
        hip += com_height - height
        posture = walking_posture(
            robot.pin, posture, soles, robot.legs, robot.step_width, hip / robot.leg_length
        )
        height = float(pin.centerOfMass(robot.pin, data, posture)[2])
    return replace(robot, posture=posture, com_height=height)
