"""Joint angles and speeds, made of encoders that may fail for a moment."""

from __future__ import annotations

import numpy as np

from preview_walk.estimation.measurement import Measurement
from preview_walk.estimation.signals import Channel
from preview_walk.types import Array

FASTEST = 100.0
"""No joint of a walking robot turns faster than this (rad/s)."""

JUMP = 0.5
"""Nor does it jump by this (rad) from one tick to the next."""

SAME = 3
"""An encoder that reads the same so many ticks in a row, when its joint was moving, is stuck."""

MOVES = 0.5
"""Speed (rad/s) from which a joint was moving: it cannot have stopped within a tick."""

FOLLOW = 0.05
"""The planned speed is drawn to the measured one with this time constant (s)."""


class Joints:
    """What the joints do.

    Attributes:
        angles, speeds: (n,) rad, rad/s.
    """

    def __init__(self, angles: Array) -> None:
        """Begin at rest at these angles (n,), rad."""
        self.angles, self.speeds = np.array(angles), np.zeros(len(angles))
        self._planned, self._read = np.zeros(len(angles)), np.array(angles)
        self._same, self._moved = np.zeros(len(angles), dtype=int), np.zeros(len(angles))
        self._encoders = Channel("the encoder of joint", "rad", 1e3, JUMP)
        self._rates = Channel("the speed of joint", "rad/s", FASTEST)

    @property
    def refused(self) -> int:
        """How many readings were not taken."""
        return self._encoders.refused + self._rates.refused

    def update(self, m: Measurement, acceleration: Array, dt: float) -> None:
        """Take the readings of a tick.

        Args:
            m: the readings.
            acceleration: (n,) that the controller has asked of the joints, rad/s^2.
            dt: time since the last readings, s.

        Raises:
            SensorError: a joint has told nothing for too long.
        """
        self._planned = self._planned + dt * acceleration
        same = m.angles == self._read
        self._same = np.where(same, self._same + 1, 0)
        self._read = m.angles
        doubtful = same & (np.abs(self._moved) > MOVES)
        stuck = doubtful & (self._same >= SAME)
        angles, speeds = m.angles, m.speeds
        if stuck.any():
            angles = np.where(stuck, np.nan, angles)
            speeds = np.where(stuck, np.nan, speeds)
        self.speeds = self._rates.take(speeds, self._planned, dt)
        self.angles = self._encoders.take(angles, self.angles + dt * self.speeds, dt)
        self._moved = np.where(same, self._moved, self.speeds)
        drawn = np.where(doubtful, 0.0, min(1.0, dt / FOLLOW))
        self._planned = self._planned + drawn * (self.speeds - self._planned)
