"""Standing still on one leg: what it asks of the motors, and how straight weak knees must stand."""

from __future__ import annotations

import numpy as np
import pinocchio as pin

from preview_walk.robots.building.posture import Stance, walking_posture
from preview_walk.types import FEET, Array

CROUCHED = 0.92
"""Hip-to-sole distance of the walking posture over that of the stretched leg: the knees bend by
0.8 rad, which leaves room for long steps."""

STRETCHED = 0.96
"""The straightest walking posture: the knees still bend by 0.6 rad."""

KNEE_SHARE = 0.7
"""Share of its torque limit that a knee may need to carry the standing robot alone; what is left
is for landing and for the accelerations of the walk."""

_TRIES = 7
"""Bisections: the stretch is found to (STRETCHED - CROUCHED) / 2^7."""


def carrying_torques(model: pin.Model, q: Array, sole: int) -> Array:
    """Return the torques (nv - 6,) in N·m that hold a robot still on one leg.

    Args:
        model: the robot.
        q: its configuration (nq,).
        sole: frame of the sole that carries the whole weight.
    """
    data = model.createData()
    gravity = pin.computeGeneralizedGravity(model, data, q)
    pin.computeJointJacobians(model, data, q)
    pin.updateFramePlacements(model, data)
    jacobian = pin.getFrameJacobian(model, data, sole, pin.ReferenceFrame.LOCAL)
    wrench = np.linalg.solve(jacobian[:, :6].T, gravity[:6])
    return np.asarray((gravity - jacobian.T @ wrench)[6:])


def straightened(stance: Stance, crouched: Array, effort: Array) -> Array:
    """Return the walking posture (nq,) that the knees can hold.

    It is the crouched one; where that asks for more than `KNEE_SHARE` of a knee's limit, as much
    straighter as it takes, up to `STRETCHED`.

    Args:
        stance: soles and legs.
        crouched: the walking posture (nq,) at `CROUCHED`.
        effort: torque limits (n,), N·m.

    Raises:
        RobotError: no walking posture exists.
    """

    def holds(posture: Array) -> bool:
        for foot in FEET:
            knee = stance.model.joints[stance.legs[foot].knee].idx_v - 6
            torque = carrying_torques(stance.model, posture, stance.soles[foot])[knee]
            if abs(torque) > KNEE_SHARE * effort[knee]:
                return False
        return True

    if holds(crouched):
        return crouched
    weak, strong = CROUCHED, STRETCHED
    for _ in range(_TRIES):
        middle = 0.5 * (weak + strong)
        if holds(walking_posture(stance, crouched, middle)):
            strong = middle
        else:
            weak = middle
    return walking_posture(stance, crouched, strong)
