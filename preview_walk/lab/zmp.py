"""The walking lab's ZMP generator: the reference of footsteps, sampled."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from preview_walk.arguments import positive_number, sample_count
from preview_walk.footsteps.planner import FootstepPlanner
from preview_walk.footsteps.reading import PlanLike, as_plan
from preview_walk.pattern.zmp_reference import zmp_reference
from preview_walk.types import Array


@dataclass(frozen=True)
class ZMPTrajectoryGenerator:
    """The walking lab's name for sampling the ZMP reference of footsteps.

    Attributes:
        planner: the planner of the footsteps.
    """

    planner: FootstepPlanner

    def generate_zmp_trajectory(self, footsteps: PlanLike, dt: float = 0.01) -> tuple[Array, Array]:
        """Return the ZMP reference from the plan's start to its end.

        Args:
            footsteps: a plan, or whatever `as_plan` takes: a list of footsteps or of dictionaries.
            dt: sample time, s.

        Returns:
            Times (N,), s, and the ZMP (N, 2), m.

        Raises:
            InvalidInput: dt is not > 0, or the footsteps are no plan.
        """
        plan = as_plan(footsteps, self.planner.double_support_ratio)
        dt = positive_number(dt, "dt", "s")
        count = sample_count(plan.end - plan.start, dt)
        t: Array = plan.start + dt * np.arange(count, dtype=np.float64)
        return t, zmp_reference(plan).at(t)
