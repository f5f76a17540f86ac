"""Recovery steps: plans with a step elsewhere, sooner or later, again, or out of a stand.

Each returns a new plan in which the later steps keep their places relative to the changed one.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from math import exp

import numpy as np

from preview_walk.footsteps.footstep import Footstep
from preview_walk.footsteps.limits import GaitLimits
from preview_walk.footsteps.plan import FootstepPlan
from preview_walk.geometry.poses import Heading, compose, heading_of, midfeet, pose_at
from preview_walk.geometry.support import Sole, support_margin, support_polygon
from preview_walk.stabilizer.step_limits import StepLimits
from preview_walk.types import FEET, Array, Foot, other

SHORT_PAUSE = 0.035
"""Double support (s) after a changed step: the next one cannot wait."""

UNLOAD = 0.03
"""Time (s) in which a foot that stands is freed of its load before it lifts."""


def land_at(plan: FootstepPlan, t: float, pose: Array, land: float) -> FootstepPlan:
    """Return the plan whose step in the air lands elsewhere, at another time.

    The double support after it is cut to `SHORT_PAUSE`, unless the walk stands there.

    Args:
        plan: the walk; some foot must be in the air at t.
        t: now, s.
        pose: (4, 4) of the sole where it lands, world, m.
        land: when, s.
    """
    step = plan.swing_at(t)
    assert step is not None
    index = plan.steps.index(step)
    later = plan.steps[index + 1 :]
    delay = land - step.land
    if later and not plan.is_stand(later[0].lift - step.land):
        delay -= max(0.0, later[0].lift - step.land - SHORT_PAUSE)
    move = pose[:3, 3] - step.pose[:3, 3]
    # Without the later steps, which would be made anew twice.
    landed = plan.replace_after(t, ()).retarget(t, pose, land)
    return landed.replace_after(t, _moved(later, move, delay))


def step_sooner(plan: FootstepPlan, t: float) -> FootstepPlan | None:
    """Return the plan whose next foot lifts as soon as it can, or None where it does or stands."""
    step = plan.next_lift(t)
    if step is None:
        return None
    last = max((s.land for s in plan.lifted(t)), default=plan.start)
    soonest = max(t + UNLOAD, last + SHORT_PAUSE)
    if plan.is_stand(step.lift - last) or step.lift <= soonest + 0.01:
        return None
    later = plan.steps[plan.steps.index(step) :]
    return plan.replace_after(t, _moved(later, np.zeros(3), soonest - step.lift))


def keep_standing(plan: FootstepPlan, t: float, dcm: Array) -> FootstepPlan | None:
    """Return the plan whose next foot stays down while the DCM (2,) is beyond the other one.

    There a lifted foot could not catch it, but both feet together can hold it. None where the next
    lift is right; the same plan where that lift is late enough.

    Args:
        plan: the walk; both feet stand at t.
        t: now, s.
        dcm: (2,) measured DCM, world, m.
    """
    step = plan.next_lift(t)
    if step is None:
        return None
    if outward(plan, t, step.foot, dcm) <= 0.0:
        return None
    soonest = t + 2.0 * UNLOAD
    if not t + UNLOAD < step.lift < soonest:
        return plan
    later = plan.steps[plan.steps.index(step) :]
    return plan.replace_after(t, _moved(later, np.zeros(3), soonest - step.lift))


def step_out(plan: FootstepPlan, t: float, dcm: Array, limits: StepLimits) -> FootstepPlan | None:
    """Return the plan of a robot on two feet that must step, or None while its ankles suffice.

    The ZMP can hold the DCM while that is above the soles. Beyond, the foot steps that catches the
    DCM best (`_best_foot`), even where the plan has the other one next. One who stands puts the
    other foot beside it; the steps of a walk go on from there.

    Args:
        plan: the walk; both feet stand at t.
        t: now, s.
        dcm: (2,) measured DCM, world, m.
        limits: what a recovery step may be.
    """
    soles = {foot: plan.sole(foot, t) for foot in FEET}
    polygon = support_polygon(list(soles.values()), limits.held)
    if float(support_margin(polygon, dcm)) > 0.0:
        return None
    last = max((s.land for s in plan.lifted(t)), default=plan.start)
    following = plan.next_lift(t)
    if following is not None and following.lift <= t + UNLOAD:
        return None
    growth = exp(limits.omega * limits.step_out_time)
    foot, landing = _best_foot(soles, dcm, limits.held, limits.gait, growth)
    walking = following is not None and not plan.is_stand(following.lift - last)
    if walking and following is not None and foot == following.foot:
        return step_sooner(plan, t)
    z = float(soles[other(foot)][2, 3])
    land = t + UNLOAD + limits.step_out_time
    first = Footstep(foot, pose_at(*landing, z), t + UNLOAD, land, again=True)
    later = () if following is None else plan.steps[plan.steps.index(following) :]
    if walking:
        move = first.pose[:3, 3] - soles[foot][:3, 3]
        delay = land + SHORT_PAUSE - later[0].lift
        return plan.replace_after(t, [first, *_moved(later, move, delay)])
    return plan.replace_after(t, [first, *_closing(plan, soles, first, later, limits)])


def _closing(
    plan: FootstepPlan,
    soles: Mapping[Foot, Array],
    first: Footstep,
    later: tuple[Footstep, ...],
    limits: StepLimits,
) -> list[Footstep]:
    """Return the step that brings the other foot beside `first`, and those of the plan after it.

    `soles`: where the feet stood before `first`; `later`: the plan's steps after the stand.
    """
    foot, width = first.foot, limits.gait.step_width
    landing = heading_of(first.pose)
    beside = compose(landing, 0.0, width if foot == "right" else -width)
    lift = first.land + SHORT_PAUSE
    z = float(first.pose[2, 3])
    second = Footstep(other(foot), pose_at(*beside, z), lift, lift + limits.step_out_time)
    middle = midfeet(soles["left"], soles["right"])
    move = np.zeros(3)
    move[:2] = 0.5 * (np.array(landing[:2]) + beside[:2]) - middle[:2]
    delay = 0.0
    if later:
        delay = max(0.0, second.land + 3.0 * plan.weight_shift - later[0].lift)
    return [second, *_moved(later, move, delay)]


def outward(plan: FootstepPlan, t: float, foot: Foot, dcm: Array) -> float:
    """Return how far (m) the DCM is beyond the sole that stands while `foot` steps.

    Args:
        plan: the walk.
        t: now, s.
        foot: the one that steps.
        dcm: (2,) DCM, world, m.
    """
    stance = plan.sole(other(foot), t)
    side = 1.0 if foot == "left" else -1.0
    return -side * float((dcm - stance[:2, 3]) @ stance[:2, 1])


def _best_foot(
    soles: dict[Foot, Array], dcm: Array, sole: Sole, gait: GaitLimits, growth: float
) -> tuple[Foot, Heading]:
    """Return the foot whose step catches the DCM best, and where it lands.

    Legs do not cross: where the DCM runs off over the standing foot, the other one lands beside
    that and the standing foot must catch the DCM in a second step, by when it has grown twice.

    Args:
        soles: the soles, (4, 4) each.
        dcm: (2,) DCM in the world (m).
        sole: half sizes within which the ZMP can be held.
        gait: reach of a step.
        growth: of the DCM's distance from the ZMP during one step.
    """
    half = np.array((sole.half_length, sole.half_width))
    choices: list[tuple[float, Foot, Heading]] = []
    for foot in FEET:
        stance = soles[other(foot)]
        axes = stance[:2, :2]
        heading = heading_of(stance)
        here = (dcm - stance[:2, 3]) @ axes
        end = _grown(here, half, growth)
        landing = gait.clamp(foot, heading, compose(heading, float(end[0]), float(end[1])))
        rest = end - (np.array(landing[:2]) - stance[:2, 3]) @ axes
        side = 1.0 if foot == "left" else -1.0
        stretch, steps = end - (0.0, side * gait.step_width), 1.0
        if side * end[1] >= -half[1]:
            rest[1] = side * max(0.0, side * float(rest[1]))  # between the feet both hold it
        else:
            rest = _grown(rest, half, growth)
            stretch, steps = rest + np.array((0.0, side * gait.step_width)), 2.0
            rest[1] = max(0.0, -side * float(rest[1]) - gait.max_width)
        miss = float(np.maximum(np.abs(rest) - half, 0.0).max())
        choices.append((100.0 * miss + steps + float(np.hypot(*stretch)), foot, landing))
    _, foot, landing = min(choices, key=lambda choice: choice[0])
    return foot, landing


def _grown(dcm: Array, half: Array, growth: float) -> Array:
    """Return where the DCM (2,) from the stance sole's centre ends up, held at the sole's edge."""
    held = np.clip(dcm, -half, half)
    value: Array = (dcm - held) * growth + held
    return value


def _moved(steps: tuple[Footstep, ...], move: Array, delay: float) -> list[Footstep]:
    """Return the steps moved by `move` (3,) in m and `delay` in s."""
    shift = np.eye(4)
    shift[:3, 3] = move
    return [
        replace(s, pose=shift @ s.pose, lift=s.lift + delay, land=s.land + delay) for s in steps
    ]
