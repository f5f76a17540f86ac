"""The CoM over a whole plan at once: what `WalkingPattern` gives tick by tick."""

from __future__ import annotations

import numpy as np

from preview_walk.footsteps.plan import FootstepPlan
from preview_walk.pattern.com.sampled_plan import PLANNING_DT, PREVIEW_TIME, sample_plan
from preview_walk.pattern.com_height import wanted_heights
from preview_walk.pattern.walker_model import WalkerModel
from preview_walk.pattern.walking_pattern import HEIGHT_EFFORT
from preview_walk.preview.controller import PreviewController
from preview_walk.types import Array


def com_path(plan: FootstepPlan, model: WalkerModel) -> tuple[Array, Array]:
    """Return times (M,) in s, `PLANNING_DT` apart, and the CoM (M, 3) at each, world, m.

    The CoM starts at rest over the middle of the first two soles and is led by preview control.

    Args:
        plan: the walk.
        model: of the robot.
    """
    sampled = sample_plan(plan, plan.start, 0, model, span=None)
    plane = PreviewController(model.pendulum_height, PLANNING_DT, PREVIEW_TIME)
    lift = PreviewController(1e-9, PLANNING_DT, PREVIEW_TIME, r=HEIGHT_EFFORT)
    heights = wanted_heights(plan, sampled.times, model.legs)
    com = plane.trajectory(sampled.zmp).com, lift.trajectory(heights).com
    return sampled.times, np.column_stack(com)
