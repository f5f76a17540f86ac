"""The walking posture: knees bent, soles flat and parallel, trunk upright, CoM over midfeet."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
import pinocchio as pin

from preview_walk.errors import RobotError
from preview_walk.types import FEET, Array, Foot

LATERAL = 0.8
"""Least cosine between a joint's axis and the lateral direction for it to bend the leg."""

MARGIN = 0.05
"""Distance (rad, m) kept from joint limits by joints that the posture does not name."""


@dataclass(frozen=True)
class Leg:
    """A leg's Pinocchio joints, pelvis first; three bend it: `hip`, `knee` and `ankle`.

    `bend` is the sign of a flexing knee's angle; `length` (m) the sum of thigh, shank and foot.
    """

    joints: tuple[int, ...]
    hip: int
    knee: int
    ankle: int
    bend: float
    length: float


def leg_joints(model: pin.Model, frame: int) -> list[int]:
    """Return the joints from the floating base (exclusive) to a frame, root first."""
    chain = [int(j) for j in model.supports[model.frames[frame].parentJoint]]
    return [j for j in chain if j > 1]


def find_leg(model: pin.Model, q: Array, joints: tuple[int, ...], sole: int, lateral: Array) -> Leg:
    """Return a leg by its joints: those about the `lateral` direction (3,) bend it.

    The leg's length is the longest distance from hip to sole: between the axes of hip, knee and
    ankle, seen along the knee's axis, and from the ankle to the sole plane. `q` (nq,) is any
    posture in which the leg's side is `lateral` in world axes.

    Raises `RobotError` where fewer than three joints bend the leg.
    """
    data = model.createData()
    pin.framesForwardKinematics(model, data, q)
    axes = _axes(model, q)
    turns = {j: float(axes[:, model.joints[j].idx_v] @ lateral) for j in joints}
    bending = [j for j in joints if abs(turns[j]) > LATERAL]
    if len(bending) < 3:
        names = ", ".join(model.names[j] for j in bending) or "none"
        raise RobotError(
            f"the leg from '{model.names[joints[0]]}' to '{model.names[joints[-1]]}' has "
            f"{len(bending)} joint(s) about the lateral axis ({names}); "
            "expected hip, knee and ankle"
        )
    hip, knee, ankle = bending[:3]
    axis = axes[:, model.joints[knee].idx_v]
    side = np.eye(3) - np.outer(axis, axis)
    points = [side @ data.oMi[j].translation for j in (hip, knee, ankle)]
    sole_pose = data.oMf[sole]
    drop = sole_pose.rotation[:, 2] @ (data.oMi[ankle].translation - sole_pose.translation)
    length = sum(float(np.linalg.norm(b - a)) for a, b in pairwise(points)) + float(drop)
    return Leg(joints, hip, knee, ankle, float(np.sign(turns[knee])), length)


def _axes(model: pin.Model, q: Array) -> Array:
    """Return every degree of freedom's axis of rotation (3, nv) in the world, 0 for slides."""
    return np.array(pin.computeJointJacobians(model, model.createData(), q)[3:])


def knees_forward(model: pin.Model, legs: Mapping[Foot, Leg]) -> float:
    """Return 1 for knees that point forward when they bend, as ours, -1 for a bird's.

    Both knees together decide, by their limits; without limits they bend as ours.
    """
    room = 0.0
    for leg in legs.values():
        at = model.joints[leg.knee].idx_q
        low, high = model.lowerPositionLimit[at], model.upperPositionLimit[at]
        if np.isfinite(low) and np.isfinite(high):
            room += leg.bend * float(low + high)
    return 1.0 if room >= 0.0 else -1.0


