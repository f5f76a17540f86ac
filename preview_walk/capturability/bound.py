"""The largest push a walking biped can survive, under the linear inverted pendulum.

A yardstick for push recovery: what a pendulum with the stated reach, width, timing and swing speed
(`PushGait`) allows. It is no bound on controllers: one whose own limits are wider can pass it, and
so can a body that uses its angular momentum, which is left out. Given a controller's own limits it
is that controller's bound. Within its limits it is optimistic: no delay, no friction, joint or
torque limit, feet that land where they are wanted.

The push is a constant force for D = 0.2 s, begun at a share of single support or while standing,
and the CoP is free to react from its first instant on. Seen from there it moves the DCM as an
instant impulse J would, by J / (m omega), if

    F D = J * omega D / (1 - exp(-omega D)).

Survived means: the DCM comes to rest inside the support within six steps. `program` finds the
largest jump of the DCM for given times of the steps, `timing` searches the times. Double support
lasts as in the walk, or, where times are free, as `PushGait.short_double_support` says. Before the
push the gait is periodic: the CoP rests in the middle of the sole in single support and moves at
constant speed from sole to sole in double support, and the swing foot's way through the air
follows 3 s^2 - 2 s^3.

Frame of every vector: x forward, y towards the stance foot's side (the axes of the heading while
the left foot stands, their mirror image while the right foot does), origin at the stance sole's
centre, or midway between the soles of one who stands. Angles run from x to y.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, exp, pi, sin
from typing import Literal

import numpy as np

from preview_walk.arguments import finite_number, instance_of, number_from_zero, shown
from preview_walk.capturability.gait import PushGait
from preview_walk.capturability.timing import PushCase, TimedCapture, best_of
from preview_walk.errors import InvalidInput
from preview_walk.types import Array

__all__ = ["Answer", "Direction", "PushGait", "SurvivalPlan", "largest_impulse", "survival_plan"]

Answer = Literal["cop", "steps", "steps_and_timing"]
"""What may answer a push: the CoP alone, also the footholds, also the times of the steps."""

Direction = Literal["forward", "back", "outward", "inward"]
"""Outward is towards the stance foot's side, inward towards the swing foot's."""

PUSH_DURATION = 0.2
"""How long the force acts (s)."""

_ANSWERS = {
    "cop": PushCase.by_cop,
    "steps": PushCase.by_steps,
    "steps_and_timing": PushCase.by_steps_and_timing,
}
"""The searches by answer; each answer may use those before it too."""

_ANGLES = {"forward": 0.0, "outward": 0.5 * pi, "back": pi, "inward": -0.5 * pi}
"""Angles (rad) of the directions that have a name."""


@dataclass(frozen=True, eq=False)
class SurvivalPlan:
    """How the pendulum survives its largest push; n steps, times in s from the push on.

    Attributes:
        impulse: force times duration of the push, N·s.
        direction: (2,) unit vector of the push.
        dcm: (2,) DCM at the push, m.
        lifts: (n,) when each foot lifts; 0 for the one in the air at the push.
        lands: (n,) when it lands.
        soles: (n + 2, 2) sole centres, m: the foot that swings first, where it is at the push;
            the stance foot; then the footholds. Step k lands at soles[k + 2].
        cops: (2 n + 1, 2) the CoP, constant in each phase, m: until the first lift, which has no
            duration in a walk; then in turn single and double support. The last phase lasts.
    """

    impulse: float
    direction: Array
    dcm: Array
    lifts: Array
    lands: Array
    soles: Array
    cops: Array


def largest_impulse(
    gait: PushGait, share: float | None, direction: Direction | float, answer: Answer
) -> float:
    """Return the largest impulse (N·s) of a 0.2 s push that the pendulum survives.

    Args:
        gait: the robot and its walk.
        share: of single support that is over when the push begins, 0 to 1; None: standing.
        direction: of the push: a name, or an angle (rad) from straight ahead towards the stance
            foot's side. Standing, both sides are the same.
        answer: what the biped may do about it. More freedom never gives less.

    Raises:
        InvalidInput: a share outside 0..1, a direction that is no name and no finite angle, an
            unknown answer, or a gait that cannot be kept up.
    """
    return survival_plan(gait, share, direction, answer).impulse


def survival_plan(
    gait: PushGait, share: float | None, direction: Direction | float, answer: Answer
) -> SurvivalPlan:
    """Return how the pendulum survives the largest push.

    Arguments and errors as of `largest_impulse`.
    """
    instance_of(gait, PushGait, "gait")
    _check_share(share)
    if not (isinstance(answer, str) and answer in _ANSWERS):
        known = ", ".join(_ANSWERS)
        raise InvalidInput(
            f"answer must be one of {known}, got {shown(answer)}.", argument="answer"
        )
    angle = _angle(direction)
    ways = list(_ANSWERS.values())[: list(_ANSWERS).index(answer) + 1]
    plans = []
    # Who stands may lift either foot first: the mirrored push, answered, and mirrored back.
    for mirror in (1.0,) if share is not None else (1.0, -1.0):
        case = PushCase(gait, share, np.array([cos(angle), mirror * sin(angle)]))
        best = best_of(way(case) for way in ways)
        if best is not None:
            plans.append(_plan(case, best, mirror))
    if not plans:
        raise InvalidInput(
            f"this gait cannot be kept up even without a push: {gait}.", argument="gait"
        )
    return max(plans, key=lambda plan: plan.impulse)


def _check_share(share: float | None) -> None:
    """Refuse what is no share of single support."""
    try:
        good = share is None or number_from_zero(share, "share", "") <= 1.0
    except InvalidInput:
        good = False
    if not good:
        raise InvalidInput(
            "share must be between 0 and 1 of single support, or None for standing, "
            f"got {shown(share)}.",
            argument="share",
        )


def _angle(direction: Direction | float) -> float:
    """Return the angle of a direction (rad)."""
    if isinstance(direction, str) and direction in _ANGLES:
        return _ANGLES[direction]
    try:
        return finite_number(direction, "direction", "rad")
    except InvalidInput:
        raise InvalidInput(
            f"direction must be one of {', '.join(_ANGLES)} or a finite angle in rad, "
            f"got {shown(direction)}.",
            argument="direction",
        ) from None


def _plan(case: PushCase, best: TimedCapture, mirror: float) -> SurvivalPlan:
    """Return the plan that a capture stands for, in the frame of the module."""
    gait, share, capture = case.gait, case.share, best.capture
    count, swings = len(best.singles), np.array(best.singles)
    first_lift = best.delay if count else 0.0
    lands = first_lift + np.cumsum(swings) + best.pause * np.arange(count)
    strides = capture.strides[len(capture.strides) - count :]
    soles = np.vstack([gait.swing_foot(share), np.zeros(2), np.cumsum(strides, axis=0)])
    # Where the CoP of each double support is between the soles: 0 at the one behind, 1 at the
    # other. The last one is endless; where there is no double support there is no choice.
    least = np.full(count, exp(-gait.omega * best.pause))
    least[-1:] = 0.0
    shares = capture.shares[len(capture.shares) - count :]
    along = np.divide(shares - least, 1.0 - least, out=np.ones(count), where=least < 1.0)
    keep_standing = float(capture.shares[0]) if share is None else 0.0
    cops = [soles[1] + keep_standing * (soles[0] - soles[1])]
    for k in range(count):
        cops += [soles[k + 1], soles[k + 1] + along[k] * strides[k]]
    origin = np.array([0.0, 0.5 * soles[0, 1]]) if share is None else np.zeros(2)
    flip = np.array([1.0, mirror])
    return SurvivalPlan(
        impulse=gait.impulse(capture.jump, PUSH_DURATION),
        direction=flip * case.direction,
        dcm=flip * (gait.dcm(share) - origin),
        lifts=lands - swings,
        lands=lands,
        soles=flip * (soles - origin),
        cops=flip * (np.array(cops) + capture.point - origin),
    )
