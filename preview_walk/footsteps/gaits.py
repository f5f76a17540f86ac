"""Whole walks: straight or backwards, sideways, on the spot, turning in place, along an arc.

Each takes a `FootstepPlanner` (sizes and times), starts at a place or goes on from another plan,
and ends with the feet side by side exactly where it was asked to.  The number of steps is the
smallest that keeps the planner's step length and the limits.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from math import ceil, sin

import numpy as np

from preview_walk.arguments import MOST, count_of, finite_number, instance_of, positive_number
from preview_walk.errors import InvalidInput
from preview_walk.footsteps.layout import Start
from preview_walk.footsteps.limits import GaitLimits
from preview_walk.footsteps.plan import FootstepPlan
from preview_walk.footsteps.planner import FootstepPlanner
from preview_walk.footsteps.stride import Stride, ramp_shares
from preview_walk.types import Foot

_MORE_STEPS = 60
"""A walk of twice the fewest steps and this many more is refused for good."""

_WIDER = 2.0
"""Wider stances than the planner's by up to this much (m) are tried for a turn in place."""

_CLOSE = 1e-9
"""Lengths (m) and angles (rad) nearer than this are equal: rounding."""


def straight(
    distance: float,
    planner: FootstepPlanner,
    start: Start = (0.0, 0.0),
    start_foot: Foot = "left",
    *,
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

    Raises:
        InvalidInput: an argument is not what is described here, or the limits do not allow it.
    """
    bounds, distance = limits_for(planner, limits), finite_number(distance, "distance", "m")
    reach = bounds.forward if distance > 0.0 else bounds.backward

    def build(count: int, width: float) -> FootstepPlan:
        shares = ramp_shares(count, ramp)
        strides = [Stride(distance * share / sum(shares), width=width) for share in shares]
        if max((abs(s.forward) for s in strides), default=0.0) > abs(planner.step_length) + _CLOSE:
            raise _too_long()
        return planner.walk(strides + [Stride()] * bool(count), start, start_foot, bounds)

    count = _count(distance, min(abs(planner.step_length), reach), "distance")
    return _fewest(count, build, [planner.step_width])


def sideways(
    distance: float,
    planner: FootstepPlanner,
    start: Start = (0.0, 0.0),
    limits: GaitLimits | None = None,
) -> FootstepPlan:
    """Return a walk over `distance` (m) to the left; negative goes to the right.

    The foot on that side opens, the other closes, so the soles are never nearer than in stance.

    Args:
        distance: from stance to stance, m.
        planner: sizes and times.
        start: where to start, or a plan to go on from.
        limits: bounds of a step; None takes those of a 0.8 m leg.

    Raises:
        InvalidInput: an argument is not what is described here, or the limits do not allow it.
    """
    bounds, distance = limits_for(planner, limits), finite_number(distance, "distance", "m")
    reach = min(abs(planner.step_length), bounds.max_width - planner.step_width)

    def build(count: int, width: float) -> FootstepPlan:
        pair = [Stride(left=distance / max(count, 1), width=width), Stride(width=width)]
        return planner.walk(pair * count, start, "left" if distance > 0.0 else "right", bounds)

    return _fewest(_count(distance, reach, "distance"), build, [planner.step_width])


def on_the_spot(
    n_steps: int,
    planner: FootstepPlanner,
    start: Start = (0.0, 0.0),
    start_foot: Foot = "left",
    limits: GaitLimits | None = None,
) -> FootstepPlan:
    """Return `n_steps` steps that land where they lifted.

    Args:
        n_steps: number of steps, >= 0.
        planner: sizes and times.
        start: where to start, or a plan to go on from.
        start_foot: the foot that swings first.
        limits: bounds of a step; None takes those of a 0.8 m leg.

    Raises:
        InvalidInput: an argument is not what is described here, or the limits do not allow it.
    """
    bounds, count = limits_for(planner, limits), count_of(n_steps, "n_steps")
    return planner.walk([Stride()] * count, start, start_foot, bounds)


def turn_in_place(
    angle: float,
    planner: FootstepPlanner,
    start: Start = (0.0, 0.0),
    limits: GaitLimits | None = None,
) -> FootstepPlan:
    """Return a turn by `angle` (rad, left positive, any number of turns) about the midfeet point.

    The foot on the side of the turn opens, the other closes.  Where the soles would collide the
    feet stand wider while they turn, and two more steps bring them back.

    Args:
        angle: from stance to stance, rad.
        planner: sizes and times.
        start: where to start, or a plan to go on from.
        limits: bounds of a step; None takes those of a 0.8 m leg.

    Raises:
        InvalidInput: an argument is not what is described here, or the limits do not allow it.
    """
    bounds, angle = limits_for(planner, limits), finite_number(angle, "angle", "rad")
    first: Foot = "left" if angle > 0.0 else "right"
    widest = max(min(bounds.max_width, planner.step_width + _WIDER), planner.step_width)
    widths = np.arange(planner.step_width, widest + 0.01, 0.02)

    def build(count: int, width: float) -> FootstepPlan:
        pair = [Stride(turn=angle / max(count, 1), width=width), Stride(width=width)]
        closing = [Stride()] * 2 if count and width > planner.step_width else []
        return planner.walk([*pair * count, *closing], start, first, bounds)

    # Wider where that saves steps: the fewest steps first, the narrowest stance among them.
    count = _count(angle, 0.8 * bounds.turn_out, "angle")
    return _fewest(count, build, widths.tolist())


def arc(
    radius: float,
    angle: float,
    planner: FootstepPlanner,
    start: Start = (0.0, 0.0),
    start_foot: Foot | None = None,
    *,
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

    Raises:
        InvalidInput: an argument is not what is described here, or the limits do not allow it.
    """
    bounds, angle = limits_for(planner, limits), finite_number(angle, "angle", "rad")
    radius = positive_number(radius, "radius", "m")
    first: Foot = start_foot or ("left" if angle > 0.0 else "right")

    def build(count: int, width: float) -> FootstepPlan:
        shares = ramp_shares(count, ramp)
        turns = [angle * share / sum(shares) for share in shares]
        if max((abs(t) for t in turns), default=0.0) * radius > abs(planner.step_length) + _CLOSE:
            raise _too_long()
        chords = [2.0 * radius * sin(0.5 * abs(turn)) for turn in turns]
        strides = [Stride(c, turn=t, width=width) for c, t in zip(chords, turns, strict=True)]
        return planner.walk(strides + [Stride()] * bool(count), start, first, bounds)

    count = _count(radius * angle, min(abs(planner.step_length), bounds.forward), "angle")
    return _fewest(count, build, [planner.step_width])


def limits_for(planner: FootstepPlanner, limits: GaitLimits | None) -> GaitLimits:
    """Return the given limits, or those of a 0.8 m leg with the planner's step width.

    Args:
        planner: whose step width counts.
        limits: bounds of a step, or None.

    Raises:
        InvalidInput: the planner or the limits are something else.
    """
    width = instance_of(planner, FootstepPlanner, "planner").step_width
    if limits is None:
        return GaitLimits.for_leg(0.8, width)
    return instance_of(limits, GaitLimits, "limits")


def _count(total: float, size: float, name: str) -> int:
    """Return the number of steps of a size that make up a total; `name`: its argument."""
    if total and size <= 0.0:
        raise InvalidInput(
            "step_length must not be 0 to cover a distance, got 0.0.", argument="step_length"
        )
    if total and abs(total) > MOST * size:
        raise InvalidInput(
            f"{name} must be walked in at most {MOST} steps, got {total:g} with steps of {size:g}.",
            argument=name,
        )
    return ceil(abs(total) / size - _CLOSE) if total else 0


def _too_long() -> InvalidInput:
    """Return the refusal of a walk with too few steps."""
    return InvalidInput(
        "a stride is longer than the planner's step_length.", argument="step_length"
    )


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
    assert refusal is not None, "at least one width was tried"
    raise refusal
