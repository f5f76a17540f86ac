"""A walker about the size of TALOS for tests of the walking pattern, and walks for it."""

import numpy as np

from preview_walk.footsteps.plan import FootstepPlan
from preview_walk.footsteps.planner import FootstepPlanner
from preview_walk.geometry.poses import Heading
from preview_walk.geometry.support import Sole
from preview_walk.pattern.com_height import LegGeometry
from preview_walk.pattern.swing_moment import MomentumModel
from preview_walk.pattern.walker_model import WalkerModel

LEGS = LegGeometry(length=0.812, hip_height=0.747, com_height=0.876)
SOLE = Sole(0.105, 0.065)
SWING_HEIGHT = 0.049
MOMENTUM = MomentumModel(
    90.0,
    np.array([[0.0, -10.4, 0.0], [13.6, 0.0, 11.2], [0.0, -0.4, 0.0]]),
    {
        "left": np.array([[0.2, 5.2, 0.8], [-6.8, -0.2, -5.6], [-0.9, 0.2, -0.8]]),
        "right": np.array([[-0.2, 5.2, -0.8], [-6.8, 0.2, -5.6], [0.9, 0.2, 0.8]]),
    },
)
MODEL = WalkerModel(LEGS, SOLE, MOMENTUM, SWING_HEIGHT)


def slow_walk(n_steps: int = 6, start: Heading = (0.0, 0.0, 0.0)) -> FootstepPlan:
    return FootstepPlanner(0.25, 0.17, 0.9).generate_footsteps(n_steps, start, ramp=2)


def fast_walk() -> FootstepPlan:
    return FootstepPlanner(0.5, 0.17, 0.62, 0.05).generate_footsteps(9, ramp=3)
