"""The walking lab's ZMP generator: the reference of footsteps, sampled."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import isfinite

import numpy as np

from preview_walk.errors import InvalidInput
from preview_walk.footsteps.footstep import Footstep
from preview_walk.footsteps.plan import FootstepPlan
from preview_walk.footsteps.planner import FootstepPlanner
from preview_walk.pattern.zmp_reference import zmp_reference
from preview_walk.types import Array


@dataclass(frozen=True)
class ZMPTrajectoryGenerator:
    """The walking lab's name for sampling the ZMP reference of footsteps.

    Attributes:
        planner: the planner of the footsteps.
    """

    planner: FootstepPlanner

    def generate_zmp_trajectory(
        self, footsteps: Sequence[Footstep], dt: float = 0.01
    ) -> tuple[Array, Array]:
        """Return t (N,) from the plan's start to its end every dt (s), and the ZMP (N, 2) in m.

        Raises:
            InvalidInput: dt is not > 0, or the footsteps are no plan.
        """
        plan = footsteps if isinstance(footsteps, FootstepPlan) else FootstepPlan(footsteps)
        if not (isfinite(dt) and dt > 0.0):
            raise InvalidInput(f"dt must be > 0 s, got {dt}.")
        count = round((plan.end - plan.start) / dt) + 1
        t: Array = plan.start + dt * np.arange(count, dtype=np.float64)
        return t, zmp_reference(plan).at(t)
