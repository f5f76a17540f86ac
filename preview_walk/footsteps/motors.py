"""What motors have to say about a plan, as the plan's limits hold it; who knows robots says it."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Protocol

from preview_walk.footsteps.plan import FootstepPlan
from preview_walk.footsteps.step_problem import StepProblem


class Motors(Protocol):
    """A robot's motors, as a check of plans sees them."""

    def problems(self, plan: FootstepPlan) -> Iterator[tuple[int, StepProblem]]:
        """Yield the number (from 1) and the problem of each step that asks for more than they have.

        Args:
            plan: the walk.
        """
