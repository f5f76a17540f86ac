"""How high the CoM can be over a plan: long steps lower the hips, stairs raise and lower all.

The height is wanted piecewise (one value per double support) and made smooth by a preview servo
of its own: a cart-table of no height is a triple integrator, whose output is the position.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import sqrt

import numpy as np

from preview_walk.footsteps.footstep import Footstep
from preview_walk.footsteps.plan import FootstepPlan
from preview_walk.types import FEET, Array

LONGEST_STRETCH = 0.97
"""Share of the leg's length that a step may use: short of a locked knee."""

LOWEST_HIPS = 0.75
"""The hips never come lower than this share of the leg's length."""


@dataclass(frozen=True)
class LegGeometry:
    """What a step needs of the legs, in m.

    Attributes:
        length: from hip to sole, stretched.
        hip_height: of the hips above the soles in the walking posture.
        com_height: of the CoM above the soles in the walking posture.
    """

    length: float
    hip_height: float
    com_height: float

    def com_over(self, spread: float, rise: float = 0.0) -> float:
        """Return the height (m) of the CoM above the middle of two soles.

        Both legs must reach: midway between the soles the hips are on the lower of the walking
        posture and the circle of radius `LONGEST_STRETCH * length` around the lower sole.

        Args:
            spread: distance of the soles along the walk, m.
            rise: difference of their heights, m.
        """
        reach = LONGEST_STRETCH * self.length
        hips = sqrt(max(reach * reach - 0.25 * spread * spread, 0.0)) - 0.5 * rise
        hips = max(min(hips, self.hip_height), LOWEST_HIPS * self.length)
        return self.com_height - (self.hip_height - hips)


def wanted_heights(plan: FootstepPlan, times: Array, legs: LegGeometry) -> Array:
    """Return the wanted height (N,) of the CoM in the world (m).

    Constant from the middle of one swing to the middle of the next; it jumps there.

    Args:
        plan: the walk.
        times: increasing times (N,), s.
        legs: how high the CoM can be.
    """
    left, right = (plan.sole(foot, float(times[0])) for foot in FEET)
    soles = {"left": left, "right": right}
    landed = [step for step in plan.lifted(float(times[0])) if step.land <= times[0]]
    share = _pause_share(plan, landed[-1]) if landed else 0.0
    heights = np.full(len(times), _height(soles["left"], soles["right"], legs, share))
    for step in plan.steps:
        if step.land <= times[0]:
            continue
        if step.lift > times[-1]:
            break
        soles[step.foot] = step.pose
        middle = 0.5 * (step.lift + step.land)
        index = int(np.searchsorted(times, middle))
        share = _pause_share(plan, step)
        heights[index:] = _height(soles["left"], soles["right"], legs, share)
    return heights


def _pause_share(plan: FootstepPlan, step: Footstep) -> float:
    """Return the share of a step's time that its double support takes; 0 after the last step."""
    following = plan.next_landing(step.land)
    pause = following.lift - step.land if following is not None else 0.0
    return pause / (pause + step.land - step.lift)


def _height(left: Array, right: Array, legs: LegGeometry, double_support: float) -> float:
    """Return the CoM's height (m) over two soles; it moves on during their double support."""
    spread = float(np.hypot(*(left[:2, 3] - right[:2, 3])))
    aside = abs(float((left[:2, 3] - right[:2, 3]) @ left[:2, 1]))
    along = sqrt(max(spread * spread - aside * aside, 0.0)) * (1.0 + min(double_support, 1.0))
    rise = abs(float(left[2, 3] - right[2, 3]))
    return 0.5 * float(left[2, 3] + right[2, 3]) + legs.com_over(along, rise)
