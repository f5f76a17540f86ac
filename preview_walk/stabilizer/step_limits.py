"""What a recovery step may be: reach, times and speeds, from the robot's size alone."""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import sqrt

from preview_walk.constants import GRAVITY
from preview_walk.footsteps.limits import GaitLimits
from preview_walk.geometry.support import Sole

SWING_ACCELERATION = 25.0
"""Acceleration (m/s^2) that a recovery step may ask of the swing foot."""

HOLD = 0.95
"""Share of the sole within which the ZMP can be held."""

FORWARD, BACKWARD, ASIDE = 0.7, 0.5, 0.65
"""Reach of a recovery step over the leg's length; aside, beyond the feet's normal distance."""

TOLERANCE = 0.03
"""Error of the DCM at landing (m per m of leg) that the next step takes up by itself."""


@dataclass(frozen=True)
class StepLimits:
    """What a recovery step may be.

    Attributes:
        gait: reach and clearance.
        omega: natural frequency of the pendulum, 1/s.
        zmp: largest shift of the ZMP from the sole centre, (forward, sideways), m.
        swing_time: shortest and longest time in the air, s.
        swing_speed: top speed of the swing foot, m/s.
        swing_acceleration: top acceleration of the swing foot, m/s^2.
        tolerance: error of the DCM at landing that needs no answer, m.
        step_out_time: time in the air of a step taken out of a stand, s.
    """

    gait: GaitLimits
    omega: float
    zmp: tuple[float, float]
    swing_time: tuple[float, float]
    swing_speed: float
    swing_acceleration: float
    tolerance: float
    step_out_time: float

    @property
    def held(self) -> Sole:
        """The part of a sole within which the ZMP can be held."""
        return Sole(*self.zmp)


def step_limits(leg_length: float, step_width: float, sole: Sole, omega: float) -> StepLimits:
    """Return what the recovery steps of a robot may be.

    Times scale with the leg's pendulum time sqrt(leg_length / g), speeds with its root.

    Args:
        leg_length: from hip to sole with the leg straight, m.
        step_width: lateral distance of the sole centres when standing, m.
        sole: half sizes of the soles.
        omega: natural frequency of the walker's pendulum, 1/s.
    """
    pendulum = sqrt(leg_length / GRAVITY)
    gait = replace(
        GaitLimits.for_leg(leg_length, step_width, sole),
        forward=FORWARD * leg_length,
        backward=BACKWARD * leg_length,
        max_width=step_width + ASIDE * leg_length,
    )
    return StepLimits(
        gait=gait,
        omega=omega,
        zmp=(HOLD * sole.half_length, HOLD * sole.half_width),
        swing_time=(1.1 * pendulum, 3.5 * pendulum),
        swing_speed=4.0 * sqrt(leg_length),
        swing_acceleration=SWING_ACCELERATION,
        tolerance=TOLERANCE * leg_length,
        step_out_time=1.2 * pendulum,
    )
