"""The walking posture: knees bent, soles flat and parallel, trunk upright, CoM over midfeet."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import pinocchio as pin

from preview_walk.errors import RobotError
from preview_walk.types import FEET, Array, Foot

STRETCH = 0.92
"""Hip-to-sole distance of the walking posture over that of the stretched leg."""


def leg_joints(model: pin.Model, frame: int) -> list[int]:
    """Return the joints from the floating base (exclusive) to a frame, root first."""
    chain = [int(j) for j in model.supports[model.frames[frame].parentJoint]]
    return [j for j in chain if j > 1]


def leg_length(model: pin.Model, frame: int) -> float:
    """Return the distance from the hip to the sole with the leg stretched (m).

    The hip is where the leg's first three joint axes pass closest (its third joint); the length is
    the sum of the distances between the successive pitch-like joints below it, knee and ankle,
    which no configuration can exceed.
    """
    data = model.createData()
    pin.forwardKinematics(model, data, pin.neutral(model))
    pin.updateFramePlacements(model, data)
    points = [data.oMi[j].translation for j in leg_joints(model, frame)]
    points = [*points[2:], data.oMf[frame].translation]
    return float(sum(np.linalg.norm(b - a) for a, b in zip(points, points[1:], strict=False)))


def walking_posture(
    model: pin.Model,
    soles: Mapping[Foot, int],
    torso: int,
    angles: Mapping[str, float],
    stretch: float = STRETCH,
) -> Array:
    """Return the walking posture (nq,) by inverse kinematics.

    `soles` and `torso` are Pinocchio frames; `angles` (rad) fix the joints they name. The legs
    follow from: soles flat, parallel, level and as far apart as in the zero configuration; hips
    `stretch` times the leg's length above the soles; pelvis upright; CoM over the midpoint of the
    soles, which lies at the origin.

    Raises `RobotError` for an unknown joint name or where no such posture exists.
    """
    q = pin.neutral(model)
    for name, angle in angles.items():
        if not model.existJointName(name):
            raise RobotError(
                f"the posture names the joint '{name}', which the model lacks; "
                f"it has {', '.join(model.names[2:])}"
            )
        q[model.joints[model.getJointId(name)].idx_q] = angle
    data = model.createData()
    pin.framesForwardKinematics(model, data, q)
    width = float(
        (data.oMf[soles["left"]].translation - data.oMf[soles["right"]].translation)[1]
    )
    legs = {foot: leg_joints(model, soles[foot]) for foot in FEET}
    free = list(range(6)) + [model.joints[j].idx_v for foot in FEET for j in legs[foot]]
    knees = [model.joints[legs[foot][3]] for foot in FEET]
    for knee in knees:  # start bent the way the knee bends
        q[knee.idx_q] = 0.5 * np.sign(
            model.lowerPositionLimit[knee.idx_q] + model.upperPositionLimit[knee.idx_q]
        )
    height = stretch * leg_length(model, soles["left"])
    target = {
        foot: pin.SE3(np.eye(3), np.array([0.0, side * width / 2, 0.0]))
        for foot, side in (("left", 1.0), ("right", -1.0))
    }
    for _ in range(100):
        error, jacobian = _residual(model, data, q, soles, legs, target, height)
        if np.abs(error).max() < 1e-10:
            break
        step = np.zeros(model.nv)
        step[free] = np.linalg.lstsq(jacobian[:, free], -error, rcond=1e-8)[0]
        step *= min(1.0, 0.3 / np.abs(step).max())
        q = pin.integrate(model, q, step)
    else:
        raise RobotError(
            f"no walking posture found: the soles stay {np.abs(error).max():.3g} m or rad from "
            f"flat, level and {height:.3f} m below the hips"
        )
    return np.asarray(q)


def _residual(
    model: pin.Model,
    data: pin.Data,
    q: Array,
    soles: Mapping[Foot, int],
    legs: Mapping[Foot, list[int]],
    target: Mapping[Foot, pin.SE3],
    height: float,
) -> tuple[Array, Array]:
    """Return the posture's residual (17,) and its Jacobian (17, nv)."""
    pin.computeJointJacobians(model, data, q)
    pin.updateFramePlacements(model, data)
    com = pin.centerOfMass(model, data, q)
    world = pin.ReferenceFrame.LOCAL_WORLD_ALIGNED
    errors, rows = [], []
    for foot in FEET:
        miss = target[foot].actInv(data.oMf[soles[foot]])
        errors.append(pin.log6(miss).vector)
        rows.append(
            pin.Jlog6(miss)
            @ pin.getFrameJacobian(model, data, soles[foot], pin.ReferenceFrame.LOCAL)
        )
    base = data.oMi[1]
    errors.append(pin.log3(base.rotation)[:2])
    rows.append(pin.getJointJacobian(model, data, 1, world)[3:5])
    errors.append(com[:1])
    rows.append(pin.jacobianCenterOfMass(model, data, q)[:1])
    hip = legs["left"][2]
    errors.append(data.oMi[hip].translation[2:] - height)
    rows.append(pin.getJointJacobian(model, data, hip, world)[2:3])
    return np.concatenate(errors), np.vstack(rows)
