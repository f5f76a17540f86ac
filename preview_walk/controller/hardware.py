"""What a controller knows of its robot's imperfections, and how fast it may be with them."""

from __future__ import annotations

from dataclasses import dataclass

from preview_walk.robots.robot import Robot
from preview_walk.stabilizer.disturbance import ROUGH_SMOOTHING_TIME, SMOOTHING_TIME
from preview_walk.tracking.contacts import COP_MARGIN
from preview_walk.types import FEET, Array

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


def smoothing_time(hardware: Hardware | None, blind: bool) -> float:
    """Return the time constant (s) of the disturbance's estimate.

    An observer Q = 1 / (T s + 1) whose answer comes late by tau closes a loop of gain
    exp(-tau s) / (T s). It is stable up to tau = pi T / 2, and robust to what the model does not
    know where |Q (exp(-tau s) - 1)|, at most about tau / T, is small (Sariyildiz and Ohnishi, "A
    guide to design disturbance observer", JDSMC 2014): T is `PER_DELAY` times tau.
    """
    least = SMOOTHING_TIME if hardware is None else PER_DELAY * hardware.delay
    return max(least, ROUGH_SMOOTHING_TIME if blind else SMOOTHING_TIME)
