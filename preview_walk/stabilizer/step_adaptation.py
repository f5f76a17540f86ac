"""Step adaptation: where and when the swing foot lands so that a pushed walker can go on.

The divergent component of motion (DCM) xi = c + c' / omega runs away from the ZMP p:
xi' = omega (xi - p) (Takenaka 2009; Englsberger, Ott and Albu-Schaeffer 2015). Over the
rest of a step, with the ZMP moved by a constant delta from where the plan has it, the error e of
the DCM grows by tau = exp(omega T) to

    e(T) = e tau - delta (tau - 1)

While the sole leaves room for the delta that brings e(T) to zero the plan is kept. Otherwise the
landing moves, by place and by time (Khadiv et al. 2020; Griffin et al. 2017): among landing times
within the limits, the one is taken whose foothold leaves the next step the DCM nearest to the
plan's offset from its foot, then nearest to the plan; delta then counts from the stance sole's
centre. Each time is a small convex problem an axis (foothold, delta, and the offset that the next
step takes up) in a box; all times are solved at once.
"""

from __future__ import annotations

from math import exp

import numpy as np

from preview_walk.footsteps.footstep import Footstep
from preview_walk.footsteps.plan import FootstepPlan
from preview_walk.geometry.poses import compose, heading_of, pose_at
from preview_walk.stabilizer.foothold import Room, Wanted, best_footholds
from preview_walk.stabilizer.recovery_steps import SHORT_PAUSE, land_at
from preview_walk.stabilizer.situation import Situation
from preview_walk.stabilizer.step_limits import StepLimits
from preview_walk.types import Array, Foot, other

TIMES = 40
"""Landing times that are compared."""

TIME_WEIGHT, KEEP_TIME = 0.2, 2.0
"""Weights of a squared second of landing time beside the commanded one, and beside the present
one, in the cost of `foothold`."""

CARRY = 0.4
"""Share of the sole's half size of DCM offset that the next step carries by its ZMP."""

SPEED_SHARE, ACCELERATION_SHARE = (0.53, 0.07), (0.173, 0.45)
"""A quintic from rest to rest covers 8/15 of its top speed times its time, and sqrt(3)/10 of its
top acceleration times that squared; a foot under way gets further by the second shares of its speed
times the time left."""

CATCH = 0.3
"""Share that is used of the DCM offset which one more step, as quick as it can be, would catch."""

DROP = 40.0
"""Acceleration (m/s^2) with which the swing foot may come down."""

LATEST = 0.08
"""A landing nearer than this (s) stays, but for two answers: the foot is put down at once where it
is, or lands elsewhere after it has risen again."""

RELIFT = 0.18
"""A foot about to land that rises again needs this long (s) at least."""

SOON = 0.012
"""A foot that is nearly down can be down within this time (s): the ZMP reaches its sole sooner."""


def adapt_step(situation: Situation, nominal: Footstep, limits: StepLimits) -> FootstepPlan | None:
    """Return the plan whose step in the air answers a DCM error, or None where none is needed.

    Later steps keep their places relative to the changed one and their times after it.

    Args:
        situation: now; without a foot that swings freely there is no answer.
        nominal: the step as it was commanded, before any change.
        limits: what a recovery step may be.
    """
    plan, t, dcm = situation.plan, situation.t, situation.dcm
    step = plan.swing_at(t)
    if step is None or situation.swing is None or step.land - t < SOON:
        return None
    following = plan.next_lift(step.land)
    pause = following.lift - step.land if following is not None else plan.weight_shift
    middle = step.land + 0.5 * min(pause, plan.weight_shift)
    stance = plan.sole(other(step.foot), t)
    axes, origin = stance[:2, :2], stance[:2, 3]
    error = (dcm - situation.planned_dcm(t)) @ axes
    if _sole_suffices(error, exp(limits.omega * (middle - t)), limits):
        return None

    late = step.land - t < LATEST
    position, velocity = situation.swing
    land = _landing_times(t, step, nominal, float(position[2]), limits)
    here, speed = (position[:2] - origin) @ axes, velocity[:2] @ axes
    box = _reachable(step.foot, here, speed, (land - t)[:, None], limits)
    wanted = Wanted(
        (nominal.pose[:2, 3] - origin) @ axes,
        (step.pose[:2, 3] - origin) @ axes,
        (situation.planned_dcm(middle) - step.pose[:2, 3]) @ axes,
    )
    tau = np.exp(limits.omega * (land + 0.5 * min(pause, SHORT_PAUSE) - t))[:, None]
    room = Room(box, _carried(limits, step.foot, wanted.offset), np.array(limits.zmp))
    place, cost = best_footholds((dcm - origin) @ axes * tau, tau - 1.0, wanted, room)
    cost += TIME_WEIGHT * (land - nominal.land) ** 2 + KEEP_TIME * (land - step.land) ** 2
    best = int(np.argmin(cost))

    heading = heading_of(stance)
    turn = heading_of(step.pose)[2] - heading[2]
    x, y = place[best].tolist()
    sole = limits.gait.clamp(step.foot, heading, compose(heading, x, y, turn))
    pose = pose_at(*sole, float(step.pose[2, 3]))
    if late and best == len(land) - 1:  # down at once; the next step keeps its time
        later = plan.steps[plan.steps.index(step) + 1 :]
        return plan.retarget(t, pose, float(land[best])).replace_after(t, later)
    return land_at(plan, t, pose, float(land[best]))


