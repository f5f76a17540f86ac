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

from preview_walk.preview.checks import computable
from preview_walk.preview.design import PreviewDesign, loop_matrices
from preview_walk.preview.half_planes import HalfPlanes, beside, of_box
from preview_walk.preview.least_norm import ROUNDS, TOLERANCE, least_norm
from preview_walk.preview.limited import LimitedServo
from preview_walk.preview.limits import Limits
from preview_walk.preview.problem import Weights, error_augmented, positional
from preview_walk.preview.recursion import Recursion
from preview_walk.preview.response import Correlation
from preview_walk.preview.servo import ServoState
from preview_walk.types import Array


@dataclass(frozen=True, eq=False)
class Prediction:
    """u (N + 1, m) and y (N + 1, p) at the samples k to k + N."""

    u: Array
    y: Array


class PredictiveServo(LimitedServo):
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
        super().__init__(design, limits, observer_gain=observer_gain)
        plant = design.plant
        n, m = plant.B.shape
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
        sides = (np.tile(side, (design.horizon + 1, 1)) for side in (self.u_min, self.u_max))
        self._input_limits = of_box(*sides)
        # In c~ = L' c the Hessian of the programme is the identity.
        with computable("design"):
            self._root = np.linalg.inv(np.linalg.cholesky(inner)).T
        impulse = np.zeros((m, design.horizon + 1, m))
        impulse[:, 0] = self._root.T
        zero = np.zeros((m, design.horizon + 1, n))
        answer = self._answer(impulse, zero, np.zeros((m, len(a))))
        # (N + 1, m + p, m): what c~(0) does to the limited signals i samples later.
        self._impulse = np.concatenate([answer.u, answer.y], axis=2).transpose(1, 2, 0)

    def _planned(self, state: ServoState, future: tuple[Array, Array], planes: HalfPlanes) -> Array:
        free = self._free(state, *future)
        limits = beside(self._input_limits, planes)
        first = self._least_change(np.hstack([free.u, free.y]), limits)
        if first is None:
            self.failures += 1
            first = np.zeros(len(self.u_min))
        return np.asarray(free.u[0] + first)

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

    def _least_change(self, free: Array, limits: HalfPlanes) -> Array | None:
        """Return c(0) of the least change of (N + 1, m + p) signals that obeys the limits."""
        m = len(self.u_min)
        allowed = limits.offsets + TOLERANCE * (1.0 + np.abs(limits.offsets))
        rows, bounds = np.zeros((0, free.shape[0] * m)), np.zeros(0)
        room = limits.offsets - limits.along(free)
        change, signals = np.zeros(rows.shape[1]), free
        for _ in range(ROUNDS):
            broken = limits.along(signals) > allowed
            if not broken.any():
                return np.asarray(self._root @ change[:m])
            for i, j in np.argwhere(broken):
                row = np.zeros(rows.shape[1])
                row[: (i + 1) * m] = (limits.normals[i, j] @ self._impulse[i::-1]).ravel()
                rows = np.vstack([rows, row])
            bounds = np.append(bounds, room[broken])
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
