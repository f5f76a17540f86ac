"""What a robot's body means for a plan: the steps it can make, and how it stands at the start."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

import numpy as np
import pinocchio as pin

from preview_walk.errors import InvalidInput
from preview_walk.planning.com_height import LONGEST_STRETCH, LOWEST_HIPS
from preview_walk.planning.footsteps import FootstepPlan
from preview_walk.planning.limits import GaitLimits
from preview_walk.planning.pose import midfeet, pose_at
from preview_walk.planning.support import Sole
from preview_walk.robots.posture import walking_posture
from preview_walk.robots.robot import Robot
from preview_walk.types import FEET, Array


def gait_limits(robot: Robot) -> GaitLimits:
    """Return the bounds of the steps that the robot's legs can make."""
    sole = Sole(robot.soles["left"].half_length, robot.soles["left"].half_width)
    return GaitLimits.for_leg(robot.leg_length, robot.step_width, sole)


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
    apart = float(np.linalg.norm(plan[0].pos - plan[1].pos))
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
