"""The ZMP shift that the swing leg's angular momentum causes, foreseen from the plan."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from preview_walk.constants import GRAVITY
from preview_walk.footsteps.plan import FootstepPlan
from preview_walk.geometry.planar import turn
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
    """Return the shift (N, 2) of the ZMP (m) that the swings cause.

    The true ZMP is the cart-table's plus this shift: (-L'_y, L'_x) / (m g) with L' the rate of
    angular momentum of the swings of the plan (Kajita et al. 2014, section 3.4.1).

    Args:
        plan: the walk.
        times: increasing times (N,), s.
        model: angular momentum of the legs.
        swing_height: of the apex of a swing above the higher sole, m.
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
        x, y = (swing.plane[axis].accelerations(t) for axis in (0, 1))
        z = np.zeros(len(t))
        for piece in swing.vertical:
            inside = (t >= piece.start) & (t < piece.end)
            z[inside] = piece.accelerations(t[inside])
        yaw = step.yaw
        ahead = turn(np.column_stack([x, y]), -yaw)
        rate = np.column_stack([ahead, z]) @ model.foot[step.foot].T
        shift[first:last] = turn(np.column_stack([-rate[:, 1], rate[:, 0]]), yaw)
    shift /= model.mass * GRAVITY
    return shift
