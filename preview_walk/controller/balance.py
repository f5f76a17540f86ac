"""Balance: how the CoM is led back, what pushes the robot, and by which other plan it walks on."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from preview_walk.controller.feet import Feet
from preview_walk.controller.hardware import Hardware, dcm_rate
from preview_walk.footsteps.plan import FootstepPlan
from preview_walk.geometry.support import Sole
from preview_walk.pattern.walking_pattern import ComReference, WalkingPattern
from preview_walk.robots.robot import Robot
from preview_walk.stabilizer.com_feedback import (
    CentroidalState,
    ComFeedback,
    FeedbackGains,
    Support,
    com_feedback,
)
from preview_walk.stabilizer.disturbance import Disturbance, leaning, observe, steady
from preview_walk.stabilizer.recovery import RecoveryMemory, early_landing, recover
from preview_walk.stabilizer.situation import Situation
from preview_walk.stabilizer.step_limits import step_limits
from preview_walk.tracking.dynamics import Dynamics
from preview_walk.tracking.gains import TrackingGains
from preview_walk.types import Array, Foot

LEAN = 0.1
"""How far beyond the soles (m per m of leg) the feedback may ask for the ZMP: what the soles cannot
give, trunk and arms do by their angular momentum."""


class Balance:
    """Opposes errors and pushes, and remembers what it needs to go on.

    Attributes:
        disturbance: what pushes the DCM, as observed.
        slow: (2,) what of it is there for good, world, m/s.
    """

    def __init__(
        self,
        robot: Robot,
        omega: float,
        gains: TrackingGains,
        lag: float,
        hardware: Hardware | None = None,
    ) -> None:
        """Begin with a robot that nothing pushes.

        Args:
            robot: whose it is.
            omega: natural frequency of the pendulum, 1/s.
            gains: of the feedback.
            lag: time constant of the disturbance's estimate, s.
            hardware: of the robot, if it is not perfect: then a disturbance that stays is leant
                against, and the feedback is as fast as delay and noise allow.
        """
        lean, sole = LEAN * robot.leg_length, robot.sole
        self._sole = sole
        self._width = sole.half_width if hardware is None else hardware.pressed_width(robot)
        self._reach = Sole(sole.half_length + lean, sole.half_width + lean)
        self._rates = FeedbackGains(omega, gains.dcm, gains.height)
        self._lag, self._hardware = lag, hardware
        self._limits = step_limits(robot.leg_length, robot.step_width, sole, omega)
        self.forget()

    def tune(self, gains: TrackingGains) -> None:
        """Feed back by other gains from now on."""
        self._rates = FeedbackGains(self._rates.omega, gains.dcm, gains.height)

    def forget(self) -> None:
        """Know nothing of what was before."""
        self.disturbance, self._felt, self.slow = Disturbance(), Disturbance(), np.zeros(2)
        self._memory = RecoveryMemory()

    @property
    def lean(self) -> Array:
        """(2,) by which the CoM stays behind its reference, into what pushes for good, world, m."""
        value: Array = self.slow / self._rates.omega
        return value

    def feedback(
        self,
        state: CentroidalState,
        reference: ComReference,
        standing: Sequence[Array],
        spread: float = 0.0,
    ) -> ComFeedback:
        """Return what leads the CoM back to its reference.

        Args:
            state: the measured motion of the CoM.
            reference: of the CoM now.
            standing: measured poses (4, 4) of the soles in contact, world, m.
            spread: standard deviation of the measured velocity, m/s.
        """
        support, rates = Support(standing, self._sole, self._reach), self._rates
        if self._hardware is not None:
            reference = leaning(reference, self.lean)
            delay, width = self._hardware.delay, self._width
            rates = replace(rates, dcm=dcm_rate(rates.dcm, rates.omega, delay, spread, width))
        return com_feedback(state, reference, self.disturbance.rate, support, rates)

    def observe(self, t: float, dynamics: Dynamics, zmp: Array, felt: Array | None = None) -> None:
        """Observe what pushes the robot.

        Args:
            t: now, s.
            dynamics: at the measured state.
            zmp: (2,) the point that drove the DCM since the last time, world, m.
            felt: (2,) the ZMP that the soles feel; what stays is told from it, for a motor that is
                not exact pushes nobody. None where it is not wanted or nothing is felt.
        """
        omega = self._rates.omega
        dcm = CentroidalState(dynamics.com, dynamics.com_velocity).dcm(omega)
        self.disturbance = observe(self.disturbance, t, dcm, zmp, omega, lag=self._lag)
        if self._hardware is not None and felt is not None:
            last = self._felt
            self._felt = observe(last, t, dcm, felt, omega, lag=self._lag)
            if last.time is not None:
                self.slow = steady(self.slow, self._felt.rate, t - last.time, omega)

    def answer(
        self, t: float, pattern: WalkingPattern, feet: Feet, dynamics: Dynamics
    ) -> FootstepPlan | None:
        """Return the plan by which the robot keeps its balance; None if it does by this one.

        Args:
            t: now, s, as `observe` was told.
            pattern: of the walk.
            feet: as they are.
            dynamics: at the measured state.
        """
        pushed, swing = self.disturbance, free_swing(t, pattern.plan, feet, dynamics)
        # What is there for good is leant against: recovery sees the walk as if it were not there.
        dcm, rate = pushed.dcm + self.lean, pushed.rate - self.slow
        situation = Situation(t, pattern.plan, dcm, rate, pattern.planned_dcm, swing)
        decision = recover(situation, self._memory, self._limits)
        self._memory = decision.memory
        return decision.plan

    def landed(self, t: float, plan: FootstepPlan, foot: Foot, pose: Array) -> FootstepPlan | None:
        """Return the plan in which a foot that touches the ground early has landed there.

        None where the plan holds; arguments as of `early_landing`.
        """
        return early_landing(plan, t, foot, pose, self._memory)


def free_swing(
    t: float, plan: FootstepPlan, feet: Feet, dynamics: Dynamics
) -> tuple[Array, Array] | None:
    """Return position and velocity (3,), world, of the sole that swings freely, or None."""
    step = plan.swing_at(t)
    if step is None or feet.states[step.foot].contact:
        return None
    sole = dynamics.soles[step.foot]
    return sole.position, sole.rotation @ sole.velocity[:3]
