"""Dry friction of the joints, overcome along their planned speeds."""

from __future__ import annotations

import numpy as np

from preview_walk.tracking.whole_body import WholeBodyController
from preview_walk.types import Array

FOLLOW = 0.05
"""The planned speed of a joint is drawn to the measured one with this time constant (s)."""

SLOW = 0.1
"""Below this speed (rad/s) friction is compensated in proportion: noise must not flip it."""

COMPENSATED = 0.9
"""Share of the dry friction that is compensated: too much of it would drive the joints."""


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
