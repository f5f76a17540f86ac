"""Push recovery: changes the plan where the measured DCM can no longer follow it."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import replace
from math import exp

import numpy as np

from preview_walk.controller.feet import Feet
from preview_walk.errors import InvalidInput
from preview_walk.footsteps.footstep import Footstep
from preview_walk.footsteps.limits import GaitLimits
from preview_walk.footsteps.plan import FootstepPlan
from preview_walk.geometry.support import Sole, support_margin, support_polygon
from preview_walk.pattern.walking_pattern import PLANNING_DT, WalkingPattern
from preview_walk.robots.robot import Robot
from preview_walk.stabilizer.recovery_steps import (
    keep_standing,
    land_at,
    outward,
    step_out,
    step_sooner,
)
from preview_walk.stabilizer.step_adaptation import (
    LATEST,
    RELIFT,
    TOLERANCE,
    StepLimits,
    adapt_step,
)
from preview_walk.tracking.dynamics import Dynamics
from preview_walk.types import FEET, Array, Foot

SWING_ACCELERATION = 25.0
"""Acceleration (m/s^2) that a recovery step may ask of the swing foot."""

EARLY = 0.05
"""A foot that touches down earlier than planned by more than this (s) has landed where it is."""

CALM = 1.0
"""So long (s) after the last change of the plan a touchdown ahead of time is part of a recovery."""

AHEAD = 0.05
"""Time (s) for which a push is taken to last in the double support of a walk: a step comes later
by the time it takes to unload the foot. Who stands goes on standing while the DCM is above the
soles: the swing of a leg would push it further."""

SMOOTH = 0.006
"""Time constant (s) of the push's estimate, which every touch of a foot disturbs."""

HOLD = 0.95
"""Share of the sole within which the ZMP can be held."""

FORWARD, BACKWARD, ASIDE = 0.7, 0.5, 0.65
"""Reach of a recovery step over the leg's length; aside, beyond the feet's normal distance."""

OUTWARD = 0.3
"""Share of the tolerance by which the DCM's error may be outward of the foot that stands next for
the other one still to hurry: lifted, it could not catch it."""


