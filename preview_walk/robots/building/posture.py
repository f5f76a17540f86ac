"""The walking posture: knees bent, soles flat and parallel, trunk upright, CoM over midfeet."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import pinocchio as pin

from preview_walk.errors import RobotError
from preview_walk.robots.building.inverse_kinematics import (
    Stop,
    gauss_newton,
    leg_coordinates,
    sole_rows,
)
from preview_walk.robots.building.leg import Leg, bent, knees_forward
from preview_walk.types import FEET, Array, Foot

MARGIN = 0.05
"""Distance (rad, m) kept from joint limits by joints that the posture does not name."""


def resting(
    model: pin.Model, q: Array, seen: Mapping[str, float], named: Mapping[str, float]
) -> Array:
    """Return a configuration (nq,): `named` joints at their angles, the rest inside their limits.

    Args:
        model: the robot, with its joint limits.
        q: configuration (nq,) of what neither of the others names.
        seen: joint angles of a keyframe (rad) by name.
        named: joint angles of a description (rad) by name.

    Raises:
        RobotError: an unknown joint name, or an angle outside the joint's limits.
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


@dataclass(frozen=True, eq=False)
class Stance:
    """What a walking posture stands on.

    Attributes:
        model: the robot, with its joint limits.
        soles: the sole frames.
        legs: the legs above them.
        width: distance of the sole centres, m.
    """

    model: pin.Model
    soles: Mapping[Foot, int]
    legs: Mapping[Foot, Leg]
    width: float

    @property
    def free(self) -> list[int]:
        """The velocity coordinates that inverse kinematics may move: base and legs."""
        return leg_coordinates(self.model, {foot: leg.placing for foot, leg in self.legs.items()})


def walking_posture(stance: Stance, q: Array, stretch: float, lean: float = 0.0) -> Array:
    """Return the walking posture (nq,) by inverse kinematics, the robot facing x.

    The soles are flat, level and facing forward, the base is upright, and the CoM is over the
    midpoint of the soles, which lies at the origin.

    Args:
        stance: soles and legs.
        q: configuration (nq,) with the upright base's orientation and all angles but the legs'.
        stretch: height of the hips above the soles over the leg's length.
        lean: how far the CoM is to the left of the midpoint, m.

    Raises:
        RobotError: no such posture exists.
    """
    model, legs = stance.model, stance.legs
    q = np.array(q)
    upright = pin.Quaternion(q[3:7]).toRotationMatrix()
    forward = knees_forward(model, legs)
    for leg in legs.values():
        q = bent(model, q, leg, forward)
    height = stretch * min(leg.length for leg in legs.values())
    data = model.createData()

    def residual(q: Array) -> tuple[Array, Array]:
        return _residual(stance, data, q, upright, (lean, height))

    q, left = gauss_newton(model, q, stance.free, residual, Stop(1e-10, 200))
    if not left < 1e-10:
        raise RobotError(
            f"no walking posture found: the soles stay {left:.3g} m or rad from "
            f"flat, level and {height:.3f} m below the hips"
        )
    return q


def _residual(
    stance: Stance, data: pin.Data, q: Array, upright: Array, goal: tuple[float, float]
) -> tuple[Array, Array]:
    """Return the residual (18,) and its Jacobian (18, nv); `goal`: CoM to the left, hip height."""
    model = stance.model
    pin.computeJointJacobians(model, data, q)
    pin.updateFramePlacements(model, data)
    com = pin.centerOfMass(model, data, q)
    world = pin.ReferenceFrame.LOCAL_WORLD_ALIGNED
    errors, rows = [], []
    for foot, side in zip(FEET, (0.5, -0.5), strict=True):
        target = pin.SE3(np.eye(3), np.array([0.0, side * stance.width, 0.0]))
        error, jacobian = sole_rows(
            model, data, stance.soles[foot], target, stance.legs[foot].unplaced
        )
        errors.append(error)
        rows.append(jacobian)
    errors.append(pin.log3(data.oMi[1].rotation @ upright.T))
    rows.append(pin.getJointJacobian(model, data, 1, world)[3:])
    errors.append(com[:2] - (0.0, goal[0]))
    rows.append(pin.jacobianCenterOfMass(model, data, q)[:2])
    hip = stance.legs["left"].hip
    errors.append(data.oMi[hip].translation[2:] - goal[1])
    rows.append(pin.getJointJacobian(model, data, hip, world)[2:3])
    return np.concatenate(errors), np.vstack(rows)
