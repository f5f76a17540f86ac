"""Faults: a sensor or motor that fails for a while."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from math import inf

import numpy as np

from preview_walk.arguments import number_from_zero, shown
from preview_walk.errors import InvalidInput
from preview_walk.types import Array

PARTS = ("encoder", "speed", "gyro", "accelerometer", "sole", "motor")
"""What can fail."""


@dataclass(frozen=True)
class Fault:
    """A sensor that reads something else for a while, or a motor that gives another torque.

    Attributes:
        part: "encoder", "speed", "gyro", "accelerometer", "sole" or "motor".
        which: the joint's name, the foot, or the axis "x", "y" or "z"; None for all of them.
        t: when it begins, s.
        duration: how long it lasts, s.
        value: that is read, in the sensor's unit; None: the last reading stays. Of a motor the
            share of its torque that is left.
    """

    part: str
    which: str | None = None
    t: float = 0.0
    duration: float = inf
    value: float | None = None

    def __post_init__(self) -> None:
        """Check the values."""
        if self.part not in PARTS:
            raise InvalidInput(
                f"the part of a fault must be one of {', '.join(PARTS)}, got {shown(self.part)}.",
                "part",
            )
        number_from_zero(self.t, "t", "s")
        if not self.duration > 0.0:
            raise InvalidInput(f"duration must be > 0 s, got {shown(self.duration)}.", "duration")
        if self.part == "motor" and self.value is None:
            raise InvalidInput("value must be the share of torque that a motor has left.", "value")


class Faulty:
    """One part of the robot with the faults that it will have."""

    def __init__(self, faults: Iterable[Fault], part: str, names: tuple[str, ...]) -> None:
        """Find the faults of a part.

        Args:
            faults: of the whole robot.
            part: which of its parts this is.
            names: of its numbers or groups of numbers, in order.

        Raises:
            InvalidInput: a fault of this part names nothing that it has.
        """
        self._mine = [fault for fault in faults if fault.part == part]
        self._names = names
        for fault in self._mine:
            if fault.which is not None and fault.which not in names:
                raise InvalidInput(
                    f"a fault of the {part} must name one of {', '.join(names)}, "
                    f"got {shown(fault.which)}.",
                    "which",
                )

    def __bool__(self) -> bool:
        return bool(self._mine)

    def spoil(self, reading: Array, last: Array, t: float) -> Array:
        """Return a reading (k, ...) at time t (s) with the faults in it; `last` was before it."""
        for fault in self._mine:
            if fault.t <= t < fault.t + fault.duration:
                reading = np.array(reading)
                at = slice(None) if fault.which is None else self._names.index(fault.which)
                reading[at] = last[at] if fault.value is None else fault.value
        return reading

    def shares(self, t: float) -> Array:
        """Return which share of it is left of each number at time t (s)."""
        left = np.ones(len(self._names))
        for fault in self._mine:
            if fault.t <= t < fault.t + fault.duration and fault.value is not None:
                left[slice(None) if fault.which is None else self._names.index(fault.which)] *= (
                    fault.value
                )
        return left
