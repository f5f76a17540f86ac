"""Push recovery: whether the plan stays, and by which other it is replaced where not.

`recover` looks at one situation and returns a decision; the walker that asked applies it.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import exp, inf

import numpy as np

from preview_walk.errors import InvalidInput
from preview_walk.footsteps.footstep import Footstep
from preview_walk.footsteps.plan import FootstepPlan
from preview_walk.geometry.support import support_margin, support_polygon
from preview_walk.stabilizer.recovery_steps import (
    keep_standing,
    land_at,
    outward,
    step_out,
    step_sooner,
)
from preview_walk.stabilizer.situation import Situation
from preview_walk.stabilizer.step_adaptation import LATEST, RELIFT, adapt_step
from preview_walk.stabilizer.step_limits import StepLimits
from preview_walk.types import FEET, Array, Foot

EARLY = 0.05
"""A foot that touches down earlier than planned by more than this (s) has landed where it is."""

CALM = 1.0
"""So long (s) after the last change of the plan a touchdown ahead of time is part of a recovery."""

AHEAD = 0.05
"""Time (s) for which a push is taken to last in the double support of a walk: a step comes later
by the time it takes to unload the foot. Who stands goes on standing while the DCM is above the
soles: the swing of a leg would push it further."""

OUTWARD = 0.3
"""Share of the tolerance by which the DCM's error may be outward of the foot that stands next for
the other one still to hurry: lifted, it could not catch it."""

_ROUNDING = 1e-6


@dataclass(frozen=True, eq=False)
class RecoveryMemory:
    """What recovery remembers from one decision to the next; the first one knows nothing.

    Attributes:
        nominal: the step in the air as it was commanded, before recovery changed it.
        risen: a foot that rises again is not down before this time, s.
        changed: when recovery last changed the plan, s.
    """

    nominal: Footstep | None = None
    risen: float = -inf
    changed: float = -inf


@dataclass(frozen=True, eq=False)
class Decision:
    """What recovery decides: another plan, or None to walk on; and what it remembers."""

    plan: FootstepPlan | None
    memory: RecoveryMemory


def recover(situation: Situation, memory: RecoveryMemory, limits: StepLimits) -> Decision:
    """Return whether the plan stays in this situation.

    With a foot in the air its landing is adapted (`adapt_step`); with both down the robot steps out
    of a stand, lifts the next foot sooner, or keeps it down. Steps that no plan may have are no
    answer: the walk goes on as it was.

    Args:
        situation: the walker now.
        memory: what the decision before this one remembered.
        limits: what a recovery step may be.
    """
    step = situation.plan.swing_at(situation.t)
    try:
        if step is not None and situation.swing is not None:
            decision = _swinging(situation, step, memory, limits)
        else:
            decision = Decision(_standing(situation, limits) if step is None else None, memory)
    except InvalidInput:
        return Decision(None, memory)
    if decision.plan is None:
        return decision
    return Decision(decision.plan, replace(decision.memory, changed=situation.t))


def early_landing(
    plan: FootstepPlan, t: float, foot: Foot, pose: Array, memory: RecoveryMemory
) -> FootstepPlan | None:
    """Return the plan in which a foot that touches the ground before its time has landed there.

    None where that is no part of a recovery, or so little early that the plan holds.

    Args:
        plan: the walk.
        t: now, s.
        foot: the one that touches.
        pose: (4, 4) measured pose of its sole, world, m.
        memory: of the last decision.
    """
    step = plan.swing_at(t)
    if step is None or step.foot != foot or t - memory.changed > CALM or step.land - t <= EARLY:
        return None
    try:
        return land_at(plan, t, pose, t + 1e-4)
    except InvalidInput:  # as in `recover`
        return None


def _swinging(
    situation: Situation, step: Footstep, memory: RecoveryMemory, limits: StepLimits
) -> Decision:
    """Return the decision with `step` in the air."""
    t = situation.t
    if memory.nominal is None or memory.nominal.lift != step.lift:
        memory = replace(memory, nominal=step, risen=-inf)
    nominal = memory.nominal
    assert nominal is not None
    shortest, longest = limits.swing_time
    in_time = replace(limits, swing_time=(max(shortest, memory.risen - step.lift), longest))
    plan = adapt_step(situation, nominal, in_time)
    if plan is not None and step.land - t < LATEST:
        land = next(s.land for s in plan.steps if s.lift == step.lift)
        if land - t > RELIFT - _ROUNDING:
            memory = replace(memory, risen=land)
    return Decision(plan, memory)


def _standing(situation: Situation, limits: StepLimits) -> FootstepPlan | None:
    """Return the answer with both feet down, None to go on."""
    plan, t, dcm = situation.plan, situation.t, situation.dcm
    planned = situation.planned_dcm(t)
    if np.abs(dcm - planned).max() <= limits.tolerance:
        return None
    step = plan.next_lift(t)
    # A push lasts: the step is for where the DCM will be, not for where it is.
    ahead = dcm if step is None else dcm + AHEAD * situation.disturbance
    if step is not None and _can_hold(situation, step, ahead, limits):
        return None
    out = step_out(plan, t, ahead, limits)
    if out is None:
        out = keep_standing(plan, t, ahead)
    if out is None and step is not None:
        drift = outward(plan, t, step.foot, ahead) - outward(plan, t, step.foot, planned)
        if drift <= OUTWARD * limits.tolerance:
            out = step_sooner(plan, t)
    return None if out is plan else out


def _can_hold(situation: Situation, step: Footstep, dcm: Array, limits: StepLimits) -> bool:
    """Return whether a ZMP above the soles brings the DCM (2,) to the plan's by the next lift."""
    plan, t = situation.plan, situation.t
    growth = exp(limits.omega * (step.lift - t))
    if growth < 1.0 + _ROUNDING:
        return False
    zmp = (dcm * growth - situation.planned_dcm(step.lift)) / (growth - 1.0)
    polygon = support_polygon([plan.sole(foot, t) for foot in FEET], limits.held)
    room = limits.tolerance / (growth - 1.0)
    return float(support_margin(polygon, zmp)) > -room
