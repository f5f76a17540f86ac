"""Readings that cannot be: each is replaced by what was expected, counted, and told.

A channel that is not finite, or further from what was expected than matter can have moved, is not
taken. For a few ticks the expected value stands in; for longer nobody knows where the robot is, and
the walk ends with a sentence.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from preview_walk.errors import PreviewWalkError
from preview_walk.types import Array

LONGEST = 0.1
"""A channel may be missing for so long (s)."""


class SensorError(PreviewWalkError):
    """A sensor gave no reading that can be for longer than the robot can do without it."""


@dataclass(eq=False)
class Channel:
    """A group of numbers that one sensor reads, and how often it was refused.

    Attributes:
        name: in a sentence.
        unit: of its numbers.
        largest: no reading is larger in absolute value; a number or one per reading.
        jump: nor further from what was expected.
        refused: how many readings were not taken so far.
    """

    name: str
    unit: str
    largest: float | Array
    jump: float | Array = np.inf
    refused: int = 0
    _missing: float = field(default=0.0, repr=False)

    def take(self, reading: Array, expected: Array, dt: float) -> Array:
        """Return a reading, with what was expected in place of numbers that cannot be.

        Args:
            reading: what the sensor says.
            expected: what it should say, of the same shape.
            dt: time since the last reading, s.

        Raises:
            SensorError: numbers were missing for longer than `LONGEST`.
        """
        # Comparisons with nan are false.
        good = (np.abs(reading) <= self.largest) & (np.abs(reading - expected) <= self.jump)
        if good.all():
            self._missing = 0.0
            return reading
        self.refused += 1
        self._missing += dt
        if self._missing > LONGEST + 1e-9:
            worst = int(np.flatnonzero(~good)[0])
            raise SensorError(
                f"{self.name} {worst} has given nothing that can be for {self._missing:.2f} s, "
                f"last {reading[worst]:g} {self.unit} where {expected[worst]:.3g} was expected."
            )
        return np.where(good, reading, expected)
