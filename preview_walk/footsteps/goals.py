"""Walks to a goal pose and over given footholds."""

from __future__ import annotations

from collections.abc import Sequence
from math import atan2, ceil, cos, hypot

import numpy as np
from numpy.typing import ArrayLike

from preview_walk.errors import InvalidInput
from preview_walk.footsteps.footstep import Footstep
from preview_walk.footsteps.gaits import Start, limits_for
from preview_walk.footsteps.limits import GaitLimits
from preview_walk.footsteps.plan import FootstepPlan
from preview_walk.footsteps.planner import STAND_TIME, FootstepPlanner
from preview_walk.geometry.poses import (
    Heading,
    as_heading,
    as_pose,
    compose,
    heading_of,
    pose_at,
    relative,
)
from preview_walk.types import FEET, Array, Foot, other

_CLOSE = 1e-9


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
    bounds = limits_for(planner, limits)
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
    lift = last + max(STAND_TIME, 2.0 * plan.weight_shift)
    most = 100 + 20 * ceil((hypot(ahead[0], ahead[1]) + 1.0) / size)
    while not all(_near(_centre(f, soles[f], planner), target) for f in FEET):
        if len(steps) >= most:
            raise InvalidInput(f"no walk of {most} steps reaches the goal {target} in the limits.")
        stance = soles[other(foot)]
        centre = _centre(other(foot), stance, planner)
        move = _towards(relative(centre, target), size, bounds)
        side = 0.5 * planner.step_width if foot == "left" else -0.5 * planner.step_width
        wanted = compose(compose(centre, *move), 0.0, side)
        soles[foot] = bounds.clamp(foot, stance, wanted, soles[foot])
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
    bounds = limits_for(planner, limits)
    plan = start if isinstance(start, FootstepPlan) else planner.stand(start)
    times = [planner.step_time] * len(footholds) if step_times is None else list(step_times)
    if len(times) != len(footholds):
        raise InvalidInput(
            f"step_times must hold one time per foothold, {len(footholds)}, got {len(times)}."
        )
    last = plan[-1].land
    soles = {foot: plan.sole(foot, last) for foot in FEET}
    ground = float(soles["left"][2, 3])
    lift = last + max(STAND_TIME, 2.0 * plan.weight_shift)
    steps: list[Footstep] = []
    for (foot, place), time in zip(footholds, times, strict=True):
        number = len(plan.steps) + len(steps) + 1
        if foot not in FEET:
            raise InvalidInput(f"step {number} must be of foot 'left' or 'right', got {foot!r}.")
        pose = _sole_at(place, f"the sole of step {number}", ground)
        pose = bounds.checked(number, foot, soles[other(foot)], soles[foot], pose, shorten)
        land = lift + time * (1.0 - planner.double_support_ratio)
        steps.append(Footstep(foot, pose, lift, land))
        soles[foot] = pose
        lift = land + time * planner.double_support_ratio
    return plan.replace_after(last, steps)


def _sole_at(place: ArrayLike, name: str, ground: float) -> Array:
    """Return the pose (4, 4) of a sole given as (x, y), (x, y, yaw) or a pose."""
    try:
        values = np.array(place, dtype=np.float64)
    except (TypeError, ValueError):
        values = np.empty(0)
    if values.shape in ((2,), (3,)):
        return pose_at(*as_heading(values.tolist(), name), ground)
    return as_pose(place, name)


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
