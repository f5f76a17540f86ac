"""The walking lab's footstep planner: walks of strides from a stance or from another plan."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Literal

from preview_walk.arguments import (
    count_of,
    finite_number,
    foot_of,
    instance_of,
    items_of,
    positive_number,
    share_of,
    time_of,
)
from preview_walk.errors import InvalidInput
from preview_walk.footsteps.findings import motor_findings
from preview_walk.footsteps.layout import Layout, Start
from preview_walk.footsteps.limits import GaitLimits
from preview_walk.footsteps.plan import FootstepPlan
from preview_walk.footsteps.reading import DOUBLE_SUPPORT_RATIO, PlanLike, as_plan
from preview_walk.footsteps.stride import Stride, ramp_shares
from preview_walk.geometry.poses import Heading, as_heading, compose, heading_of, midfeet, pose_at
from preview_walk.types import FEET, Array, Foot, other


def sole_beside(frame: Heading, foot: Foot, step_width: float, z: float = 0.0) -> Array:
    """Return the pose (4, 4) of a level sole beside the middle of a stance.

    Args:
        frame: heading of that middle.
        foot: whose sole it is.
        step_width: lateral distance of the two soles, m.
        z: height of the ground, m.
    """
    x, y, yaw = compose(frame, 0.0, 0.5 * step_width if foot == "left" else -0.5 * step_width)
    return pose_at(x, y, yaw, z)


@dataclass(frozen=True)
class FootstepPlanner:
    """Plans steps of one size, or of sizes given step by step.

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
    double_support_ratio: float = DOUBLE_SUPPORT_RATIO

    def __post_init__(self) -> None:
        """Check the sizes."""
        sizes = {
            "step_length": finite_number(self.step_length, "step_length", "m"),
            "step_width": positive_number(self.step_width, "step_width", "m"),
            "step_time": positive_number(self.step_time, "step_time", "s"),
        }
        name = "double_support_ratio"
        sizes[name] = share_of(self.double_support_ratio, name, "the step time")
        for name, size in sizes.items():
            object.__setattr__(self, name, size)

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
        n_steps, turn = count_of(n_steps, "n_steps"), finite_number(turn, "turn", "rad per step")
        shares = ramp_shares(n_steps - 1, ramp)
        strides = [Stride(share * self.step_length, 0.0, share * turn) for share in shares]
        closing = [Stride()] if n_steps else []
        return self.walk(strides + closing, as_heading(start_pos, "start_pos"), start_foot)

    def walk(
        self,
        strides: Iterable[Stride],
        start: Start = (0.0, 0.0),
        start_foot: Foot = "left",
        limits: GaitLimits | None = None,
        shorten: bool = False,
    ) -> FootstepPlan:
        """Return the walk that makes these strides, feet alternating.

        Each stride moves the middle of the stance; the swinging foot lands half a width to its
        side of it.  A last `Stride()` brings the feet side by side.

        Args:
            strides: one for each step.
            start: (x, y) or (x, y, yaw) of the middle of the first stance (m, rad), or a plan to
                go on from: it ends, stands, and the strides follow on the same ground height.
            start_foot: the foot that swings first.
            limits: bounds of a step; None checks nothing but order and times.
            shorten: cut steps that break the limits to size instead of refusing them; the walk
                goes on from where the shorter step lands.

        Raises:
            InvalidInput: a step breaks the limits or asks for more than their motors have, with
                its number and the bound; `argument` is the planner's that is at fault, as in
                `StepProblem`. Or another argument is not what is described here.
        """
        foot = foot_of(start_foot, "start_foot")
        if limits is not None:
            instance_of(limits, GaitLimits, "limits")
        layout = Layout(self.begin(start))
        z = 0.5 * float(layout.soles["left"][2, 3] + layout.soles["right"][2, 3])
        frame = midfeet(layout.soles["left"], layout.soles["right"])
        for stride in items_of(strides, Stride, "strides"):
            width = self.step_width if stride.width is None else stride.width
            time = self.step_time if stride.time is None else stride.time
            ratio = stride.double_support_ratio or self.double_support_ratio
            # Half of the turn before the advance and half after: the walk stays on an arc.
            frame = compose(frame, 0.0, 0.0, 0.5 * stride.turn)
            frame = compose(frame, stride.forward, stride.left, 0.5 * stride.turn)
            pose = sole_beside(frame, foot, width, z)
            if limits is not None:
                pose = layout.allowed(foot, pose, limits, shorten)
                landing = heading_of(pose)
                frame = compose(landing, 0.0, -0.5 * width if foot == "left" else 0.5 * width)
            layout.add(foot, pose, time * (1.0 - ratio), time * ratio)
            foot = other(foot)
        plan = layout.plan()
        if limits is not None and not shorten:
            _require_motors(plan, limits)
        return plan

    def begin(self, start: Start) -> FootstepPlan:
        """Return the plan that a walk goes on from: one that is given, or a stand at a place."""
        return start if isinstance(start, FootstepPlan) else self.stand(start)

    def stand(self, start: Sequence[float] = (0.0, 0.0)) -> FootstepPlan:
        """Return the plan without steps, the soles a step width apart.

        Args:
            start: (x, y) or (x, y, yaw) of the point midway between the soles (m, rad).

        Raises:
            InvalidInput: that is no such place.
        """
        frame = as_heading(start, "start")
        left, right = (sole_beside(frame, foot, self.step_width) for foot in FEET)
        return FootstepPlan.standing(left, right)

    def get_support_phase(
        self, t: float, footsteps: PlanLike
    ) -> tuple[Literal["double", "left_support", "right_support"], float]:
        """Return the support phase at time t (s) and the progress (0..1) through it.

        "left_support" means that the left foot stands and the right one swings.  Before the start
        of the plan the progress is 0, after its end 1.

        Args:
            t: time, s.
            footsteps: whatever `as_plan` takes.

        Raises:
            InvalidInput: t is no time, or the footsteps are no plan.
        """
        t, plan = time_of(t), as_plan(footsteps, self.double_support_ratio)
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


def _require_motors(plan: FootstepPlan, limits: GaitLimits) -> None:
    """Raise `InvalidInput` where a step asks for more than the limits' motors have."""
    finding = next(motor_findings(plan, limits), None)
    if finding is not None:
        raise InvalidInput(f"{finding.text}.", argument=finding.argument)
