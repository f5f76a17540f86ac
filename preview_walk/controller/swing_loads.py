"""What a swing asks of joints and ground, from the joints' way through it: inverse dynamics."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
import pinocchio as pin

from preview_walk.robots.robot import Robot
from preview_walk.types import Array, Foot

INSIDE = 0.95
"""Share of the sole in which the centre of pressure stays, as in the QP of a tick."""

_ROUNDS = 2
"""An ankle that is too weak moves the centre of pressure; its two joints settle in as many."""


@dataclass(frozen=True, eq=False)
class SwingLoads:
    """What is asked at N instants of a swing.

    Attributes:
        speed: (N, n) joint speeds, rad/s.
        torque: (N, n) joint torques, N·m, with the ground's wrench within the sole.
        beyond: (N, 2) moment about the sole's centre that the sole cannot give, over the robot's
            weight, m: the trunk has to give it by tipping.
    """

    speed: Array
    torque: Array
    beyond: Array


def swing_loads(robot: Robot, stance: Foot, path: Array, dt: float) -> SwingLoads:
    """Return what a swing asks; speeds and accelerations are differences of the path.

    Args:
        robot: the robot.
        stance: the foot that stands.
        path: (N + 2, nq) configurations, one before and one after the N instants.
        dt: between two of them, s.
    """
    model, data = robot.pin, robot.pin.createData()
    damping = np.concatenate([np.zeros(6), robot.damping])
    moves = [pin.difference(model, a, b) / dt for a, b in pairwise(path)]
    n = len(moves) - 1
    speed, torque, beyond = np.zeros((n, model.nv)), np.zeros((n, model.nv)), np.zeros((n, 2))
    for k in range(n):
        speed[k] = 0.5 * (moves[k] + moves[k + 1])
        needed = pin.rnea(model, data, path[k + 1], speed[k], (moves[k + 1] - moves[k]) / dt)
        needed = needed + damping * speed[k]
        jacobian = pin.computeFrameJacobian(
            model, data, path[k + 1], robot.soles[stance].frame, pin.ReferenceFrame.LOCAL
        )
        wrench = np.linalg.solve(jacobian[:, :6].T, needed[:6])
        given = _given(robot, stance, jacobian, needed, wrench)
        torque[k] = needed - jacobian.T @ given
        beyond[k] = (wrench - given)[3:5] / (robot.mass * robot.gravity)
    return SwingLoads(speed[:, 6:], torque[:, 6:], beyond)


def _given(robot: Robot, stance: Foot, jacobian: Array, needed: Array, wrench: Array) -> Array:
    """Return the wrench (6,) nearest to the one asked for that sole and ankle can give."""
    leg = robot.legs[stance]
    ankle = [robot.pin.joints[j].idx_v for j in leg.joints[leg.joints.index(leg.knee) + 1 :]]
    limit = robot.effort[[i - 6 for i in ankle]]
    given = _within(robot, wrench)
    for _ in range(_ROUNDS):
        torque = (needed - jacobian.T @ given)[ankle]
        excess = torque - np.clip(torque, -limit, limit)
        asked: Array = given.copy()
        asked[3:] += jacobian[3:, ankle] @ excess
        given = _within(robot, asked)
    return given


def _within(robot: Robot, wrench: Array) -> Array:
    """Return a wrench (6,), sole axes, with its centre of pressure cut to the sole."""
    force = max(float(wrench[2]), 0.0)
    most = INSIDE * force * np.array((robot.sole.half_width, robot.sole.half_length))
    cut: Array = wrench.copy()
    cut[3:5] = np.clip(wrench[3:5], -most, most)
    return cut
