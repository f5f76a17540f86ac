"""What a robot's body means for a plan: the steps it can make, and how it stands at the start."""

from __future__ import annotations

import numpy as np
import pinocchio as pin

from preview_walk.errors import InvalidInput
from preview_walk.planning.footsteps import FootstepPlan
from preview_walk.planning.limits import GaitLimits
from preview_walk.planning.pose import midfeet, pose_at
from preview_walk.planning.support import Sole
from preview_walk.robots.posture import leg_joints
from preview_walk.robots.robot import Robot
from preview_walk.types import FEET, Array


def gait_limits(robot: Robot) -> GaitLimits:
    """Return the bounds of the steps that the robot's legs can make."""
    sole = Sole(robot.soles["left"].half_length, robot.soles["left"].half_width)
    return GaitLimits.for_leg(robot.leg_length, robot.step_width, sole)


def standing_configuration(robot: Robot, plan: FootstepPlan) -> Array:
    """Return the configuration (nq,) in which the robot stands on the plan's two first soles.

    The walking posture, moved to the soles; where they are not as far apart as in the posture, the
    legs follow by inverse kinematics with the CoM above midfeet at its usual height.

    Raises `InvalidInput` where the legs cannot reach the soles.
    """
    model = robot.pin
    x, y, yaw = midfeet(plan[0].pose, plan[1].pose)
    z = 0.5 * float(plan[0].pos[2] + plan[1].pos[2])
    frame = pin.SE3(pose_at(x, y, yaw, z))
    q = np.array(robot.posture)
    q[:7] = pin.SE3ToXYZQUAT(frame * pin.XYZQUATToSE3(q[:7]))
    soles = {step.foot: pin.SE3(np.array(step.pose)) for step in plan[:2]}
    data = model.createData()
    legs = [
        model.joints[joint].idx_v
        for foot in FEET
        for joint in leg_joints(model, robot.soles[foot].frame)
    ]
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
    apart = float(np.linalg.norm(plan[0].pos - plan[1].pos))
    raise InvalidInput(
        f"step_width: {robot.name} cannot stand on soles {apart:.3f} m apart at its walking "
        f"height; it stands on soles {robot.step_width:.3f} m apart."
    )
