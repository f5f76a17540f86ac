"""Whether a plan may take over from the one that is walked: a decision, nothing is changed.

Feet stand and swing where they are, whatever a new plan says. So it must have them there, its step
in the air must be the one in the air, and the steps to come must be in reach.
"""

from __future__ import annotations

from collections.abc import Mapping
from math import hypot

import numpy as np

from preview_walk.arguments import angle, finite_number, instance_of, shown
from preview_walk.errors import InvalidInput
from preview_walk.footsteps.findings import step_findings
from preview_walk.footsteps.footstep import Footstep
from preview_walk.footsteps.limits import GaitLimits
from preview_walk.footsteps.plan import FootstepPlan
from preview_walk.footsteps.reading import PlanLike, as_plan
from preview_walk.geometry.poses import as_pose, heading_of, relative
from preview_walk.types import FEET, Array, Foot

TURNED = 0.2
"""A sole may stand turned by this much (rad) from where the plan has it: two soles may be turned
towards each other by as much (`GaitLimits.turn_in`), so the next foothold still clears it."""

SAME_TIME = 1e-6
"""Times (s) nearer than this are one time."""


def refusal(
    plan: PlanLike,
    current: FootstepPlan,
    t: float,
    limits: GaitLimits,
    soles: Mapping[Foot, Array],
) -> InvalidInput | None:
    """Return why a plan may not replace the one that is walked, or None where it may.

    A standing sole must be so near to where the plan has it that the plan's sole centre is on the
    sole: there the ZMP rests while the other foot swings, and beyond the edge the robot tips. The
    plan may have it up to a stair (`limits.rise`) higher or lower, because the ground may be so.
    Steps that `current` makes alike are not judged again: refusing them would not unmake them.

    Args:
        plan: the plan to come; whatever `as_plan` takes. Its past may be gone (`since`).
        current: the plan that is walked.
        t: now, s.
        limits: bounds of a step, and the sole sizes.
        soles: measured pose (4, 4) of each sole.

    Returns:
        The error to raise, one sentence. Its `argument` is "plan" where the plan does not fit to
        the feet, and that of a planner (`StepProblem`) where a step is out of reach.

    Raises:
        InvalidInput: another argument than the plan is not what is described here.
    """
    t, limits = finite_number(t, "t", "s"), instance_of(limits, GaitLimits, "limits")
    instance_of(current, FootstepPlan, "current")
    if not isinstance(soles, Mapping):
        raise InvalidInput(
            f"soles must hold a pose per foot, got {shown(soles)}.", argument="soles"
        )
    try:
        plan = as_plan(plan)
    except InvalidInput as error:
        return error
    name = "the plan" if plan.end >= t else f"the plan, which was over at {plan.end:.3f} s,"
    for foot in FEET:
        real, planned = _flight(current, foot, t), _flight(plan, foot, t)
        measured = as_pose(soles.get(foot), "soles")
        if planned is not None:
            problem = _of_flight(planned, real)
        elif real is not None:
            problem = (
                f"has the {{}} foot on the ground, but it is in the air since {real.lift:.3f} s"
            )
        else:
            problem = _of_sole(plan.sole(foot, t), measured, limits)
        if problem is not None:
            sentence = f"at {t:.3f} s {name} {problem.format(foot)}."
            return InvalidInput(sentence, argument="plan")
    for finding in step_findings(plan, limits, t):
        if not _kept(plan, finding.time, current):
            return InvalidInput(f"the plan cannot be walked: {finding}.", argument=finding.argument)
    return None


def _flight(plan: FootstepPlan, foot: Foot, t: float) -> Footstep | None:
    """Return the step in the air at t (s) if it is of this foot."""
    step = plan.swing_at(t)
    return step if step is not None and step.foot == foot else None


def _of_flight(planned: Footstep, real: Footstep | None) -> str | None:
    """Return what is wrong with a step that a plan has in the air now, given what really is."""
    if real is None:
        return f"has the {{}} foot in the air since {planned.lift:.3f} s, but it stands"
    if abs(planned.lift - real.lift) <= SAME_TIME:
        return None
    return f"has lifted the {{}} foot at {planned.lift:.3f} s, but it lifted at {real.lift:.3f} s"


def _of_sole(planned: Array, measured: Array, limits: GaitLimits) -> str | None:
    """Return what a plan has wrong of a standing sole, given both poses (4, 4)."""
    x, y, turn = relative(heading_of(measured), heading_of(planned))
    sole, rise = limits.sole, abs(float(planned[2, 3] - measured[2, 3]))
    if abs(turn) > TURNED:
        allowed = f"at most {angle(TURNED)} is allowed"
        return f"has the {{}} sole turned by {angle(abs(turn))} from how it stands, {allowed}"
    if abs(x) > sole.half_length or abs(y) > sole.half_width:
        return (
            f"has the {{}} sole {hypot(x, y):.3f} m from where it stands, at most half a sole "
            f"({sole.half_length:.3f} m along, {sole.half_width:.3f} m across) is allowed"
        )
    if rise > limits.rise:
        allowed = f"at most {limits.rise:.3f} m is allowed"
        return f"has the {{}} sole {rise:.3f} m higher or lower than it stands, {allowed}"
    return None


def _kept(plan: FootstepPlan, land: float, current: FootstepPlan) -> bool:
    """Return whether `current` has the step that lands at `land` (s) too, from the same soles."""
    step = next(step for step in plan.steps if step.land == land)
    twin = current.swing_at(step.lift)
    if twin is None or (twin.foot, twin.lift, twin.land) != (step.foot, step.lift, step.land):
        return False
    pairs = [(plan.sole(foot, step.lift), current.sole(foot, step.lift)) for foot in FEET]
    return all(a is b or np.array_equal(a, b) for a, b in [*pairs, (step.pose, twin.pose)])
