"""The ZMP shift that the swing leg's angular momentum causes, foreseen from the plan."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from preview_walk.constants import GRAVITY
from preview_walk.footsteps.footstep import Footstep
from preview_walk.footsteps.plan import FootstepPlan
from preview_walk.pattern.swing import apex_height
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
    begin, end = float(times[0]), float(times[-1])
    steps = [step for step in plan.steps if step.land > begin and step.lift <= end]
    if not steps:
        return shift
    table = np.array([_motion(plan, step, swing_height) for step in steps])
    # The step that lands next at each time; in the air once it has lifted.
    step = np.searchsorted(table[:, 1], times, side="right")
    step[step == len(steps)] = 0
    air = np.flatnonzero((times >= table[step, 0]) & (times < table[step, 1]))
    step, t = step[air], times[air]
    lift, land, go, arrive, top, dx, dy, up, down, yaw, left = table[step].T
    rises = t < top
    start = np.array((go, go, np.where(rises, lift, top)))
    stop = np.array((arrive, arrive, np.where(rises, top, land)))
    x, y, z = _accelerations(t, start, stop, np.array((dx, dy, np.where(rises, up, down))))
    c, s = np.cos(yaw), np.sin(yaw)
    ahead = np.array((c * x + s * y, c * y - s * x, z)).T
    about_x, about_y, _ = np.where(
        left, (ahead @ model.foot["left"].T).T, (ahead @ model.foot["right"].T).T
    )
    shift[air, 0] = -c * about_y - s * about_x
    shift[air, 1] = c * about_x - s * about_y
    shift /= model.mass * GRAVITY
    return shift


def _motion(plan: FootstepPlan, step: Footstep, swing_height: float) -> tuple[float, ...]:
    """Return what the acceleration of a swing from rest to rest follows from.

    Lift and landing, begin and end of the way, and the time at the apex, s; the way's x and y, and
    its heights up to the apex and down from it, m; its yaw, rad; 1 for the left foot, 0 for the
    right one.
    """
    start, end, shape = plan.start_pose(step), step.pose, step.swing
    x0, y0, z0 = start[:3, 3].tolist()
    x1, y1, z1 = end[:3, 3].tolist()
    lift, land = step.lift, step.land
    apex = apex_height(z0, z1, shape, swing_height)
    return (
        *(lift, land, *shape.way(lift, land), shape.top(lift, land)),
        *(x1 - x0, y1 - y0, apex - z0, z1 - apex),
        *(step.yaw, float(step.foot == "left")),
    )


def _accelerations(t: Array, start: Array, end: Array, way: Array) -> Array:
    """Return the accelerations (k, N) at times t (N,) of quintics from rest to rest.

    `start`, `end`, `way`: (k, N) times, s, and lengths, m; nothing moves before or after them.
    """
    h = end - start
    u = (t - start) / h
    moving: Array = way * u * (60.0 + u * (-180.0 + u * 120.0)) / (h * h)
    moving[(u < 0.0) | (u > 1.0)] = 0.0
    return moving