def resting(
    model: pin.Model, q: Array, seen: Mapping[str, float], named: Mapping[str, float]
) -> Array:
    """Return a configuration (nq,): `named` joints at their angles, the rest inside their limits.

    The rest is as `seen` in a keyframe, else as in `q` (nq,).

    Raises `RobotError` for an unknown joint name or an angle outside the joint's limits.
    """
    q = np.array(q)
    index = {str(model.names[j]): model.joints[j].idx_q for j in range(2, model.njoints)}
    for name in seen.keys() & index.keys():
        q[index[name]] = seen[name]
    low, high = model.lowerPositionLimit, model.upperPositionLimit
    margin = np.minimum(MARGIN, 0.1 * np.where(np.isfinite(high - low), high - low, np.inf))
    q[7:] = np.clip(q, low + margin, high - margin)[7:]
    for name, angle in named.items():
        if name not in index:
            raise RobotError(
                f"the posture names the joint '{name}', which the model lacks; "
                f"it has {', '.join(index)}"
            )
        at = index[name]
        if not low[at] <= angle <= high[at]:
            raise RobotError(
                f"the posture puts the joint '{name}' at {angle:g}; "
                f"its limits are {low[at]:g} and {high[at]:g}"
            )
        q[at] = angle
    return q


def walking_posture(
    model: pin.Model,
    q: Array,
    soles: Mapping[Foot, int],
    legs: Mapping[Foot, Leg],
    width: float,
    stretch: float,
    lean: float = 0.0,
) -> Array:
    """Return the walking posture (nq,) by inverse kinematics, the robot facing x.

    `q` (nq,) holds the upright base orientation and all angles but the legs'. These follow from:
    `soles` (Pinocchio frames) flat, level, facing forward and `width` (m) apart; hips `stretch`
    times the leg's length above the soles; base upright; CoM over the midpoint of the soles, which
    lies at the origin, or `lean` (m) to its left.

    Raises `RobotError` where no such posture exists.
    """
    q = np.array(q)
    upright = pin.Quaternion(q[3:7]).toRotationMatrix()
    data = model.createData()
    forward = knees_forward(model, legs)
    free = list(range(6)) + [model.joints[j].idx_v for f in FEET for j in legs[f].joints]
    lateral = np.sign(_axes(model, q)[1])
    for leg in legs.values():
        for joint, angle in ((leg.hip, -0.4), (leg.knee, 0.8), (leg.ankle, -0.4)):
            bend = model.joints[joint]
            q[bend.idx_q] = forward * lateral[bend.idx_v] * angle
    height = stretch * min(leg.length for leg in legs.values())
    target: dict[Foot, pin.SE3] = {
        "left": pin.SE3(np.eye(3), np.array([0.0, width / 2, 0.0])),
        "right": pin.SE3(np.eye(3), np.array([0.0, -width / 2, 0.0])),
    }
    for _ in range(200):
        error, jacobian = _residual(model, data, q, upright, soles, legs, target, (lean, height))
        if np.abs(error).max() < 1e-10:
            return np.asarray(q)
        step = np.zeros(model.nv)
        step[free] = np.linalg.lstsq(jacobian[:, free], -error, rcond=1e-8)[0]
        step *= min(1.0, 0.3 / np.abs(step).max())
        q = pin.integrate(model, q, step)
    raise RobotError(
        f"no walking posture found: the soles stay {np.abs(error).max():.3g} m or rad from "
        f"flat, level and {height:.3f} m below the hips"
    )


def _residual(
    model: pin.Model,
    data: pin.Data,
    q: Array,
    upright: Array,
    soles: Mapping[Foot, int],
    legs: Mapping[Foot, Leg],
    target: Mapping[Foot, pin.SE3],
    goal: tuple[float, float],
) -> tuple[Array, Array]:
    """Return the residual (18,) and its Jacobian (18, nv); `goal`: CoM to the left, hip height."""
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
    errors.append(pin.log3(data.oMi[1].rotation @ upright.T))
    rows.append(pin.getJointJacobian(model, data, 1, world)[3:])
    errors.append(com[:2] - (0.0, goal[0]))
    rows.append(pin.jacobianCenterOfMass(model, data, q)[:2])
    hip = legs["left"].hip
    errors.append(data.oMi[hip].translation[2:] - goal[1])
    rows.append(pin.getJointJacobian(model, data, hip, world)[2:3])
    return np.concatenate(errors), np.vstack(rows)
