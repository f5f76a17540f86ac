"""The writer of a plan log: takes the plan in force and keeps what changed."""

from __future__ import annotations

from bisect import bisect_left
from typing import Any

import numpy as np
from numpy.typing import NDArray

from preview_walk.footsteps.footstep import Footstep
from preview_walk.footsteps.plan import FootstepPlan
from preview_walk.record.plan_log import PlanLog
from preview_walk.types import FEET


class PlanWriter:
    """Collects the plans of a run, and only what changed between them."""

    def __init__(self) -> None:
        self._current: tuple[Footstep, ...] = ()
        self._plans: list[tuple[float, float, int]] = []
        self._steps: list[tuple[int, Footstep]] = []

    def write(self, time: float, plan: FootstepPlan) -> None:
        """Note that `plan` is in force from `time` (s) on."""
        steps = tuple(plan)
        kept = 0
        # Footsteps are immutable values that an edited plan shares with the one before it.
        for old, new in zip(self._current, steps, strict=False):
            if old is not new:
                break
            kept += 1
        revision = len(self._plans)
        self._plans.append((time, plan.end, kept))
        self._steps.extend((revision, step) for step in steps[kept:])
        self._current = steps

    def __len__(self) -> int:
        """Return the number of revisions."""
        return len(self._plans)

    def arrays(self, since: int = 0) -> dict[str, NDArray[Any]]:
        """Return the arrays of the log, from a revision on."""
        plans = self._plans[since:]
        first = bisect_left(self._steps, since, key=lambda pair: pair[0])
        revisions = [revision for revision, _ in self._steps[first:]]
        steps = [step for _, step in self._steps[first:]]
        return dict(
            plan_time=np.array([time for time, _, _ in plans], dtype=np.float64),
            plan_end=np.array([end for _, end, _ in plans], dtype=np.float64),
            plan_kept=np.array([kept for _, _, kept in plans], dtype=np.int32),
            step_revision=np.array(revisions, dtype=np.int32),
            step_foot=np.array([FEET.index(step.foot) for step in steps], dtype=np.int8),
            step_pose=np.array([step.pose for step in steps], dtype=np.float64).reshape(-1, 4, 4),
            step_lift=np.array([step.lift for step in steps], dtype=np.float64),
            step_land=np.array([step.land for step in steps], dtype=np.float64),
        )

    def finish(self) -> PlanLog:
        """Return what was written."""
        return PlanLog(**self.arrays())
