"""Model predictive control with a preview servo inside: its optimum, under limits.

A preview servo is the optimum without limits. With v = v_servo + c over the N samples of the window
and the servo for ever after, the cost is that of the servo plus

    sum_i c(i)' W^-1 c(i),    W^-1 = R + D' Q_e D + G' P G,

so the quadratic programme asks for the least c that keeps inputs and outputs within their limits
(Kouvaritakis, Rossiter and Schuurmans, "Efficient robust predictive control", IEEE TAC 45(8),
2000, for the parametrisation). Where no limit is in reach c = 0 and nothing is solved. Limits that
the solution obeys anyway are left out: those that it breaks are added until it breaks none.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from preview_walk.errors import InvalidInput
from preview_walk.preview.checks import require_type
from preview_walk.preview.design import PreviewDesign, loop_matrices
from preview_walk.preview.least_norm import ROUNDS, TOLERANCE, least_norm
from preview_walk.preview.limits import Limits, output_limits
from preview_walk.preview.problem import Weights, error_augmented, positional
from preview_walk.preview.recursion import Recursion
from preview_walk.preview.response import Correlation
from preview_walk.preview.servo import PreviewServo, ServoState
from preview_walk.types import Array


@dataclass(frozen=True, eq=False)
class Prediction:
    """u (N + 1, m) and y (N + 1, p) at the samples k to k + N."""

    u: Array
    y: Array


class PredictiveServo(PreviewServo):
    """A preview servo that plans within limits, by a quadratic programme at each sample.

    Attributes:
        failures: Samples at which the limits contradicted each other, or were not solved in time;
            there the preview servo's own input was used, cut to its limits.

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
        plant = design.plant
        n, m = plant.B.shape
        self.failures = 0
        self._limits = limits
        a, b, self._c, self._d = loop_matrices(design)
        self._on_z = -design.feedback + (np.eye(m, n + m, n) if design.integral else 0.0)
        push = np.eye(len(a), n)
        self._loop = Recursion(a, np.hstack([b, push]))
        self._reference = Correlation(design.window_gain)
        known = plant.E.shape[1] > 0
        self._disturbance = Correlation(design.disturbance_window_gain) if known else None
        weights = Weights(design.Q_e, design.Q_x, design.R)
        problem = (error_augmented if design.integral else positional)(plant, weights)
        inner = problem.r + problem.g.T @ design.riccati @ problem.g
        # In c~ = L' c the Hessian of the programme is the identity.
        self._root = np.linalg.inv(np.linalg.cholesky(inner)).T
        impulse = np.zeros((m, design.horizon + 1, m))
        impulse[:, 0] = self._root.T
        zero = np.zeros((m, design.horizon + 1, n))
        answer = self._answer(impulse, zero, np.zeros((m, len(a))))
        # (N + 1, m + p, m): what c~(0) does to the limited signals i samples later.
        self._impulse = np.concatenate([answer.u, answer.y], axis=2).transpose(1, 2, 0)

    def step(
        self,
        state: ServoState,
        window: ArrayLike,
        disturbance: ArrayLike | None = None,
        *,
        y_limits: tuple[Array, Array] | None = None,
    ) -> ServoState:
        """Return the state one sample later; its `u` is to be held.

        Args:
            state: The state at sample k.
            window: (N + 1, p) reference at the samples k to k + N; (N + 1,) when p = 1.
            disturbance: (N, q) disturbance at the samples k to k + N - 1; zero when None.
            y_limits: Lower and upper limits of the output at the samples k to k + N, each
                (N + 1, p); those of the servo's `Limits` when None.

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
        if y_limits is None:
            y_limits = output_limits(self._limits.y_min, self._limits.y_max, shape)
        free = self._free(state, r, w)
        low = np.hstack([np.broadcast_to(self.u_min, free.u.shape), y_limits[0]])
        high = np.hstack([np.broadcast_to(self.u_max, free.u.shape), y_limits[1]])
        first = self._least_change(np.hstack([free.u, free.y]), low, high)
        if first is None:
            self.failures += 1
        wanted = free.u[0] if first is None else free.u[0] + first
        u = np.clip(wanted, self.u_min, self.u_max)
        x = plant.A @ state.x + plant.B @ u + plant.E @ w[0]
        return ServoState(x, u, np.zeros(len(x)), np.zeros(len(plant.C)))

    def _free(self, state: ServoState, r: Array, w: Array) -> Prediction:
        """Return what the servo itself would do; what is known ends with the window."""
        design = self.design
        action = self._reference.run(r.T[None], 1)[0].T + r @ design.present_gain.T
        push = np.zeros((len(r), len(state.x)))
        if self._disturbance is not None:
            held = np.vstack([w, w[-1:] if design.integral else 0.0 * w[-1:]])
            action = action + self._disturbance.run(held.T[None])[0].T
            push = held @ design.plant.E.T
        start = state.x
        if design.integral:
            # Nobody knows where a drift came from: it is taken to go on.
            unknown = design.drift_gain @ state.drift + design.integral_gain @ state.offset
            action, push = action - unknown, push + state.drift
            start = np.concatenate([state.x, state.u])
        found = self._answer(action[None], push[None], start[None])
        return Prediction(found.u[0], found.y[0] + state.offset)

    def _answer(self, action: Array, push: Array, start: Array) -> Prediction:
        """Return u and y, (batch, N + 1, .), of the loop from a start under actions and pushes."""
        z = self._loop.run(np.concatenate([action, push], axis=2), start)
        return Prediction(z @ self._on_z.T + action, z @ self._c.T + action @ self._d.T)

    def _least_change(self, free: Array, low: Array, high: Array) -> Array | None:
        """Return c(0) of the least change of (N + 1, m + p) signals that obeys the limits."""
        m = len(self.u_min)
        slack = TOLERANCE * (1.0 + np.minimum(np.abs(low), np.abs(high)))
        rows = np.zeros((0, free.shape[0] * m))
        bounds, signals = np.zeros(0), free
        change = np.zeros(rows.shape[1])
        for _ in range(ROUNDS):
            above, below = signals > high + slack, signals < low - slack
            if not (above.any() or below.any()):
                return np.asarray(self._root @ change[:m])
            for broken, sign, limit in ((above, 1.0, high), (below, -1.0, low)):
                for i, j in np.argwhere(broken):
                    row = np.zeros(rows.shape[1])
                    row[: (i + 1) * m] = sign * self._impulse[i::-1, j].ravel()
                    rows = np.vstack([rows, row])
                    bounds = np.append(bounds, sign * (limit[i, j] - free[i, j]))
            found = least_norm(rows, bounds)
            if found is None:
                return None
            change = found
            signals = free + self._effect(change.reshape(-1, m))
        return None

    def _effect(self, change: Array) -> Array:
        """Return what a change c~ (N + 1, m) does to the limited signals, (N + 1, m + p)."""
        action = change @ self._root.T
        push = np.zeros((len(action), len(self.design.plant.A)))
        start = np.zeros((1, len(self._on_z.T)))
        answer = self._answer(action[None], push[None], start)
        return np.hstack([answer.u[0], answer.y[0]])
