"""The walking lab's swing: a sampled path of the foot between two sole positions."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from preview_walk.arguments import (
    number_from_zero,
    positive_number,
    real_array,
    sample_count,
    shown,
)
from preview_walk.errors import InvalidInput
from preview_walk.geometry.poses import pose_at
from preview_walk.pattern.swing import Swing
from preview_walk.types import Array


@dataclass(frozen=True)
class SwingLegTrajectory:
    """The walking lab's name for a sampled swing between two sole positions.

    Attributes:
        swing_height: height of the apex above the higher of the two soles, m.
        ground_clearance: height above the straight line between the two sole centres, at least,
            between 10 % and 90 % of the horizontal travel, m.

    Raises:
        InvalidInput: a height that is not >= 0.
    """

    swing_height: float = 0.05
    ground_clearance: float = 0.02

    def __post_init__(self) -> None:
        """Check the heights."""
        for name in ("swing_height", "ground_clearance"):
            number_from_zero(getattr(self, name), name, "m")

    def generate_trajectory(
        self,
        start_pos: Sequence[float],
        end_pos: Sequence[float],
        duration: float = 0.3,
        dt: float = 0.01,
    ) -> tuple[Array, Array, Array]:
        """Return the swing sampled from lift to landing.

        Args:
            start_pos: sole centre (x, y, z) at lift, m.
            end_pos: sole centre (x, y, z) at landing, m.
            duration: time (s) in the air.
            dt: sample time (s).

        Returns:
            Times (N,) from 0 at lift, s, position (N, 3), m, and velocity (N, 3), m/s.

        Raises:
            InvalidInput: a time that is not > 0, or a position that is not three numbers.
        """
        duration, dt = positive_number(duration, "duration", "s"), positive_number(dt, "dt", "s")
        ends = [_level(start_pos, "start_pos"), _level(end_pos, "end_pos")]
        swing = Swing(ends[0], ends[1], 0.0, duration, self.swing_height, self.ground_clearance)
        t: Array = dt * np.arange(sample_count(duration, dt), dtype=np.float64)
        samples = [swing.at(s) for s in t.tolist()]
        pos: Array = np.array([pose[:3, 3] for pose, _, _ in samples])
        return t, pos, np.array([velocity[:3] for _, velocity, _ in samples])


def _level(point: Sequence[float], name: str) -> Array:
    """Return the pose (4, 4) of a level sole with its centre at this point."""
    form = "(x, y, z) in m"
    values = real_array(point, name, form)
    if values.shape != (3,) or not np.isfinite(values).all():
        raise InvalidInput(f"{name} must be {form}, got {shown(point)}.", argument=name)
    x, y, z = values.tolist()
    return pose_at(x, y, 0.0, z)
