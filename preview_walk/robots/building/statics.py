"""Standing still on one leg: what it asks of the motors, and how straight weak knees must stand."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import pinocchio as pin

from preview_walk.robots.building.posture import Leg, walking_posture
from preview_walk.types import FEET, Array, Foot

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
    """Return the torques (nv - 6,) in N·m that hold a robot still in the posture q (nq,).

    One sole (a frame) carries its whole weight, the other none.
    """
    data = model.createData()
    gravity = pin.computeGeneralizedGravity(model, data, q)
    pin.computeJointJacobians(model, data, q)
    pin.updateFramePlacements(model, data)
    jacobian = pin.getFrameJacobian(model, data, sole, pin.ReferenceFrame.LOCAL)
    wrench = np.linalg.solve(jacobian[:, :6].T, gravity[:6])
    return np.asarray((gravity - jacobian.T @ wrench)[6:])


def straightened(
    model: pin.Model,
    crouched: Array,
    soles: Mapping[Foot, int],
    legs: Mapping[Foot, Leg],
    width: float,
    effort: Array,
) -> Array:
    """Return the walking posture (nq,) that the knees can hold.

    It is the `crouched` one (nq,); where that asks for more than `KNEE_SHARE` of a knee's limit in
    `effort` (n,), as much straighter as it takes, up to `STRETCHED`. The other arguments are those
    of `walking_posture`.

    Raises `RobotError` where no walking posture exists.
    """

    def holds(posture: Array) -> bool:
        for foot in FEET:
            knee = model.joints[legs[foot].knee].idx_v - 6
            torque = carrying_torques(model, posture, soles[foot])[knee]
            if abs(torque) > KNEE_SHARE * effort[knee]:
                return False
        return True

    if holds(crouched):
        return crouched
    weak, strong = CROUCHED, STRETCHED
    for _ in range(_TRIES):
        middle = 0.5 * (weak + strong)
        if holds(walking_posture(model, crouched, soles, legs, width, middle)):
            strong = middle
        else:
            weak = middle
    return walking_posture(model, crouched, soles, legs, width, strong)
