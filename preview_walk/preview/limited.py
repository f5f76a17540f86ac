"""What servos that plan within limits share: their windows, their limits, what they count."""

from __future__ import annotations

from abc import abstractmethod
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from preview_walk.errors import InvalidInput
from preview_walk.preview.checks import require_type
from preview_walk.preview.design import PreviewDesign
from preview_walk.preview.half_planes import HalfPlanes
from preview_walk.preview.limits import Limits
from preview_walk.preview.servo import PreviewServo, ServoState
from preview_walk.types import Array


class LimitedServo(PreviewServo):
    """A servo that plans within limits of inputs and outputs.

    Attributes:
        limits: The limits.
        failures: Samples at which the limits contradicted each other, or were not solved in time.

    """

    def __init__(
        self, design: PreviewDesign, limits: Limits, *, observer_gain: ArrayLike | None = None
    ) -> None:
        """Make a design ready to run within limits.

        Args:
            design: The servo, from `preview_gains`, with N >= 1 and no final cost.
            limits: Limits of input and output.
            observer_gain: (n, p) gain of `observed`.

        Raises:
            InvalidInput: If limits contradict each other or a shape is wrong.

        """
        require_type("limits", limits, Limits)
        super().__init__(
            design, u_min=limits.u_min, u_max=limits.u_max, observer_gain=observer_gain
        )
        if design.horizon < 1:
            raise InvalidInput("expected a design with N >= 1, got N = 0.", argument="design")
        self.limits = limits
        self.failures = 0

    def step(
        self,
        state: ServoState,
        window: ArrayLike,
        disturbance: ArrayLike | None = None,
        *,
        y_limits: HalfPlanes | None = None,
    ) -> ServoState:
        """Return the state one sample later; its `u` is to be held.

        Args:
            state: The state at sample k.
            window: (N + 1, p) reference at the samples k to k + N; (N + 1,) when p = 1.
            disturbance: (N, q) disturbance at the samples k to k + N - 1; zero when None.
            y_limits: Limits of the outputs at the samples k to k + N, as
                `limits.of_outputs(M, p).window(k, N + 1)` has them; the servo's own when None.

        Raises:
            InvalidInput: If a window has another shape or holds NaN or infinity.

        """
        require_type("state", state, ServoState)
        design, plant = self.design, self.design.plant
        shape = (design.horizon + 1, len(plant.C))
        r = self._window("window", window, *shape).reshape(shape)
        w: Array = np.zeros((design.horizon, plant.E.shape[1]))
        if disturbance is not None:
            w = self._window("disturbance", disturbance, *w.shape).reshape(w.shape)
        planes = self._own_limits if y_limits is None else y_limits
        require_type("y_limits", planes, HalfPlanes)
        if planes.normals.shape != (shape[0], planes.offsets.shape[-1], shape[1]):
            raise InvalidInput(
                f"expected y_limits of {shape[0]} samples and {shape[1]} outputs, got normals of "
                f"shape {planes.normals.shape}.",
                argument="y_limits",
            )
        u = np.clip(self._planned(state, (r, w), planes), self.u_min, self.u_max)
        x = plant.A @ state.x + plant.B @ u + plant.E @ w[0]
        return ServoState(x, u, np.zeros(len(x)), np.zeros(len(plant.C)))

    @cached_property
    def _own_limits(self) -> HalfPlanes:
        return self.limits.of_outputs(self.design.horizon + 1, len(self.design.plant.C))

    @abstractmethod
    def _planned(self, state: ServoState, future: tuple[Array, Array], planes: HalfPlanes) -> Array:
        """Return the input (m,) for a future r (N + 1, p), w (N, q), and note a failure."""