class Recovery:
    """Decides at every planning tick whether the plan stays; `answer` changes it where not.

    `push` (2,) m/s: how fast the DCM runs besides what the ZMP drives, smoothed over `SMOOTH`.
    """

    def __init__(self, robot: Robot, omega: float) -> None:
        half, leg = robot.soles["left"], robot.leg_length
        sole = Sole(half.half_length, half.half_width)
        gait = GaitLimits.for_leg(leg, robot.step_width, sole)
        pendulum = float(np.sqrt(leg / 9.81))
        self.limits = StepLimits(
            replace(
                gait,
                forward=FORWARD * leg,
                backward=BACKWARD * leg,
                max_width=robot.step_width + ASIDE * leg,
            ),
            omega,
            (HOLD * half.half_length, HOLD * half.half_width),
            (1.1 * pendulum, 3.5 * pendulum),
            4.0 * float(np.sqrt(leg)),
            SWING_ACCELERATION,
            TOLERANCE * leg,
        )
        self._stand_sole = Sole(*self.limits.zmp)
        self._swing_time = 1.2 * pendulum
        self._due = -np.inf
        self._nominal: Footstep | None = None
        self._changed = -np.inf
        self._risen = -np.inf
        self._dcm: tuple[float, Array] | None = None
        self.push: Array = np.zeros(2)

    def answer(
        self,
        t: float,
        pattern: WalkingPattern,
        dynamics: Dynamics,
        feet: Feet,
        zmp: Array,
    ) -> None:
        """Replace the pattern's plan where the state measured at t (s) asks for another.

        `zmp`: (2,) m, the point that drives the DCM, xi' = omega (xi - zmp), as last asked of the
        soles; what else the DCM does is the push.
        """
        if t < self._due:
            return
        self._due = t + PLANNING_DT - 1e-9
        dcm = (dynamics.com + dynamics.com_velocity / pattern.omega)[:2]
        if self._dcm is not None:
            drift = pattern.omega * (0.5 * (dcm + self._dcm[1]) - zmp)
            now = (dcm - self._dcm[1]) / (t - self._dcm[0]) - drift
            self.push = self.push + (now - self.push) / (1.0 + SMOOTH / PLANNING_DT)
        self._dcm = t, dcm
        plan = self._revised(t, pattern, dcm, dynamics, feet)
        if plan is not None:
            self._changed = t
            pattern.plan = plan
            pattern.rejoin(t, dynamics.com[:2])

    def _revised(
        self,
        t: float,
        pattern: WalkingPattern,
        dcm: Array,
        dynamics: Dynamics,
        feet: Feet,
    ) -> FootstepPlan | None:
        step = pattern.plan.swing_at(t)
        try:
            if step is None:
                return self._standing(t, pattern, dcm)
            if feet[step.foot].contact:
                return None
            return self._swinging(t, pattern, dcm, step, dynamics)
        except InvalidInput:
            return None  # steps that no plan may have are no answer: the walk goes on as it was

    def touched_down(self, t: float, foot: Foot, pattern: WalkingPattern, pose: Array) -> None:
        """Take a foot that touches the ground at `pose` (4, 4) before its time as landed there."""
        step = pattern.plan.swing_at(t)
        if step is None or step.foot != foot or t - self._changed > CALM:
            return
        if step.land - t > EARLY:
            with suppress(InvalidInput):  # as in `_revised`
                pattern.plan = land_at(pattern.plan, t, pose, t + 1e-4)

    def _swinging(
        self, t: float, pattern: WalkingPattern, dcm: Array, step: Footstep, dynamics: Dynamics
    ) -> FootstepPlan | None:
        if self._nominal is None or self._nominal.lift != step.lift:
            self._nominal, self._risen = step, -np.inf
        following = pattern.plan.next_lift(step.land)
        weight_shift = pattern.plan.weight_shift
        pause = weight_shift if following is None else min(weight_shift, following.lift - step.land)
        sole = dynamics.soles[step.foot]
        shortest, longest = self.limits.swing_time
        limits = replace(self.limits, swing_time=(max(shortest, self._risen - step.lift), longest))
        plan = adapt_step(
            pattern.plan,
            t,
            dcm,
            (pattern.planned_dcm(t), pattern.planned_dcm(step.land + 0.5 * pause)),
            (sole.position, sole.rotation @ sole.velocity[:3]),
            self._nominal,
            limits,
        )
        if plan is not None and step.land - t < LATEST:
            land = next(s.land for s in plan.steps if s.lift == step.lift)
            if land - t > RELIFT - 1e-6:  # it rises again: no sooner than that is it down
                self._risen = land
        return plan

    def _standing(self, t: float, pattern: WalkingPattern, dcm: Array) -> FootstepPlan | None:
        plan, limits, planned = pattern.plan, self.limits, pattern.planned_dcm(t)
        if np.abs(dcm - planned).max() <= limits.tolerance:
            return None
        step, ahead = plan.next_lift(t), dcm
        sole, time = self._stand_sole, self._swing_time
        if step is not None:
            # A push lasts: the step is for where the DCM will be, not for where it is.
            ahead = dcm + AHEAD * self.push
        if step is not None and self._held(t, plan, ahead, pattern.planned_dcm(step.lift), step):
            return None
        out = step_out(plan, t, ahead, sole, limits.gait, limits.omega, time)
        if out is None:
            out = keep_standing(plan, t, ahead)
        if out is None and step is not None:
            drift = outward(plan, t, step.foot, ahead) - outward(plan, t, step.foot, planned)
            if drift <= OUTWARD * limits.tolerance:
                out = step_sooner(plan, t)
        return None if out is plan else out

    def _held(self, t: float, plan: FootstepPlan, dcm: Array, goal: Array, step: Footstep) -> bool:
        """Return whether a ZMP above the soles brings the DCM (2,) to `goal` (2,) by the lift."""
        growth = exp(self.limits.omega * (step.lift - t))
        if growth < 1.0 + 1e-6:
            return False
        zmp = (dcm * growth - goal) / (growth - 1.0)
        polygon = support_polygon([plan.sole(foot, t) for foot in FEET], self._stand_sole)
        room = self.limits.tolerance / (growth - 1.0)
        return float(support_margin(polygon, zmp)) > -room
