"""What the soles feel, made of sensors that are noisy, off zero, or dead.

A sole that swings feels nothing: what its sensor reads then is its zero. What is within the noise
of nothing is taken for nothing, and where both soles together feel too little of what carries the
robot, by its accelerometer, a sensor is dead and the other one's complement stands in for it.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import hypot, sqrt

import numpy as np

from preview_walk.types import Array

SMOOTHING = 0.006
"""Time constant (s) over which the readings are smoothed."""

SURE = 4.0
"""Standard deviations beyond which a force is one."""

TARE = 0.1
"""Time constant (s) by which a swinging sole's reading becomes its zero."""

ALL = 0.85
"""A sole is in the air if the other carries this share of the weight, and it next to none."""

MISSING = 0.6
"""Both soles may feel less than what carries the robot by this share of the weight: the base, where
that is measured, goes up and down by itself as legs swing."""

STANDS_IN = 0.3
"""Share of the weight that a sole with a dead sensor carries at least, if it carries any."""

DEAD = 0.03
"""A sensor that feels too little for so long (s) is dead."""


@dataclass(frozen=True)
class ForceNoise:
    """Standard deviations of a sole's readings, shares of the robot's weight.

    Attributes:
        noise: of one reading.
        bias: of the zero at first.
    """

    noise: float = 0.0
    bias: float = 0.0


class SoleForces:
    """The forces under both soles of a robot.

    Attributes:
        wrench: (2, 6) left and right: [force; moment about the sole's centre], the sole's axes,
            N, N·m.
        loads: share of the weight on each.
        dead: which sensors are taken to be dead.
    """

    def __init__(self, weight: float, noise: ForceNoise) -> None:
        """Begin with sensors whose zero is not known.

        Args:
            weight: of the robot, N.
            noise: of its sensors.
        """
        self._weight, self._noise = weight, noise
        self.wrench, self._zero = np.zeros((2, 6)), np.zeros((2, 6))
        self._smooth: Array | None = None
        self._spread = [noise.bias, noise.bias]
        self.loads = [0.5, 0.5]
        self.dead = [False, False]
        self._missing = 0.0

    def update(self, read: Array, carried: float, heights: Array, dt: float) -> None:
        """Take the readings of a tick.

        Args:
            read: (2, 6) as the sensors give it.
            carried: upward force on the whole robot by its accelerometer, N.
            heights: (2,) of the soles, m: of two that feel nothing the lower one stands.
            dt: time since the last readings, s.
        """
        if self._smooth is None or self._noise.noise == 0.0:
            self._smooth = np.array(read)
        else:
            self._smooth = self._smooth + (read - self._smooth) * (dt / (dt + SMOOTHING))
        self._tare(dt)
        self.wrench = self._smooth - self._zero
        white = self._noise.noise * sqrt(dt / (dt + 2.0 * SMOOTHING))
        for k in (0, 1):
            if self.wrench[k, 2] < SURE * hypot(white, self._spread[k]) * self._weight:
                self.wrench[k] = 0.0
        self._complete(carried, heights, dt)
        self.loads = (self.wrench[:, 2] / self._weight).tolist()

    def _tare(self, dt: float) -> None:
        """Let the reading of a sole in the air become its zero."""
        assert self._smooth is not None
        for k in (0, 1):
            here, other = self._smooth[k, 2], self._smooth[1 - k, 2]
            if other > ALL * self._weight and abs(here) < 0.1 * self._weight and not any(self.dead):
                share = dt / (dt + TARE)
                self._zero[k] += share * (self._smooth[k] - self._zero[k])
                self._spread[k] *= 1.0 - share

    def _complete(self, carried: float, heights: Array, dt: float) -> None:
        """Put what is missing under a sole whose sensor is dead."""
        loads = self.wrench[:, 2]
        missing = min(carried, self._weight) - float(loads.sum())
        silent = [k for k in (0, 1) if loads[k] == 0.0]
        short = bool(silent) and missing > MISSING * self._weight
        self._missing = self._missing + dt if short else 0.0
        if self._missing > DEAD and not any(self.dead):
            self.dead[min(silent, key=lambda k: float(heights[k]))] = True
        for k in (0, 1):
            self.dead[k] = self.dead[k] and loads[k] == 0.0
            if self.dead[k]:
                share = 1.0 - float(loads[1 - k]) / self._weight
                self.wrench[k, 2] = share * self._weight if share > STANDS_IN else 0.0
