"""The walking lab's swing: a sampled path of the foot between two sole positions."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import isfinite

import numpy as np

from preview_walk.errors import InvalidInput
from preview_walk.geometry.poses import pose_at
from preview_walk.pattern.swing import Swing
from preview_walk.types import Array


@dataclass(frozen=True)
class SwingLegTrajectory:
    """The walking lab's name for a sampled swing between two sole positions.

    Attributes: as in `Swing`.
    """

    swing_height: float = 0.05
    ground_clearance: float = 0.02

    def generate_trajectory(
        self, start_pos: Sequence[float], end_pos: Sequence[float], duration: float, dt: float
    ) -> tuple[Array, Array, Array]:
        """Return t (N,), position (N, 3) and velocity (N, 3) from lift (t = 0) to landing.

        Args:
            start_pos: sole centre (x, y, z) at lift, m.
            end_pos: sole centre (x, y, z) at landing, m.
            duration: time (s) in the air.
            dt: sample time (s).

        Raises:
            InvalidInput: a time that is not > 0, or a position that is not three numbers.
        """
        for name, value in (("duration", duration), ("dt", dt)):
            if not (isfinite(value) and value > 0.0):
                raise InvalidInput(f"{name} must be > 0 s, got {value}.")
        ends = []
        for name, point in (("start_pos", start_pos), ("end_pos", end_pos)):
            values = np.asarray(point, dtype=np.float64)
            if values.shape != (3,) or not np.isfinite(values).all():
                raise InvalidInput(f"{name} must be (x, y, z) in m, got {point!r}.")
            ends.append(pose_at(float(values[0]), float(values[1]), 0.0, float(values[2])))
        swing = Swing(ends[0], ends[1], 0.0, duration, self.swing_height, self.ground_clearance)
        t: Array = dt * np.arange(round(duration / dt) + 1, dtype=np.float64)
        samples = [swing.at(s) for s in t.tolist()]
        pos: Array = np.array([pose[:3, 3] for pose, _, _ in samples])
        return t, pos, np.array([velocity[:3] for _, velocity, _ in samples])
