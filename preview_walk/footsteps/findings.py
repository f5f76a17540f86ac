"""What is wrong with a plan, as values: the steps that break the limits, by number and time."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import inf

from preview_walk.footsteps.limits import GaitLimits
from preview_walk.footsteps.plan import FootstepPlan
from preview_walk.footsteps.step_problem import haste_problem
from preview_walk.types import other


@dataclass(frozen=True)
class Finding:
    """Something wrong with a plan or a reference.

    Attributes:
        time: where it is wrong, s; of a step its landing.
        text: what is wrong, one sentence without its full stop.
        step: number of the step, from 1; None for a reference.
        argument: what is at fault: the argument of a planner, as in `StepProblem`, or the "zmp" or
            "com" that was given; "plan" where the plan's own reference is wrong.
    """

    time: float
    text: str
    step: int | None = None
    argument: str = "plan"

    def __str__(self) -> str:
        return f"at {self.time:.3f} s {self.text}"


def step_findings(plan: FootstepPlan, limits: GaitLimits, since: float = -inf) -> Iterator[Finding]:
    """Yield what is wrong with the steps of a plan that land after `since` (s).

    Args:
        plan: the walk.
        limits: bounds of its steps.
        since: steps that have landed by then are history, s.
    """
    for number, step in enumerate(plan.steps, 1):
        if step.land <= since:
            continue
        stance = plan.sole(other(step.foot), step.lift)
        way = (step.foot, stance, plan.start_pose(step), step.pose)
        for problem in (
            limits.problem(step.foot, stance, step.pose),
            haste_problem(limits, step.land - step.lift),
            limits.crossing(*way),
        ):
            if problem is not None:
                text = f"step {number} {problem.text}"
                yield Finding(step.land, text, number, problem.argument)


def motor_findings(plan: FootstepPlan, limits: GaitLimits) -> Iterator[Finding]:
    """Yield the steps of a plan that ask for more than the limits' motors have.

    Args:
        plan: the walk.
        limits: bounds of its steps.
    """
    if limits.motors is None:
        return
    for number, problem in limits.motors.problems(plan):
        land = plan.steps[number - 1].land
        yield Finding(land, f"step {number} {problem.text}", number, problem.argument)
