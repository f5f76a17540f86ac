"""The result of a preview design: the gains, what they were made from, the law as a window."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from preview_walk.html import html_table
from preview_walk.preview.checks import Value, read_only
from preview_walk.preview.plant import Plant, as_state_space
from preview_walk.types import Array

if TYPE_CHECKING:
    import control


@dataclass(frozen=True, eq=False, repr=False)
class PreviewDesign(Value):
    """A preview servo, from `preview_gains`; all arrays are read-only.

    With integral action, e = y - r just before the input changes and increments marked by d,

        du(k) = -G_I e(k) - G_x dx(k) - sum_{l=1..N} G_d(l) dr(k+l) - sum_{j=0..N-1} G_w(j) dw(k+j)

    and without

        u(k) = G_I r(k) - G_x x(k) - sum_{l=1..N} G_d(l) dr(k+l) - sum_{j=0..N-1} G_w(j) w(k+j).

    Past its window the future holds its last value; without integral action a disturbance is over
    there, as one that is not seen at all (N = 0) has to be left out.

    Attributes:
        plant: The plant: n states, m inputs, p outputs, q previewed disturbances.
        Q_e: (p, p) weight of the tracking error e = y - r.
        Q_x: (n, n) weight of dx; of x without integral action.
        R: (m, m) weight of du; of u without integral action.
        integral_gain: (m, p) G_I.
        state_gain: (m, n) G_x.
        preview_gain: (N, m, p) G_d; row l - 1 is for the reference l samples ahead.
        riccati: P of X = [e; dx], (p + n, p + n), or of x, (n, n), without integral action.
        closed_loop_matrix: A_c of X or x. With more outputs than inputs, or outputs without
            weight, it keeps a mode at 1 for each error that no constant input can remove; all
            others lie inside the unit circle.
        residual: Largest entry of the Riccati equation's residual over the largest entry of P.
        slow_mode: Largest modulus of a mode of A_c in the preview gains: they decay with it.
        disturbance_gain: (N, m, q) G_w; row j is for the disturbance j samples ahead.
        integral: Whether the servo has integral action.

    """

    plant: Plant
    Q_e: Array
    Q_x: Array
    R: Array
    integral_gain: Array
    state_gain: Array
    preview_gain: Array
    riccati: Array
    closed_loop_matrix: Array
    residual: float
    slow_mode: float
    disturbance_gain: Array
    integral: bool = True

    def __repr__(self) -> str:
        action = "with" if self.integral else "without"
        return f"PreviewDesign({self.plant!r}, N = {self.horizon}, {action} integral action)"

    def _repr_html_(self) -> str:
        """Return the gains as a notebook shows them."""
        rows = [
            ("plant", repr(self.plant)),
            ("integral gain", np.array2string(self.integral_gain, precision=5)),
            ("state gain", np.array2string(self.state_gain, precision=5)),
            ("horizon", f"{self.horizon} samples, {self.horizon * self.dt:g} s"),
            ("share of the slow mode past it", f"{self.neglected:.2g}"),
        ]
        return html_table("PreviewDesign", rows)

    @cached_property
    def system(self) -> control.StateSpace:
        """The plant from u to y as a `control.StateSpace`."""
        return as_state_space(self.plant)

    @property
    def dt(self) -> float:
        """Sampling time (s); 1 where the plant's is not specified and time counts in samples."""
        return float(self.plant.dt)

    @property
    def horizon(self) -> int:
        """N, the number of previewed samples."""
        return int(self.preview_gain.shape[0])

    @property
    def neglected(self) -> float:
        """slow_mode ** N, the share of the slow mode that lies past the horizon."""
        return float(self.slow_mode**self.horizon)

    @cached_property
    def window_gain(self) -> Array:
        """(N, m, p) F(1) to F(N), the preview law in terms of the reference itself.

        v(k) = -feedback z(k) + F(0) r(k) + sum_{l=1..N} F(l) r(k+l) + (disturbances) with v = du
        and z = [x(k); u(k-1)], or v = u and z = x. F(l) = G_d(l+1) - G_d(l) and F(N) = -G_d(N).
        """
        return read_only(np.diff(self.preview_gain, axis=0, append=0.0))

    @cached_property
    def present_gain(self) -> Array:
        """(m, p) F(0) = G_I + G_d(1) on r(k): zero where a reference is previewed and D = 0."""
        if self.horizon == 0:
            return self.integral_gain
        if not np.any(self.plant.D):
            return read_only(np.zeros_like(self.integral_gain))
        return read_only(self.integral_gain + self.preview_gain[0])

    @cached_property
    def disturbance_window_gain(self) -> Array:
        """(N, m, q) F_w, the gains on w(k) to w(k+N-1) themselves; w(k-1) cancels."""
        if not self.integral:
            return read_only(-self.disturbance_gain)
        return read_only(np.diff(self.disturbance_gain, axis=0, append=0.0))

    @cached_property
    def drift_gain(self) -> Array:
        """(m, n) M, with G_x = M A: what an x(k) other than the model's last word adds to du."""
        a, b, c, d = self.plant.A, self.plant.B, self.plant.C, self.plant.D
        if not self.integral:
            return read_only(np.zeros((b.shape[1], len(a))))
        lift = np.vstack([c, np.eye(len(a))])
        if not np.any(d):
            weighted = (lift @ b).T @ self.riccati @ lift
            return read_only(np.linalg.solve(self.R + weighted @ b, weighted))
        g = lift @ b
        g[: len(c)] += d
        inner = self.R + d.T @ self.Q_e @ d + g.T @ self.riccati @ g
        return read_only(np.linalg.solve(inner, g.T @ self.riccati @ lift))

    @cached_property
    def feedback(self) -> Array:
        """(m, n + m) gain on [x(k); u(k-1)], or (m, n) on x(k) without integral action.

        G_x x(k-1) = M A x(k-1) = M (x(k) - B u(k-1)): no x(k-1) has to be remembered or, at the
        start of a run, invented.
        """
        if not self.integral:
            return self.state_gain
        a, b, c, d = self.plant.A, self.plant.B, self.plant.C, self.plant.D
        m = self.drift_gain
        on_input = m @ b
        if np.any(d):
            on_input = on_input + self.integral_gain @ d
        return read_only(np.hstack([self.integral_gain @ c + m @ (a - np.eye(len(a))), on_input]))

    @cached_property
    def closed_loop(self) -> control.StateSpace:
        """The servo loop from the action w(k) = sum_l F(l) r(k+l) (m) to the output (p).

        Its states are [x(k); u(k-1)], or x(k) without integral action. When m = p and D = 0 the
        poles of the servo with integral action are the eigenvalues of A_c.
        """
        import control

        a, b, c, d = loop_matrices(self)
        names = list(self.plant.states)
        if self.integral:
            names += [f"{u}_previous" for u in self.plant.inputs]
        inputs = [f"w[{i}]" for i in range(b.shape[1])]
        return control.StateSpace(
            a, b, c, d, self.plant.dt, states=names, inputs=inputs,
            outputs=list(self.plant.outputs), name="preview_loop", remove_useless_states=False,
        )  # fmt: skip


def loop_matrices(design: PreviewDesign) -> tuple[Array, Array, Array, Array]:
    """Return the loop z(k+1) = A z + B w from the preview action w to y = C z + D w."""
    a, b, c, d = design.plant.A, design.plant.B, design.plant.C, design.plant.D
    n, m = b.shape
    if not design.integral:
        return a - b @ design.feedback, b, c - d @ design.feedback, d
    row = np.eye(m, n + m, n) - design.feedback
    loop = np.vstack([np.hstack([a, np.zeros((n, m))]) + b @ row, row])
    outputs = np.hstack([c, np.zeros((len(c), m))])
    if np.any(d):
        outputs = outputs + d @ row
    return loop, np.vstack([b, np.eye(m)]), outputs, d
