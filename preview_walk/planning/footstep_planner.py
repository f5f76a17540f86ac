"""The walking lab's footstep planner: straight walks and arcs with one length, width and time."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import isfinite
from typing import Literal

from preview_walk.errors import InvalidInput
from preview_walk.planning.footsteps import Footstep, FootstepPlan
from preview_walk.planning.pose import Heading, as_heading, compose, pose_at
from preview_walk.types import FEET, Array, Foot, other

STAND_TIME = 1.6
"""Time (s) of standing before the first lift: as long as the preview, because a CoM at rest cannot
be asked for more (with 1.0 s the preview controller starts with a ZMP error of 0.2 m)."""


def sole_beside(frame: Heading, foot: Foot, step_width: float, z: float = 0.0) -> Array:
    """Return the (4, 4) pose of a level sole half a step width (m) to its side of `frame`."""
    x, y, yaw = compose(frame, 0.0, 0.5 * step_width if foot == "left" else -0.5 * step_width)
    return pose_at(x, y, yaw, z)


@dataclass(frozen=True)
class FootstepPlanner:
    """Plans steps of one size.

    Attributes:
        step_length: distance (m) along the walk between one landing and the next, that is half
            of what a foot travels in a full step; negative walks backwards.
        step_width: lateral distance (m) between the two sole centres.
        step_time: time (s) from one landing to the next, double support included.
        double_support_ratio: share of the step time in which both feet stand, in (0, 1).

    Raises:
        InvalidInput: a size that is not finite, a width or time that is not positive, or a ratio
            outside (0, 1).
    """

    step_length: float = 0.15
    step_width: float = 0.1
    step_time: float = 0.5
    double_support_ratio: float = 0.2

    def __post_init__(self) -> None:
        """Check the sizes."""
        if not isfinite(self.step_length):
            raise InvalidInput(f"step_length must be finite (m), got {self.step_length}.")
        for name, unit in (("step_width", "m"), ("step_time", "s")):
            value = getattr(self, name)
            if not (isfinite(value) and value > 0.0):
                raise InvalidInput(f"{name} must be > 0 {unit}, got {value}.")
        if not 0.0 < self.double_support_ratio < 1.0:
            raise InvalidInput(
                "double_support_ratio must be in (0, 1), the share of the step time, "
                f"got {self.double_support_ratio}."
            )

    @property
    def double_support_time(self) -> float:
        """Time (s) from a landing to the next lift."""
        return self.double_support_ratio * self.step_time

    @property
    def single_support_time(self) -> float:
        """Time (s) from a lift to its landing: what the swing lasts."""
        return self.step_time - self.double_support_time

    def generate_footsteps(
        self,
        n_steps: int = 10,
        start_pos: Sequence[float] = (0.0, 0.0),
        start_foot: Foot = "left",
        turn: float = 0.0,
        ramp: int = 0,
    ) -> FootstepPlan:
        """Return a walk of `n_steps` steps that starts and ends with the feet side by side.

        The first and the last step are half steps: their swing travels one step length, those
        between travel two.  The walk therefore covers (n_steps - 1) * step_length.

        Args:
            n_steps: number of steps (>= 0); the last one brings the feet together.
            start_pos: (x, y) or (x, y, yaw) of the point midway between the two soles (m, rad).
            start_foot: the foot that swings first.
            turn: heading change (rad, left positive) from each landing to the next.
            ramp: number of shorter steps in which the length grows at the start and shrinks at
                the end; step i of the ramp has i / (ramp + 1) of the length (and of the turn).

        Raises:
            InvalidInput: n_steps or ramp is not an integer >= 0, or another argument is not
                what is described here.
        """
        for name, count in (("n_steps", n_steps), ("ramp", ramp)):
            if isinstance(count, bool) or int(count) != count or count < 0:
                raise InvalidInput(f"{name} must be an integer >= 0, got {count!r}.")
        if start_foot not in FEET:
            raise InvalidInput(f"start_foot must be 'left' or 'right', got {start_foot!r}.")
        if not isfinite(turn):
            raise InvalidInput(f"turn must be finite (rad per step), got {turn}.")
        frame = as_heading(start_pos, "start_pos")
        left, right = (sole_beside(frame, foot, self.step_width) for foot in FEET)
        plan = FootstepPlan.standing(left, right)
        steps: list[Footstep] = []
        foot, lift = start_foot, plan.start + STAND_TIME
        for index in range(n_steps):
            share = min(1.0, (index + 1) / (ramp + 1), (n_steps - 1 - index) / (ramp + 1))
            # Half of the turn before the advance and half after: the feet stay on an arc.
            frame = compose(frame, 0.0, 0.0, 0.5 * share * turn)
            frame = compose(frame, share * self.step_length, 0.0, 0.5 * share * turn)
            land = lift + self.single_support_time
            steps.append(Footstep(foot, sole_beside(frame, foot, self.step_width), lift, land))
            foot, lift = other(foot), land + self.double_support_time
        return plan.replace_after(plan.start, steps)

    def get_support_phase(
        self, t: float, footsteps: Sequence[Footstep]
    ) -> tuple[Literal["double", "left_support", "right_support"], float]:
        """Return the support phase at time t (s) and the progress (0..1) through it.

        "left_support" means that the left foot stands and the right one swings.  Before the start
        of the plan the progress is 0, after its end 1.
        """
        plan = footsteps if isinstance(footsteps, FootstepPlan) else FootstepPlan(footsteps)
        step = plan.swing_at(t)
        if step is not None:
            progress = (t - step.lift) / (step.land - step.lift)
            return ("left_support" if step.foot == "right" else "right_support"), progress
        lifted = plan.lifted(t)
        since = lifted[-1].land if lifted else plan.start
        upcoming = plan.steps[len(lifted) : len(lifted) + 1]
        until = upcoming[0].lift if upcoming else plan.end
        if until <= since:
            return "double", 0.0 if t < since else 1.0
        return "double", min(1.0, max(0.0, (t - since) / (until - since)))
