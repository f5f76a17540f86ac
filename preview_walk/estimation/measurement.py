"""What the sensors of one tick read."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from preview_walk.types import Array, Foot


@dataclass(frozen=True, eq=False)
class Measurement:
    """The readings at hand at one tick, however old they are.

    Attributes:
        angles: (n,) of the joints' encoders, rad.
        speeds: (n,) of the joints as their drives give them, rad/s.
        gyro: (3,) mean turning rate since the last tick, base axes, rad/s.
        accelerometer: (3,) mean specific force since then (gravity's opposite at rest), base axes,
            m/s^2.
        wrench: (6,) per foot, ground on robot: [force; moment about the sole's centre], the sole's
            axes, N, N·m.
    """

    angles: Array
    speeds: Array
    gyro: Array
    accelerometer: Array
    wrench: Mapping[Foot, Array]
