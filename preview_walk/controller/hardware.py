"""What a controller knows of its robot's imperfections, and what it does about them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from preview_walk.robots.robot import Robot
from preview_walk.stabilizer.disturbance import ROUGH_SMOOTHING_TIME, SMOOTHING_TIME
from preview_walk.tracking.contacts import COP_MARGIN
from preview_walk.tracking.whole_body import WholeBodyController
from preview_walk.types import FEET, Array

FOLLOW = 0.05
"""The planned speed of a joint is drawn to the measured one with this time constant (s)."""

SLOW = 0.1
"""Below this speed (rad/s) friction is compensated in proportion: noise must not flip it."""

COMPENSATED = 0.9
"""Share of the dry friction that is compensated: too much of it would drive the joints."""


PER_DELAY = 8.0
"""Time constant of the disturbance's estimate over the delay of its answer."""

SURE, PLAY = 3.0, 0.5
"""So many standard deviations of the estimate's noise should move the wanted ZMP by no more than
this share of the sole's half width."""


@dataclass(frozen=True, eq=False)
class Hardware:
    """What a data sheet says of the robot.

    Attributes:
        delay: from a state to the torques that answer it, s.
        friction: (n,) dry friction of the joints, N·m.
    """

    delay: float
    friction: Array

    def edge(self, robot: Robot) -> float:
        """Return the width of the strip along a sole's edges where nothing is to be pressed, m.

        What an ankle's friction holds back moves the centre of pressure by so much. Pressed at its
        very edge a sole turns over it, and the ankle's friction keeps it there.
        """
        ankles = [robot.legs[foot].joints[-2:] for foot in FEET]
        rows = [int(robot.pin.joints[joint].idx_v) - 6 for pair in ankles for joint in pair]
        return float(self.friction[rows].max()) / (robot.mass * robot.gravity)

    def pressed_width(self, robot: Robot) -> float:
        """Return half of the width of a sole that may be pressed, m."""
        return (1.0 - COP_MARGIN) * robot.sole.half_width - self.edge(robot)


def dcm_rate(wanted: float, omega: float, delay: float, spread: float, half_width: float) -> float:
    """Return the rate (1/s) of the DCM's feedback that delay and noise allow; never below omega.

    The DCM xi' = omega (xi - p) with p = (1 + k / omega) xi, a lag of tau late, has

        tau s^2 + (1 - omega tau) s + k = 0,

    which is not damped critically any more beyond k = (1 - omega tau)^2 / (4 tau). An error of the
    velocity, of standard deviation sigma, moves the wanted ZMP by (1 + k / omega) sigma / omega:
    `SURE` times that should be at most `PLAY` of the sole's half width, or the soles are pressed
    on their edges by noise alone. The lag is that of Morisawa et al., Humanoids 2012.

    Args:
        wanted: the rate without delay and noise, 1/s.
        omega: natural frequency of the pendulum, 1/s.
        delay: tau, s.
        spread: sigma, m/s.
        half_width: of what of a sole may be pressed, m.
    """
    rates = [wanted]
    if delay > 0.0:
        rates.append((1.0 - omega * delay) ** 2 / (4.0 * delay))
    if spread > 0.0:
        rates.append(omega * (PLAY * half_width * omega / (SURE * spread) - 1.0))
    return max(min(rates), min(wanted, omega))


class FrictionCompensation:
    """Overcomes the dry friction of the joints, along their planned speeds.

    The measured speed comes late and is noisy: torques along it would chatter, and drive a light
    leg in circles. The planned one is what the accelerations asked for add up to, and only slowly
    drawn to the measured one.
    """

    def __init__(self, friction: Array) -> None:
        """Begin at rest.

        Args:
            friction: (n,) dry friction of the joints, N·m.
        """
        self._friction = COMPENSATED * friction
        self._speed: Array = np.zeros(len(friction))
        self._time: float | None = None

    def torques(self, t: float, body: WholeBodyController) -> Array:
        """Return the torques (n,) to be added, N·m.

        Args:
            t: now, s.
            body: at the measured state, its QP solved.
        """
        if body.solution is not None and self._time is not None:
            dt = t - self._time
            drawn = (body.dynamics.v[6:] - self._speed) / FOLLOW
            self._speed = self._speed + dt * (body.solution.acceleration[6:] + drawn)
        self._time = t
        value: Array = self._friction * np.tanh(self._speed / SLOW)
        return value


def smoothing_time(hardware: Hardware | None, blind: bool) -> float:
    """Return the time constant (s) of the disturbance's estimate.

    An observer Q = 1 / (T s + 1) whose answer comes late by tau closes a loop of gain
    exp(-tau s) / (T s). It is stable up to tau = pi T / 2, and robust to what the model does not
    know where |Q (exp(-tau s) - 1)|, at most about tau / T, is small (Sariyildiz and Ohnishi, "A
    guide to design disturbance observer", JDSMC 2014): T is `PER_DELAY` times tau.
    """
    least = SMOOTHING_TIME if hardware is None else PER_DELAY * hardware.delay
    return max(least, ROUGH_SMOOTHING_TIME if blind else SMOOTHING_TIME)
