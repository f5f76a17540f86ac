"""Walks to a goal pose and over given footholds."""

from __future__ import annotations

from collections.abc import Sequence
from math import atan2, ceil, cos, hypot

from numpy.typing import ArrayLike

from preview_walk.arguments import MOST, foot_of, positive_number, real_array, shown
from preview_walk.errors import InvalidInput
from preview_walk.footsteps.gaits import limits_for
from preview_walk.footsteps.layout import Layout, Start
from preview_walk.footsteps.limits import GaitLimits
from preview_walk.footsteps.plan import FootstepPlan
from preview_walk.footsteps.planner import FootstepPlanner
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
"""Lengths (m) and angles (rad) nearer than this are equal: rounding."""


def to_pose(
    goal: Sequence[float],
    planner: FootstepPlanner,
    start: Start = (0.0, 0.0),
    limits: GaitLimits | None = None,
) -> FootstepPlan:
    """Return a walk to the goal (x, y) or (x, y, yaw).

    Far from the goal the walk turns towards it and goes ahead; within four step lengths it steps
    forwards, backwards and sideways and turns at once.

    Args:
        goal: of the midfeet point, m and rad; the yaw is 0 where it is left out.
        planner: sizes and times of the steps.
        start: where to start, or a plan to go on from.
        limits: bounds of a step; None takes those of a 0.8 m leg.

    Raises:
        InvalidInput: the goal is no place, or the limits do not let it be reached.
    """
    target, bounds = as_heading(goal, "goal"), limits_for(planner, limits)
    layout = Layout(planner.begin(start))
    soles = {foot: heading_of(layout.soles[foot]) for foot in FEET}
    z = float(layout.soles["left"][2, 3])
    size = min(abs(planner.step_length), bounds.forward)
    if size <= 0.0:
        raise InvalidInput(
            "step_length must not be 0 to walk to a goal, got 0.0.", argument="step_length"
        )
    ahead = relative(_centre("right", soles["right"], planner), target)
    foot: Foot = "left" if (ahead[1] or ahead[2]) >= 0.0 else "right"
    most = min(MOST, 100 + 20 * ceil(min((hypot(ahead[0], ahead[1]) + 1.0) / size, MOST)))
    while not all(_near(_centre(f, soles[f], planner), target) for f in FEET):
        if len(layout.steps) >= most:
            raise InvalidInput(
                f"no walk of {most} steps reaches the goal {target} in the limits.",
                argument="goal",
            )
        stance = soles[other(foot)]
        centre = _centre(other(foot), stance, planner)
        move = _towards(relative(centre, target), size, bounds)
        side = 0.5 * planner.step_width if foot == "left" else -0.5 * planner.step_width
        wanted = compose(compose(centre, *move), 0.0, side)
        soles[foot] = bounds.clamp(foot, stance, wanted, soles[foot])
        pose = pose_at(*soles[foot], z)
        layout.add(foot, pose, planner.single_support_time, planner.double_support_time)
        foot = other(foot)
    return layout.plan()


def from_list(
    footholds: Sequence[tuple[Foot, ArrayLike]],
    planner: FootstepPlanner,
    start: Start = (0.0, 0.0),
    limits: GaitLimits | None = None,
    *,
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
        InvalidInput: a step out of the limits, with its number and the bound; `argument` is
            "footholds" then.
    """
    bounds, places = limits_for(planner, limits), _pairs(footholds)
    times = _times(step_times, [planner.step_time] * len(places))
    layout = Layout(planner.begin(start))
    ground = float(layout.soles["left"][2, 3])
    for (foot, place), time in zip(places, times, strict=True):
        try:
            foot_of(foot, f"the foot of step {layout.number}")
            pose = _sole_at(place, f"the sole of step {layout.number}", ground)
            pose = layout.allowed(foot, pose, bounds, shorten)
        except InvalidInput as error:
            raise InvalidInput(str(error), argument="footholds") from None
        ratio = planner.double_support_ratio
        layout.add(foot, pose, time * (1.0 - ratio), time * ratio)
    return layout.plan()


def _pairs(footholds: Sequence[tuple[Foot, ArrayLike]]) -> list[tuple[Foot, ArrayLike]]:
    """Return the footholds as pairs."""
    need = "footholds must hold a pair (foot, sole) for each step"
    try:
        return [(foot, sole) for foot, sole in footholds]
    except (TypeError, ValueError):
        raise InvalidInput(f"{need}, got {shown(footholds)}.", argument="footholds") from None


def _times(step_times: Sequence[float] | None, usual: list[float]) -> list[float]:
    """Return the step times (s), as many as usual."""
    if step_times is None:
        return usual
    name = "step_times"
    times = real_array(step_times, name, "a time in s for each foothold")
    if times.shape != (len(usual),):
        raise InvalidInput(
            f"step_times must hold one time per foothold, {len(usual)}, got {shown(step_times)}.",
            argument=name,
        )
    return [positive_number(time, name, "s") for time in times.tolist()]


def _sole_at(place: ArrayLike, name: str, ground: float) -> Array:
    """Return the pose (4, 4) of a sole given as (x, y), (x, y, yaw) or a pose."""
    values = real_array(place, name, "(x, y), (x, y, yaw) or a (4, 4) pose")
    if values.shape in ((2,), (3,)):
        return pose_at(*as_heading(values, name), ground)
    return as_pose(place, name)


def _centre(foot: Foot, sole: Heading, planner: FootstepPlanner) -> Heading:
    """Return the middle of a stance of the planner's width with one sole here."""
    half = 0.5 * planner.step_width
    return compose(sole, 0.0, -half if foot == "left" else half)


def _near(a: Heading, b: Heading) -> bool:
    """Return whether two frames are the same but for rounding."""
    return max(map(abs, relative(b, a))) < _CLOSE


def _towards(rest: Heading, size: float, limits: GaitLimits) -> Heading:
    """Return the move of one step that reduces what rests (x, y, yaw) to the goal."""
    x, y, yaw = rest
    if hypot(x, y) > 4.0 * size:
        bearing = atan2(y, x)
        return size * max(0.0, cos(bearing)) ** 3, 0.0, bearing
    back = min(size, limits.backward)
    return min(size, max(-back, x)), min(size, max(-size, y)), yaw
