"""The servo online, one sample at a time, for any plant: limits of the input, measured states.

    state = servo.start(x0)
    each sample:
        state = servo.step(state, window)        # state.u is the input until the next sample
        (the plant moves)
        state = servo.measured(state, x)         # or servo.observed(state, y), or neither

The law is the incremental one: what stands for the integral of the error is the input itself, as it
was after its limits. An input at its limit therefore winds nothing up.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from preview_walk.errors import InvalidInput
from preview_walk.preview.checks import Value, finite_vector, real_array, require_type
from preview_walk.preview.design import PreviewDesign
from preview_walk.preview.limits import input_limits
from preview_walk.types import Array


@dataclass(frozen=True, eq=False)
class ServoState(Value):
    """What a servo knows just before its input changes; all arrays are read-only.

    Attributes:
        x: (n,) state, predicted, measured or observed.
        u: (m,) input held up to this instant; after `step`, the one to hold from the last instant
            to this one.
        drift: (n,) x minus what the model had predicted: what nobody had foreseen.
        offset: (p,) measured output minus C x + D u.

    """

    x: Array
    u: Array
    drift: Array
    offset: Array


class PreviewServo:
    """A preview design run online.

    Attributes:
        design: The design.
        u_min: (m,) lower limits of the input.
        u_max: (m,) upper limits of the input.
        observer_gain: (n, p) L of `observed`, or None.

    """

    def __init__(
        self,
        design: PreviewDesign,
        *,
        u_min: ArrayLike | None = None,
        u_max: ArrayLike | None = None,
        observer_gain: ArrayLike | None = None,
    ) -> None:
        """Make a design ready to run.

        Args:
            design: The servo, from `preview_gains`.
            u_min: Lower limits of the input, a number or (m,); none when None.
            u_max: Upper limits of the input, a number or (m,); none when None.
            observer_gain: (n, p) gain of `observed`, from `kalman_gain` or `luenberger_gain`.

        Raises:
            InvalidInput: If limits contradict each other or a shape is wrong.

        """
        require_type("design", design, PreviewDesign)
        plant = design.plant
        m, p = plant.B.shape[1], len(plant.C)
        self.design = design
        self.u_min, self.u_max = input_limits(u_min, u_max, m)
        self.observer_gain: Array | None = None
        if observer_gain is not None:
            gain = real_array("observer_gain", observer_gain)
            if gain.shape != (len(plant.A), p) or not np.isfinite(gain).all():
                raise InvalidInput(
                    f"expected observer_gain to be finite and of shape ({len(plant.A)}, {p}), got "
                    f"shape {gain.shape}.",
                    argument="observer_gain",
                )
            self.observer_gain = gain
        # One product for each window: the gains side by side, in the order of its samples.
        whole = np.concatenate([design.present_gain[None], design.window_gain])
        self._window_gain = np.ascontiguousarray(whole.transpose(1, 0, 2).reshape(m, -1))
        self._disturbance_gain = np.ascontiguousarray(
            design.disturbance_window_gain.transpose(1, 0, 2).reshape(m, -1)
        )

    def __repr__(self) -> str:
        return f"PreviewServo({self.design!r})"

    def start(self, x: ArrayLike | None = None, u: ArrayLike | None = None) -> ServoState:
        """Return the state at which a run starts.

        Args:
            x: (n,) state; zero when None.
            u: (m,) input up to now; zero when None.

        Raises:
            InvalidInput: If a shape is wrong or a value not finite.

        """
        n, m = self.design.plant.B.shape
        state, held = finite_vector("x", x, np.zeros(n)), finite_vector("u", u, np.zeros(m))
        return ServoState(state, held, np.zeros(n), np.zeros(len(self.design.plant.C)))

    def step(
        self, state: ServoState, window: ArrayLike, disturbance: ArrayLike | None = None
    ) -> ServoState:
        """Return the state one sample later as the model predicts it; its `u` is to be held.

        Args:
            state: The state at sample k.
            window: (N + 1, p) reference at the samples k to k + N; (N + 1,) when p = 1.
            disturbance: (N, q) disturbance at the samples k to k + N - 1; (N,) when q = 1; zero
                when None.

        Raises:
            InvalidInput: If a window has another shape or holds NaN or infinity.

        """
        require_type("state", state, ServoState)
        design, plant = self.design, self.design.plant
        n_ahead, q = design.horizon, plant.E.shape[1]
        action = self._window_gain @ self._window("window", window, n_ahead + 1, len(plant.C))
        present = np.zeros(q)
        if disturbance is not None:
            ahead = self._window("disturbance", disturbance, n_ahead, q)
            action = action + self._disturbance_gain @ ahead
            present = ahead[:q] if n_ahead > 0 else present
        if design.integral:
            action = action + state.u - design.feedback @ np.concatenate([state.x, state.u])
            action = action - design.drift_gain @ state.drift - design.integral_gain @ state.offset
        else:
            action = action - design.feedback @ state.x
        u = np.clip(action, self.u_min, self.u_max)
        x = plant.A @ state.x + plant.B @ u + plant.E @ present
        return ServoState(x, u, np.zeros(len(x)), np.zeros(len(plant.C)))

    def measured(self, state: ServoState, x: ArrayLike) -> ServoState:
        """Return a predicted state corrected by a measured one.

        Args:
            state: The state from `step`.
            x: (n,) measured state.

        Raises:
            InvalidInput: If x is not n finite numbers.

        """
        require_type("state", state, ServoState)
        found = finite_vector("x", x, np.zeros(len(state.x)))
        return ServoState(found, state.u, found - state.x, state.offset)

    def observed(self, state: ServoState, y: ArrayLike) -> ServoState:
        """Return a predicted state corrected by measured outputs, x + L (y - C x - D u).

        The error of the law is that of the measured output, so that integral action removes what
        an observer with a wrong model does not see.

        Args:
            state: The state from `step`.
            y: (p,) output, measured just before the input changes.

        Raises:
            InvalidInput: If there is no observer gain or y is not p finite numbers.

        """
        if self.observer_gain is None:
            raise InvalidInput(
                "expected a servo with an observer_gain, got one without.", argument="observer_gain"
            )
        require_type("state", state, ServoState)
        plant = self.design.plant
        output = finite_vector("y", y, np.zeros(len(plant.C)))
        drift = self.observer_gain @ (output - plant.C @ state.x - plant.D @ state.u)
        x = state.x + drift
        return ServoState(x, state.u, drift, output - plant.C @ x - plant.D @ state.u)

    def _window(self, name: str, value: ArrayLike, rows: int, columns: int) -> Array:
        array = value if isinstance(value, np.ndarray) else real_array(name, value)
        if array.shape != (rows, columns) and not (columns == 1 and array.shape == (rows,)):
            raise InvalidInput(
                f"expected {name} of shape ({rows}, {columns}), got {array.shape}.", argument=name
            )
        if array.dtype.kind not in "biuf" or not np.isfinite(array).all():
            raise InvalidInput(
                f"expected a finite {name}, got NaN, infinity or no numbers.", argument=name
            )
        return array.ravel()
