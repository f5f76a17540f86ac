"""Velocity commands: footsteps that follow (vx, vy, yaw rate) and always end in a safe stop.

A command replaces the steps that lift later than `LEAD` from now; the step in the air keeps its
landing, and the first new step keeps the foot and lift time that the plan had for it, because the
weight is already on its way.  Every plan returned is complete: it follows the command for a
while, slows down, and stands with the feet side by side.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import sqrt

import numpy as np

from preview_walk.arguments import (
    LARGEST,
    MOST,
    finite_number,
    instance_of,
    number_from_zero,
    real_array,
    shown,
)
from preview_walk.errors import InvalidInput
from preview_walk.footsteps.footstep import Footstep
from preview_walk.footsteps.limits import GaitLimits
from preview_walk.footsteps.plan import FootstepPlan
from preview_walk.footsteps.reading import PlanLike, as_plan
from preview_walk.geometry.poses import Heading, compose, heading_of, pose_at, relative
from preview_walk.types import Foot, other

HORIZON = 2.4
"""Time (s) for which a command is followed when no other comes: a preview and a step."""

LEAD = 0.3
"""Steps lifting within this time (s) are not changed any more.  A change of the ZMP so near would
ask the CoM for what it can no longer do: over random commands the DCM is off by 10 mm at most,
and by 27 mm if every step not yet lifted is changed."""

START_DELAY = 1.2
"""Time (s) from a command to a standing robot to its first lift, in which the weight shifts."""

_ROUNDING = 1e-6
"""Speeds (m/s) nearer than this are equal."""


def follow_velocity(
    plan: PlanLike,
    t: float,
    command: Sequence[float],
    limits: GaitLimits,
    duration: float = HORIZON,
) -> FootstepPlan:
    """Return the plan that follows a velocity command from now on.

    The forward speed changes by at most `limits.speed_change` per step.  Step length and time
    grow together with the speed; a command beyond the limits is scaled down to them in all its
    parts, so that the walk bends as asked.  Sidesteps and tight turns are made by the foot on
    their side; the other follows.  The same command given again changes nothing but the end.

    Args:
        plan: the walk up to now; whatever `as_plan` takes.
        t: now, s.
        command: vx, vy (m/s) and yaw rate (rad/s) in the frame of the walking robot.
        limits: bounds of a step.
        duration: steps lifting within this time (s) from now follow the command; then the walk
            stops.

    Raises:
        InvalidInput: the command is not three finite numbers, a time is not one, or the plan is
            none.
    """
    plan, t = as_plan(plan), finite_number(t, "t", "s")
    vx, vy, wz = saturated(command, limits)
    duration = number_from_zero(duration, "duration", "s")
    done = len(plan.lifted(t + LEAD))
    planned = plan.steps[done] if done < len(plan.steps) else None
    last = plan[1 + done]
    moving = vx != 0.0 or vy != 0.0 or wz != 0.0
    if planned is not None:
        foot, lift = planned.foot, planned.lift
    elif moving:
        foot = _first_foot(vy, wz, last)
        lift = max(t + START_DELAY, last.land + 2.0 * plan.weight_shift)
    else:
        return plan
    stance = heading_of(plan.sole(other(foot), lift))
    swing = heading_of(plan.sole(foot, lift))
    advance = relative(limits.centre(foot, swing), limits.centre(other(foot), stance))[0]
    speed = _speed(advance, limits)
    z = float(plan.sole(other(foot), lift)[2, 3])
    steps: list[Footstep] = []
    while True:
        follow = moving and lift < t + duration
        closing = not follow and abs(speed) <= limits.speed_change + _ROUNDING
        goal = vx if follow else 0.0
        most = limits.speed_change
        speed = goal if closing else min(speed + most, max(speed - most, goal))
        time, ratio = rhythm(speed, limits)
        move = _move(foot, speed * time, vy * time, wz * time, limits) if follow else None
        target = _target(foot, stance, move or (speed * time, 0.0, 0.0), limits)
        sole = limits.clamp(foot, stance, target, swing)
        land = lift + time * (1.0 - ratio)
        if len(steps) >= MOST:
            raise InvalidInput(
                f"duration must be over within {MOST} steps, got {duration} s.", argument="duration"
            )
        steps.append(Footstep(foot, pose_at(*sole, z), lift, land))
        if closing:
            return plan.replace_after(t + LEAD, steps)
        swing, stance, foot, lift = stance, sole, other(foot), land + time * ratio


def rhythm(speed: float, limits: GaitLimits) -> tuple[float, float]:
    """Return step time (s) and double-support ratio for a forward speed (m/s).

    Both go linearly with the speed from the slow to the fast values of the limits, which are
    reached where the longest step at the fast step time would be made.

    Args:
        speed: m/s, forward or backward.
        limits: bounds of a step.
    """
    share = min(1.0, abs(speed) / _top_speed(limits))
    time = limits.slow_step_time + share * (limits.fast_step_time - limits.slow_step_time)
    slow, fast = limits.slow_double_support, limits.fast_double_support
    return time, slow + share * (fast - slow)


def saturated(command: Sequence[float], limits: GaitLimits) -> tuple[float, float, float]:
    """Return the command (vx, vy in m/s, yaw rate in rad/s), scaled down to what the limits allow.

    Args:
        command: vx, vy (m/s) and yaw rate (rad/s).
        limits: bounds of a step.

    Raises:
        InvalidInput: the command is not three finite numbers.
    """
    instance_of(limits, GaitLimits, "limits")
    try:
        speeds = real_array(command, "command", "three numbers")
    except InvalidInput:
        speeds = np.empty(0)
    if speeds.shape != (3,) or not np.abs(speeds).max() <= LARGEST:
        raise InvalidInput(
            "a velocity command must be (vx, vy, yaw rate), finite, in m/s and rad/s, "
            f"got {shown(command)}.",
            argument="command",
        )
    vx, vy, wz = speeds.tolist()
    time = limits.slow_step_time
    backward = _speed(-min(limits.forward, limits.backward), limits)
    share = max(
        vx / _top_speed(limits),
        vx / backward,
        # The opening foot makes the way of two steps, the closing foot none.
        2.0 * abs(vy) * time / max(limits.max_width - limits.step_width, 1e-9),
        2.0 * abs(wz) * time / (limits.turn_out + limits.turn_in),
        1.0,
    )
    return vx / share, vy / share, wz / share


def _top_speed(limits: GaitLimits) -> float:
    """Return the speed (m/s) of the longest steps at the fast step time."""
    return limits.forward / limits.fast_step_time


def _speed(length: float, limits: GaitLimits) -> float:
    """Return the speed (m/s) at which the rhythm makes steps of this length (m)."""
    slow = limits.slow_step_time
    bend = (slow - limits.fast_step_time) / _top_speed(limits)
    size = min(abs(length), limits.forward)
    # length = speed * (slow - bend * speed), solved without cancellation for bend -> 0.
    speed = 2.0 * size / (slow + sqrt(max(0.0, slow * slow - 4.0 * bend * size)))
    return speed if length >= 0.0 else -speed


def _first_foot(vy: float, wz: float, last: Footstep) -> Foot:
    """Return the foot that opens towards the command, or the one that did not step last."""
    side = vy or wz
    if side:
        return "left" if side > 0.0 else "right"
    return other(last.foot)


def _move(foot: Foot, dx: float, dy: float, turn: float, limits: GaitLimits) -> Heading:
    """Return the move (m, m, rad) of this foot's step, given the mean move per step."""
    side = 1.0 if foot == "left" else -1.0
    left = 2.0 * dy if side * dy > 0.0 else 0.0
    if turn == 0.0 or _even(dx, turn, limits):
        return dx, left, turn
    opening = min(2.0 * abs(turn), limits.turn_out)
    if side * turn > 0.0:
        return dx, left, side * opening
    return dx, left, -side * (2.0 * abs(turn) - opening)


def _even(dx: float, turn: float, limits: GaitLimits) -> bool:
    """Return whether the closing foot has room for its half of the turn."""
    closing: Foot = "right" if turn > 0.0 else "left"
    stance = (0.0, 0.0, 0.0)
    free = _target(closing, stance, (dx, 0.0, turn), limits)
    return limits.clamp(closing, stance, free) == free


def _target(foot: Foot, stance: Heading, move: Heading, limits: GaitLimits) -> Heading:
    """Return where a foot lands that makes this move (m, m, rad) from beside the standing one."""
    dx, dy, turn = move
    centre = compose(limits.centre(other(foot), stance), 0.0, 0.0, 0.5 * turn)
    half = 0.5 * limits.step_width
    return compose(compose(centre, dx, dy, 0.5 * turn), 0.0, half if foot == "left" else -half)
