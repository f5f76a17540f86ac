"""The ZMP shift that the swing leg's angular momentum causes, foreseen from the plan."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from preview_walk.constants import GRAVITY
from preview_walk.footsteps.plan import FootstepPlan
from preview_walk.geometry.quintic import Quintic
from preview_walk.pattern.swing import swing_of
from preview_walk.types import Array, Foot


@dataclass(frozen=True, eq=False)
class MomentumModel:
    """Angular momentum about the CoM, linear in the motion of a walker in its posture.

    L = foot[swing foot] @ v_foot + com @ v_com, in kg m^2/s, axes x forward, y left, z up.

    Attributes:
        mass: of the robot (kg).
        com: (3, 3), per CoM velocity.
        foot: (3, 3) for each swing foot, per velocity of its sole.
    """

    mass: float
    com: Array
    foot: Mapping[Foot, Array]

    def effective_height(self, com_height: float) -> float:
        """Return the height (m) of the cart-table whose ZMP includes the CoM's own share of L.

        A walker that leans as it moves turns about its CoM: p = c - (z + k / m) c'' / g, with k
        the mean of the two horizontal axes' terms.
        """
        return com_height + 0.5 * float(self.com[1, 0] - self.com[0, 1]) / self.mass


def swing_zmp_shift(
    plan: FootstepPlan, times: Array, model: MomentumModel, swing_height: float
) -> Array:
    """Return the shift (N, 2) of the ZMP, in m, at increasing times (N,) in s.

    The true ZMP is the cart-table's plus this shift: (-L'_y, L'_x) / (m g) with L' the rate of
    angular momentum of the swings of the plan (Kajita et al. 2014, eq. 3.73).
    """
    shift = np.zeros((len(times), 2))
    for step in plan.steps:
        first, last = np.searchsorted(times, (step.lift, step.land))
        if last == first:
            if step.lift > times[-1]:
                break
            continue
        t = times[first:last]
        swing = swing_of(plan, step, swing_height)
        x, y = (_acceleration(swing.plane[axis], t) for axis in (0, 1))
        z = np.zeros(len(t))
        for piece in swing.vertical:
            inside = (t >= piece.start) & (t < piece.end)
            z[inside] = _acceleration(piece, t[inside])
        yaw = step.yaw
        c, s = np.cos(yaw), np.sin(yaw)
        forward, left = c * x + s * y, c * y - s * x
        rate = np.column_stack([forward, left, z]) @ model.foot[step.foot].T
        dx, dy = -rate[:, 1], rate[:, 0]
        shift[first:last, 0] = c * dx - s * dy
        shift[first:last, 1] = s * dx + c * dy
    shift /= model.mass * GRAVITY
    return shift


def _acceleration(path: Quintic, t: Array) -> Array:
    """Return the acceleration (N,) of a quintic at times (N,) within it."""
    h = path.end - path.start
    u = (t - path.start) / h
    _, _, c, d, e, f = path.coefficients
    result: Array = (2.0 * c + u * (6.0 * d + u * (12.0 * e + u * 20.0 * f))) / (h * h)
    return result
