"""Whole walks: straight, sideways, on the spot, turning, on an arc, to a goal, from a list.

Each takes a `FootstepPlanner` (sizes and times), starts at a place or goes on from another plan,
and ends with the feet side by side exactly where it was asked to (`from_list` ends where the list
ends).  The number of steps is the smallest that keeps the planner's step length and the limits.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from math import atan2, ceil, cos, hypot, isfinite, sin

import numpy as np
from numpy.typing import ArrayLike

from preview_walk.errors import InvalidInput
from preview_walk.planning.footstep_planner import (
    STAND_TIME,
    FootstepPlanner,
    Stride,
    count_of,
    ramp_shares,
)
from preview_walk.planning.footsteps import Footstep, FootstepPlan
from preview_walk.planning.limits import GaitLimits
from preview_walk.planning.pose import (
    Heading,
    as_heading,
    as_pose,
    compose,
    heading_of,
    pose_at,
    relative,
)
from preview_walk.types import FEET, Foot, other

Start = Sequence[float] | FootstepPlan
"""(x, y) or (x, y, yaw) midway between the first two soles, or a plan to go on from."""

_MORE_STEPS = 60
_CLOSE = 1e-9


def straight(
    distance: float,
    planner: FootstepPlanner,
    start: Start = (0.0, 0.0),
    start_foot: Foot = "left",
    limits: GaitLimits | None = None,
    ramp: int = 0,
) -> FootstepPlan:
    """Return a straight walk over `distance` (m); negative walks backwards.

    Args:
        distance: from stance to stance, m.
        planner: sizes and times.
        start: where to start, or a plan to go on from.
        start_foot: the foot that swings first.
        limits: bounds of a step; None takes those of a 0.8 m leg.
        ramp: number of shorter steps in which the walk speeds up and slows down.
    """
    _finite(distance, "distance", "m")
    bounds = _limits(planner, limits)
    reach = bounds.forward if distance > 0.0 else bounds.backward

    def build(count: int, width: float) -> FootstepPlan:
        shares = ramp_shares(count, ramp)
        strides = [Stride(distance * share / sum(shares), width=width) for share in shares]
        if max((abs(s.forward) for s in strides), default=0.0) > abs(planner.step_length) + _CLOSE:
            raise InvalidInput("a stride is longer than the planner's step_length.")
        return planner.walk([*strides, Stride()], start, start_foot, bounds)

    return _fewest(
        _count(distance, min(abs(planner.step_length), reach)), build, [planner.step_width]
    )


def sideways(
    distance: float,
    planner: FootstepPlanner,
    start: Start = (0.0, 0.0),
    limits: GaitLimits | None = None,
) -> FootstepPlan:
    """Return a walk over `distance` (m) to the left; negative goes to the right.

    The foot on that side opens, the other closes, so the soles are never nearer than in stance.
    """
    _finite(distance, "distance", "m")
    bounds = _limits(planner, limits)
    reach = min(abs(planner.step_length), bounds.max_width - planner.step_width)

    def build(count: int, width: float) -> FootstepPlan:
        pair = [Stride(left=distance / count, width=width), Stride(width=width)]
        return planner.walk(pair * count, start, "left" if distance > 0.0 else "right", bounds)

    return _fewest(_count(distance, reach), build, [planner.step_width])


def on_the_spot(
    n_steps: int,
    planner: FootstepPlanner,
    start: Start = (0.0, 0.0),
    start_foot: Foot = "left",
    limits: GaitLimits | None = None,
) -> FootstepPlan:
    """Return `n_steps` steps that land where they lifted."""
    count_of(n_steps, "n_steps")
    return planner.walk([Stride()] * n_steps, start, start_foot, _limits(planner, limits))


def turn_in_place(
    angle: float,
    planner: FootstepPlanner,
    start: Start = (0.0, 0.0),
    limits: GaitLimits | None = None,
) -> FootstepPlan:
    """Return a turn by `angle` (rad, left positive, any number of turns) about the midfeet point.

    The foot on the side of the turn opens, the other closes.  Where the soles would collide the
    feet stand wider while they turn, and two more steps bring them back.
    """
    _finite(angle, "angle", "rad")
    bounds = _limits(planner, limits)
    first: Foot = "left" if angle > 0.0 else "right"
    widths = np.arange(planner.step_width, max(bounds.max_width, planner.step_width) + 0.01, 0.02)

    def build(count: int, width: float) -> FootstepPlan:
        pair = [Stride(turn=angle / count, width=width), Stride(width=width)]
        closing = [Stride()] * 2 if count and width > planner.step_width else []
        return planner.walk([*pair * count, *closing], start, first, bounds)

    # Wider where that saves steps: the fewest steps first, the narrowest stance among them.
    count = _count(angle, 0.8 * bounds.turn_out)
    return _fewest(count, build, widths.tolist())


def arc(
    radius: float,
    angle: float,
    planner: FootstepPlanner,
    start: Start = (0.0, 0.0),
    start_foot: Foot | None = None,
    limits: GaitLimits | None = None,
    ramp: int = 0,
) -> FootstepPlan:
    """Return a walk along a circle; the midfeet points lie exactly on it.

    Args:
        radius: of the circle that the midfeet point walks on, m, > 0.
        angle: walked around the centre, rad; positive turns left, negative right.
        planner: sizes and times; the step length is measured along the circle.
        start: where to start, or a plan to go on from.
        start_foot: the foot that swings first; None takes the one on the inside.
        limits: bounds of a step; None takes those of a 0.8 m leg.
        ramp: number of shorter steps in which the walk speeds up and slows down.
    """
    _finite(angle, "angle", "rad")
    if not (isfinite(radius) and radius > 0.0):
        raise InvalidInput(f"radius must be > 0 m, got {radius}.")
    bounds = _limits(planner, limits)
    first: Foot = start_foot or ("left" if angle > 0.0 else "right")

    def build(count: int, width: float) -> FootstepPlan:
        shares = ramp_shares(count, ramp)
        turns = [angle * share / sum(shares) for share in shares]
        if max((abs(t) for t in turns), default=0.0) * radius > abs(planner.step_length) + _CLOSE:
            raise InvalidInput("a stride is longer than the planner's step_length.")
        chords = [2.0 * radius * sin(0.5 * abs(turn)) for turn in turns]
        strides = [Stride(c, turn=t, width=width) for c, t in zip(chords, turns, strict=True)]
        return planner.walk([*strides, Stride()], start, first, bounds)

    return _fewest(
        _count(radius * angle, min(abs(planner.step_length), bounds.forward)),
        build,
        [planner.step_width],
    )


def to_pose(
    goal: Sequence[float],
    planner: FootstepPlanner,
    start: Start = (0.0, 0.0),
    limits: GaitLimits | None = None,
) -> FootstepPlan:
    """Return a walk to the goal (x, y) or (x, y, yaw) of the midfeet point (m, rad).

    Far from the goal the walk turns towards it and goes ahead; within four step lengths it steps
    forwards, backwards and sideways and turns at once.
    """
    target = as_heading(goal, "goal")
    bounds = _limits(planner, limits)
    plan = start if isinstance(start, FootstepPlan) else planner.stand(start)
    last = plan[-1].land
    soles = {foot: heading_of(plan.sole(foot, last)) for foot in FEET}
    z = float(plan.sole("left", last)[2, 3])
    size = min(abs(planner.step_length), bounds.forward)
    if size <= 0.0:
        raise InvalidInput("step_length must not be 0 to walk to a goal, got 0.0.")
    ahead = relative(_centre("right", soles["right"], planner), target)
    foot: Foot = "left" if (ahead[1] or ahead[2]) >= 0.0 else "right"
    steps: list[Footstep] = []
    lift = last + max(STAND_TIME, 2.0 * plan.settle)
    most = 100 + 20 * ceil((hypot(ahead[0], ahead[1]) + 1.0) / size)
    while not all(_near(_centre(f, soles[f], planner), target) for f in FEET):
        if len(steps) >= most:
            raise InvalidInput(f"no walk of {most} steps reaches the goal {target} in the limits.")
        stance = soles[other(foot)]
        centre = _centre(other(foot), stance, planner)
        move = _towards(relative(centre, target), size, bounds)
        side = 0.5 * planner.step_width if foot == "left" else -0.5 * planner.step_width
        wanted = compose(compose(centre, *move), 0.0, side)
        soles[foot] = bounds.clamp(foot, stance, wanted)
        land = lift + planner.single_support_time
        steps.append(Footstep(foot, pose_at(*soles[foot], z), lift, land))
        foot, lift = other(foot), land + planner.double_support_time
    return plan.replace_after(last, steps)


def from_list(
    footholds: Sequence[tuple[Foot, ArrayLike]],
    planner: FootstepPlanner,
    start: Start = (0.0, 0.0),
    limits: GaitLimits | None = None,
    step_times: Sequence[float] | None = None,
    shorten: bool = False,
) -> FootstepPlan:
    """Return the walk over given footholds, checked step by step.

    Args:
        footholds: (foot, sole) in order; the sole is (x, y), (x, y, yaw) on the ground height of
            the start, or a pose (4, 4) with height and slope.
        planner: width of the first stance, and times.
        start: where to start, or a plan to go on from.
        limits: bounds of a step; None takes those of a 0.8 m leg.
        step_times: step time (s) of each step; None takes the planner's.
        shorten: cut steps out of the limits to size (level soles only) instead of refusing them.

    Raises:
        InvalidInput: a step out of the limits, with its number and the bound.
    """
    bounds = _limits(planner, limits)
    plan = start if isinstance(start, FootstepPlan) else planner.stand(start)
    times = [planner.step_time] * len(footholds) if step_times is None else list(step_times)
    if len(times) != len(footholds):
        raise InvalidInput(
            f"step_times must hold one time per foothold, {len(footholds)}, got {len(times)}."
        )
    last = plan[-1].land
    soles = {foot: plan.sole(foot, last) for foot in FEET}
    lift = last + max(STAND_TIME, 2.0 * plan.settle)
    steps: list[Footstep] = []
    for (foot, place), time in zip(footholds, times, strict=True):
        number = len(plan.steps) + len(steps) + 1
        if foot not in FEET:
            raise InvalidInput(f"step {number} must be of foot 'left' or 'right', got {foot!r}.")
        if getattr(place, "ndim", 1) == 1 and len(place) in (2, 3):  # type: ignore[arg-type]
            heading = as_heading(place, f"step {number}")  # type: ignore[arg-type]
            pose = pose_at(*heading, float(plan[0].pos[2]))
        else:
            pose = as_pose(place, f"step {number}")
        stance = soles[other(foot)]
        problem = bounds.problem(foot, stance, pose)
        if problem is not None and not shorten:
            raise InvalidInput(f"step {number} {problem}.")
        if problem is not None:
            landing = bounds.clamp(foot, heading_of(stance), heading_of(pose))
            pose = pose_at(*landing, float(pose[2, 3]))
        land = lift + time * (1.0 - planner.double_support_ratio)
        steps.append(Footstep(foot, pose, lift, land))
        soles[foot] = pose
        lift = land + time * planner.double_support_ratio
    return plan.replace_after(last, steps)


def _limits(planner: FootstepPlanner, limits: GaitLimits | None) -> GaitLimits:
    return GaitLimits.for_leg(0.8, planner.step_width) if limits is None else limits


def _finite(value: float, name: str, unit: str) -> None:
    if not isfinite(value):
        raise InvalidInput(f"{name} must be finite ({unit}), got {value}.")


def _count(total: float, size: float) -> int:
    if total and size <= 0.0:
        raise InvalidInput("step_length must not be 0 to cover a distance, got 0.0.")
    return ceil(abs(total) / size - _CLOSE) if total else 0


def _fewest(
    count: int, build: Callable[[int, float], FootstepPlan], widths: Sequence[float]
) -> FootstepPlan:
    """Return the plan with the fewest strides, from `count` on, that the limits allow.

    Of several widths the first one that they allow.
    """
    refusal: InvalidInput | None = None
    for n in range(count, 2 * count + _MORE_STEPS):
        for width in widths:
            try:
                return build(n, width)
            except InvalidInput as error:
                refusal = refusal or error
    raise refusal or InvalidInput("no walk was built.")


def _centre(foot: Foot, sole: Heading, planner: FootstepPlanner) -> Heading:
    half = 0.5 * planner.step_width
    return compose(sole, 0.0, -half if foot == "left" else half)


def _near(a: Heading, b: Heading) -> bool:
    return max(map(abs, relative(b, a))) < _CLOSE


def _towards(rest: Heading, size: float, limits: GaitLimits) -> Heading:
    """Return the move of one step that reduces what rests (x, y, yaw) to the goal."""
    x, y, yaw = rest
    if hypot(x, y) > 4.0 * size:
        bearing = atan2(y, x)
        return size * max(0.0, cos(bearing)) ** 3, 0.0, bearing
    back = min(size, limits.backward)
    return min(size, max(-back, x)), min(size, max(-size, y)), yaw
