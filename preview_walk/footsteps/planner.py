"""The walking lab's footstep planner: walks of strides from a stance or from another plan."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from math import isfinite
from operator import index
from typing import Literal

from preview_walk.errors import InvalidInput
from preview_walk.footsteps.footstep import Footstep
from preview_walk.footsteps.limits import GaitLimits
from preview_walk.footsteps.plan import FootstepPlan
from preview_walk.geometry.poses import Heading, as_heading, compose, heading_of, midfeet, pose_at
from preview_walk.types import FEET, Array, Foot, other

STAND_TIME = 1.6
"""Time (s) of standing before the first lift: as long as the preview, because a CoM at rest cannot
be asked for more (with 1.0 s the preview controller starts with a ZMP error of 0.2 m)."""


def sole_beside(frame: Heading, foot: Foot, step_width: float, z: float = 0.0) -> Array:
    """Return the (4, 4) pose of a level sole half a step width (m) to its side of `frame`."""
    x, y, yaw = compose(frame, 0.0, 0.5 * step_width if foot == "left" else -0.5 * step_width)
    return pose_at(x, y, yaw, z)


@dataclass(frozen=True)
class Stride:
    """How one step moves the middle of the stance; None takes what the planner has.

    Attributes:
        forward: advance (m) in the direction halfway through the turn.
        left: advance (m) to the left of that direction.
        turn: change of heading (rad, left positive).
        width: lateral distance (m) of the landing sole from where the other would stand.
        time: step time (s): swing of this step and the double support after it.
        double_support_ratio: share of `time` in double support, in (0, 1).

    Raises:
        InvalidInput: a value that is not finite or not within its range.
    """

    forward: float = 0.0
    left: float = 0.0
    turn: float = 0.0
    width: float | None = None
    time: float | None = None
    double_support_ratio: float | None = None

    def __post_init__(self) -> None:
        """Check the sizes."""
        for name, unit in (("forward", "m"), ("left", "m"), ("turn", "rad")):
            value = getattr(self, name)
            if not isfinite(value):
                raise InvalidInput(f"{name} must be finite ({unit}), got {value}.")
        for name, unit in (("width", "m"), ("time", "s")):
            value = getattr(self, name)
            if value is not None and not (isfinite(value) and value > 0.0):
                raise InvalidInput(f"{name} must be > 0 {unit}, got {value}.")
        ratio = self.double_support_ratio
        if ratio is not None and not 0.0 < ratio < 1.0:
            raise InvalidInput(
                f"double_support_ratio must be in (0, 1), the share of the step time, got {ratio}."
            )


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
        count_of(n_steps, "n_steps")
        if not isfinite(turn):
            raise InvalidInput(f"turn must be finite (rad per step), got {turn}.")
        shares = ramp_shares(n_steps - 1, ramp)
        strides = [Stride(share * self.step_length, 0.0, share * turn) for share in shares]
        closing = [Stride()] if n_steps else []
        return self.walk(strides + closing, as_heading(start_pos, "start_pos"), start_foot)

    def walk(
        self,
        strides: Iterable[Stride],
        start: Sequence[float] | FootstepPlan = (0.0, 0.0),
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
            InvalidInput: a step breaks the limits, with its number and the bound.
        """
        if start_foot not in FEET:
            raise InvalidInput(f"start_foot must be 'left' or 'right', got {start_foot!r}.")
        plan = start if isinstance(start, FootstepPlan) else self.stand(start)
        last = max(plan[0].land, plan[-1].land)
        soles = {foot: plan.sole(foot, last) for foot in FEET}
        z = 0.5 * float(soles["left"][2, 3] + soles["right"][2, 3])
        frame = midfeet(soles["left"], soles["right"])
        lift = last + max(STAND_TIME, 2.0 * plan.weight_shift)
        steps: list[Footstep] = []
        foot = start_foot
        for stride in strides:
            width = self.step_width if stride.width is None else stride.width
            time = self.step_time if stride.time is None else stride.time
            ratio = stride.double_support_ratio or self.double_support_ratio
            # Half of the turn before the advance and half after: the walk stays on an arc.
            frame = compose(frame, 0.0, 0.0, 0.5 * stride.turn)
            frame = compose(frame, stride.forward, stride.left, 0.5 * stride.turn)
            pose = sole_beside(frame, foot, width, z)
            stance = soles[other(foot)]
            if limits is not None:
                number = len(plan.steps) + len(steps) + 1
                pose = limits.checked(number, foot, stance, soles[foot], pose, shorten)
                landing = heading_of(pose)
                frame = compose(landing, 0.0, -0.5 * width if foot == "left" else 0.5 * width)
            land = lift + time * (1.0 - ratio)
            steps.append(Footstep(foot, pose, lift, land))
            soles[foot] = pose
            foot, lift = other(foot), land + time * ratio
        return plan.replace_after(last, steps)

    def stand(self, start: Sequence[float] = (0.0, 0.0)) -> FootstepPlan:
        """Return the plan without steps, a step width apart, at (x, y) or (x, y, yaw) (m, rad)."""
        frame = as_heading(start, "start")
        left, right = (sole_beside(frame, foot, self.step_width) for foot in FEET)
        return FootstepPlan.standing(left, right)

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


def count_of(value: int, name: str) -> int:
    """Return the number.

    Raises:
        InvalidInput: it is not an integer >= 0.
    """
    try:
        count = -1 if isinstance(value, bool) else index(value)
    except TypeError:
        count = -1
    if count < 0:
        raise InvalidInput(f"{name} must be an integer >= 0, got {value!r}.")
    return count


def ramp_shares(count: int, ramp: int) -> list[float]:
    """Return the share of the full size of each of `count` strides, ramped up and down.

    Raises:
        InvalidInput: ramp is not an integer >= 0.
    """
    size = count_of(ramp, "ramp") + 1
    return [min(1.0, (i + 1) / size, (count - i) / size) for i in range(count)]
