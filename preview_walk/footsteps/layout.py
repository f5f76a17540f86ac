"""A walk while it is laid out: what it goes on from, and its steps one after the other."""

from __future__ import annotations

from collections.abc import Sequence

from preview_walk.errors import InvalidInput
from preview_walk.footsteps.footstep import Footstep
from preview_walk.footsteps.limits import GaitLimits
from preview_walk.footsteps.plan import FootstepPlan
from preview_walk.types import FEET, Array, Foot, other

STAND_TIME = 1.6
"""Time (s) of standing before the first lift: as long as the preview, because a CoM at rest cannot
be asked for more (with 1.0 s the preview controller starts with a ZMP error of 0.2 m)."""

Start = Sequence[float] | FootstepPlan
"""(x, y) or (x, y, yaw) midway between the first two soles, or a plan to go on from."""


class Layout:
    """Steps that follow a stance or another plan.

    Attributes:
        soles: pose (4, 4) of each sole after the last step.
        steps: the steps so far.
    """

    def __init__(self, before: FootstepPlan) -> None:
        """Begin where the plan `before` ends."""
        self._before = before
        self._last = self._before[-1].land
        self.soles = {foot: self._before.sole(foot, self._last) for foot in FEET}
        self._lift = self._last + max(STAND_TIME, 2.0 * self._before.weight_shift)
        self.steps: list[Footstep] = []

    @property
    def number(self) -> int:
        """Number of the next step in the plan, from 1."""
        return len(self._before.steps) + len(self.steps) + 1

    def allowed(self, foot: Foot, pose: Array, limits: GaitLimits, shorten: bool) -> Array:
        """Return the pose (4, 4) at which `foot` may land in the next step.

        Args:
            foot: the landing foot.
            pose: where it should land, (4, 4).
            limits: bounds of the step.
            shorten: return the nearest allowed level pose instead of refusing.

        Raises:
            InvalidInput: the step breaks a limit; `argument` is that of a planner.
        """
        way = (self.soles[other(foot)], self.soles[foot], pose)
        problem = limits.problem(foot, way[0], pose) or limits.crossing(foot, *way)
        if problem is None:
            return pose
        if shorten:
            return limits.shortened(foot, *way)
        raise InvalidInput(f"step {self.number} {problem}.", argument=problem.argument)

    def add(self, foot: Foot, pose: Array, swing: float, pause: float) -> None:
        """Append a step.

        Args:
            foot: the swinging foot.
            pose: where it lands, (4, 4).
            swing: time in the air, s.
            pause: time on both feet after it, s.
        """
        land = self._lift + swing
        self.steps.append(Footstep(foot, pose, self._lift, land))
        self.soles[foot] = pose
        self._lift = land + pause

    def plan(self) -> FootstepPlan:
        """Return the walk."""
        return self._before.replace_after(self._last, self.steps)
