"""Inverse kinematics by Gauss-Newton: the one loop behind every posture."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import pinocchio as pin

from preview_walk.types import FEET, Array, Foot

LARGEST_STEP = 0.3
"""Largest change (rad or m) of a coordinate in one iteration: further the Jacobian is no guide."""

Residual = Callable[[Array], tuple[Array, Array]]
"""Takes a configuration (nq,) to errors (m,) and their Jacobian (m, nv)."""


@dataclass(frozen=True)
class Stop:
    """When to stop.

    Attributes:
        tolerance: the largest error left, m or rad.
        iterations: give up after these.
        exact: how many of the first errors must come below the tolerance, None for all; the others
            are made as small as that allows.
    """

    tolerance: float
    iterations: int
    exact: int | None = None


def gauss_newton(
    model: pin.Model, q: Array, free: Sequence[int], residual: Residual, stop: Stop
) -> tuple[Array, float]:
    """Return a configuration in which a residual vanishes, and the largest error left in it.

    Args:
        model: the robot.
        q: configuration (nq,) to start from.
        free: the velocity coordinates that may move.
        residual: errors and their Jacobian.
        stop: when to stop.
    """
    for _ in range(stop.iterations):
        error, jacobian = residual(q)
        left = float(np.abs(error[: stop.exact]).max())
        if left < stop.tolerance:
            break
        step = np.zeros(model.nv)
        step[free] = np.linalg.lstsq(jacobian[:, free], -error, rcond=1e-8)[0]
        q = pin.integrate(model, q, step * min(1.0, LARGEST_STEP / np.abs(step).max()))
    return np.asarray(q), left


def leg_coordinates(model: pin.Model, legs: Mapping[Foot, Sequence[int]]) -> list[int]:
    """Return the velocity coordinates of the base and of the legs' joints (Pinocchio's ids)."""
    return [*range(6), *(model.joints[joint].idx_v for foot in FEET for joint in legs[foot])]


def sole_rows(
    model: pin.Model,
    data: pin.Data,
    frame: int,
    target: pin.SE3,
    unplaced: Sequence[int] = (),
) -> tuple[Array, Array]:
    """Return how far a sole is from a pose (6,), [linear; angular], and the Jacobian (6, nv).

    Args:
        model: the robot.
        data: holds the joints' Jacobians and the frames' placements.
        frame: the sole frame.
        target: where it should be.
        unplaced: the directions that do not matter; their rows are zero.
    """
    miss = target.actInv(data.oMf[frame])
    jacobian = pin.getFrameJacobian(model, data, frame, pin.ReferenceFrame.LOCAL)
    error, rows = pin.log6(miss).vector, pin.Jlog6(miss) @ jacobian
    error[list(unplaced)], rows[list(unplaced)] = 0.0, 0.0
    return error, rows
