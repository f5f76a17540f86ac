"""Plans for a pushed walker: a step that lands elsewhere, a step taken sooner, a step out of a stand.

Each returns a new plan in which the later steps keep their places relative to the changed one.
"""

from __future__ import annotations

from math import exp

import numpy as np

from preview_walk.planning.footsteps import Footstep, FootstepPlan
from preview_walk.planning.limits import GaitLimits
from preview_walk.planning.pose import compose, heading_of, midfeet, pose_at
from preview_walk.planning.support import Sole, support_margin, support_polygon
from preview_walk.types import Array, Foot, other

SHORT_PAUSE = 0.035
"""Double support (s) after a changed step: the next one cannot wait."""

UNLOAD = 0.03
"""Time (s) in which a foot that stands is freed of its load before it lifts."""


def landed_at(plan: FootstepPlan, t: float, pose: Array, land: float) -> FootstepPlan:
    """Return the plan whose step in the air at t (s) lands at `pose` (4, 4) at `land` (s).

    The double support after it is cut to `SHORT_PAUSE`, unless the walk stands there.
    """
    step = plan.swing_at(t)
    assert step is not None
    index = plan.steps.index(step)
    later = plan.steps[index + 1 :]
    delay = land - step.land
    if later and not plan.is_stand(later[0].lift - step.land):
        delay -= max(0.0, later[0].lift - step.land - SHORT_PAUSE)
    move = pose[:3, 3] - step.pose[:3, 3]
    return plan.retarget(t, pose, land).replace_after(t, _moved(later, move, delay))


def hastened(plan: FootstepPlan, t: float) -> FootstepPlan | None:
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


def stepped_out(
    plan: FootstepPlan,
    t: float,
    dcm: Array,
    sole: Sole,
    gait: GaitLimits,
    omega: float,
    swing_time: float,
) -> FootstepPlan | None:
    """Return the plan of a robot that stands and must step, or None while its ankles suffice.

    The ZMP can hold the DCM while that is above the soles. Beyond, the foot that carries less goes
    where the DCM will be, and the other follows beside it.

    Args:
        plan: the walk; both feet stand at t (s).
        dcm: (2,) measured DCM in the world (m).
        sole: half sizes within which the ZMP can be held.
        gait: reach and clearance of a step.
        omega: natural frequency of the pendulum (1/s).
        swing_time: time in the air of each step (s).
    """
    soles = {foot: plan.sole(foot, t) for foot in ("left", "right")}
    polygon = support_polygon(list(soles.values()), sole)
    if float(support_margin(polygon, dcm)) > 0.0:
        return None
    following = plan.next_lift(t)
    if following is not None and following.lift < t + 2.0 * UNLOAD + swing_time:
        return None
    middle = midfeet(soles["left"], soles["right"])
    aside = float((dcm - middle[:2]) @ (-np.sin(middle[2]), np.cos(middle[2])))
    foot: Foot = "right" if aside >= 0.0 else "left"
    stance = soles[other(foot)]
    axes, origin = stance[:2, :2], stance[:2, 3]
    lift = t + UNLOAD
    land = lift + swing_time
    start = (dcm - origin) @ axes
    held = np.clip(start, (-sole.half_length, -sole.half_width), (sole.half_length, sole.half_width))
    x, y = ((start - held) * exp(omega * (land - t)) + held).tolist()
    heading = heading_of(stance)
    landing = gait.clamp(foot, heading, compose(heading, x, y))
    z = float(stance[2, 3])
    first = Footstep(foot, pose_at(*landing, z), lift, land)
    aside = gait.step_width if foot == "right" else -gait.step_width
    beside = compose(landing, 0.0, aside)
    second = Footstep(
        other(foot), pose_at(*beside, z), land + SHORT_PAUSE, land + SHORT_PAUSE + swing_time
    )
    later = () if following is None else plan.steps[plan.steps.index(following) :]
    move = np.zeros(3)
    move[:2] = 0.5 * (np.array(landing[:2]) + beside[:2]) - middle[:2]
    delay = 0.0
    if later:
        delay = max(0.0, second.land + 3.0 * plan.settle - later[0].lift)
    return plan.replace_after(t, [first, second, *_moved(later, move, delay)])


def _moved(steps: tuple[Footstep, ...], move: Array, delay: float) -> list[Footstep]:
    """Return the steps moved by `move` (3,) in m and `delay` in s."""
    shift = np.eye(4)
    shift[:3, 3] = move
    return [
        Footstep(s.foot, shift @ s.pose, s.lift + delay, s.land + delay) for s in steps
    ]