def _sole_suffices(error: Array, growth: float, limits: StepLimits) -> bool:
    """Return whether a ZMP within the sole brings the DCM's error (2,), stance axes, to rest.

    `growth`: of the error until the next double support.
    """
    half = np.array(limits.zmp)
    grown = error * growth
    rest = grown - np.clip(grown / (growth - 1.0), -half, half) * (growth - 1.0)
    return bool(np.abs(rest).max() <= limits.tolerance)


def _landing_times(
    t: float, step: Footstep, nominal: Footstep, height: float, limits: StepLimits
) -> Array:
    """Return the times (s) at which the foot, at `height` (m), may land; last, the present one.

    Where that is so near that it stays, the last is at once.
    """
    height = max(0.0, height - float(step.pose[2, 3]))
    drop = float(np.sqrt(height / (ACCELERATION_SHARE[0] * DROP)))
    late = step.land - t < LATEST
    first = max(t + (RELIFT if late else max(LATEST, drop)), step.lift + limits.swing_time[0])
    last = max(step.lift + limits.swing_time[1], first + LATEST)
    keep = min(t + max(SOON, drop), step.land) if late else max(step.land, first)
    return np.append(np.linspace(first, last, TIMES), (max(nominal.land, first), keep))


def _reachable(
    foot: Foot, here: Array, speed: Array, left: Array, limits: StepLimits
) -> tuple[Array, Array]:
    """Return the lowest and highest footholds (N, 2), m, in the stance foot's axes.

    The leg reaches them, and the foot, now at `here` (2,) with `speed` (2,), gets there in the time
    `left` (N, 1), s.
    """
    gait, side = limits.gait, 1.0 if foot == "left" else -1.0
    slow = limits.swing_speed * SPEED_SHARE[0] * left
    weak = limits.swing_acceleration * ACCELERATION_SHARE[0] * left**2
    ahead = np.minimum(
        slow + SPEED_SHARE[1] * speed * left, weak + ACCELERATION_SHARE[1] * speed * left
    )
    behind = np.minimum(
        slow - SPEED_SHARE[1] * speed * left, weak - ACCELERATION_SHARE[1] * speed * left
    )
    low = np.array([-gait.backward, gait.min_width if side > 0 else -gait.max_width])
    high = np.array([gait.forward, gait.max_width if side > 0 else -gait.min_width])
    return np.clip(here - behind, low, high), np.clip(here + ahead, low, high)


def _carried(limits: StepLimits, foot: Foot, offset: Array) -> tuple[Array, Array]:
    """Return how far (2,) below and above the plan's DCM offset the next step can still catch it.

    The next step brings the DCM back to its foot from offsets up to its reach, shrunk by the growth
    of the DCM meanwhile, and the sole's half size, by its ZMP; beyond the outer edge it cannot.
    Axes of the stance foot; `foot` is in the air.
    """
    gait, half = limits.gait, np.array(limits.zmp)
    decay = exp(-limits.omega * (limits.swing_time[0] + SHORT_PAUSE))
    ankle = (1.0 - decay) * half
    back, inner = decay * gait.backward + ankle[0], decay * gait.max_width + ankle[1]
    ahead, outer = decay * gait.forward + ankle[0], ankle[1]
    # The foot that lands has its inner side where the other one is.
    low, high = (inner, outer) if foot == "left" else (outer, inner)
    return (
        np.minimum(-CATCH * np.array((back, low)) - offset, -CARRY * half),
        np.maximum(CATCH * np.array((ahead, high)) - offset, CARRY * half),
    )
