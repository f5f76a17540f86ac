r"""Preview servo control of any discrete-time linear system, in the manner of `control.dlqr`.

For a plant x(k+1) = A x(k) + B u(k), y(k) = C x(k) with n states, m inputs and p outputs whose
reference r is known N samples ahead, with e = y - r, dx(k) = x(k) - x(k-1) and du alike,

    J = sum_k  e(k)' Q_e e(k) + dx(k)' Q_x dx(k) + du(k)' R du(k)

is least under the law

    du(k) = -G_I e(k) - G_x dx(k) - sum_{l=1..N} G_d(l) (r(k+l) - r(k+l-1))

(Katayama, Ohki, Inoue and Kato, "Design of an optimal controller for a discrete-time system
subject to previewable demand", Int. J. Control 41(3), 1985). Past its window the reference is
taken to hold its last value. Summed from rest it reads u(k) = -G_I sum e - G_x x(k) - sum_l G_d(l)
r(k+l), the form that Kajita et al. (ICRA 2003, preview control section) print.

The gains follow from the error-augmented system X = [e; dx],

    X(k+1) = Phi X(k) + G du(k) + I_r dr(k+1),
    Phi = [I  C A; 0  A],   G = [C B; B],   I_r = [-I; 0],

and the stabilising solution P of its Riccati equation with diag(Q_e, Q_x) and R:

    [G_I  G_x] = W G' P Phi,   W = (R + G' P G)^-1,   A_c = Phi - G [G_I  G_x],
    G_d(l) = W G' (A_c')^(l-1) P I_r,   hence G_d(1) = -G_I.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import control
import numpy as np
from numpy.typing import ArrayLike

from preview_walk.errors import InvalidInput
from preview_walk.types import Array

MIN_TIME_CONSTANTS = 2.0
"""A preview horizon must cover this many time constants of the slowest mode of its gains."""

_RANK_TOLERANCE, _RESIDUAL_TOLERANCE, _SHARE_TOLERANCE = 1e-10, 1e-8, 1e-8


@dataclass(frozen=True, eq=False)
class PreviewDesign:
    """The result of `preview_gains`; all arrays are read-only.

    Attributes:
        system: The plant: n states, m inputs, p outputs.
        Q_e: (p, p) weight of the tracking error e = y - r.
        Q_x: (n, n) weight of the state increment dx.
        R: (m, m) weight of the input increment du.
        integral_gain: (m, p) G_I.
        state_gain: (m, n) G_x.
        preview_gain: (N, m, p) G_d; row l - 1 is for the reference l samples ahead.
        riccati: (p + n, p + n) P of the error-augmented system.
        closed_loop_matrix: (p + n, p + n) A_c of X = [e; dx]; all eigenvalues inside the circle.
        residual: Largest entry of the Riccati equation's residual over the largest entry of P.
        slow_mode: Largest modulus of a mode of A_c in the preview gains: they decay with it.

    """

    system: control.StateSpace
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

    def __post_init__(self) -> None:
        for value in vars(self).values():
            if isinstance(value, np.ndarray):
                _read_only(value)

    @property
    def dt(self) -> float:
        """Sampling time (s)."""
        return float(self.system.dt)

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
        """(N, m, p) F, the preview law in terms of the reference itself.

        du(k) = -feedback [x(k); u(k-1)] + sum_{l=1..N} F(l) r(k+l), with F(l) = G_d(l+1) - G_d(l)
        and F(N) = -G_d(N). They sum to G_I; r(k) drops out because G_d(1) = -G_I.
        """
        return _read_only(np.diff(self.preview_gain, axis=0, append=0.0))

    @cached_property
    def feedback(self) -> Array:
        """(m, n + m) gain on [x(k); u(k-1)], which know all that e(k), dx(k) and r(k) would add.

        G_x = M A for an M = W G' P [C; I], so G_x x(k-1) = M (x(k) - B u(k-1)): no x(k-1) has
        to be remembered or, at the start of a run, invented.
        """
        a, b, c = self.system.A, self.system.B, self.system.C
        lift = np.vstack([c, np.eye(len(a))])
        weighted = (lift @ b).T @ self.riccati @ lift
        m = np.linalg.solve(self.R + weighted @ b, weighted)
        return _read_only(np.hstack([self.integral_gain @ c + m @ (a - np.eye(len(a))), m @ b]))

    @cached_property
    def closed_loop(self) -> control.StateSpace:
        """The servo loop from the preview action w(k) = sum_l F(l) r(k+l) (m) to the output (p).

        Its states are [x(k); u(k-1)]; when m = p its poles are the eigenvalues of A_c. A constant
        w = G_I r leads to y = r.
        """
        a, b, c = self.system.A, self.system.B, self.system.C
        n, m = b.shape
        input_row = np.eye(m, n + m, n) - self.feedback
        return control.StateSpace(
            np.vstack([np.hstack([a, np.zeros((n, m))]) + b @ input_row, input_row]),
            np.vstack([b, np.eye(m)]),
            np.hstack([c, np.zeros((len(c), m))]),
            np.zeros((len(c), m)),
            self.dt,
            states=self.system.state_labels + [f"{u}_previous" for u in self.system.input_labels],
            inputs=[f"w[{i}]" for i in range(m)],
            outputs=self.system.output_labels,
            name="preview_loop",
        )


def preview_gains(
    system: control.StateSpace, Q_e: ArrayLike, Q_x: ArrayLike, R: ArrayLike, N: int
) -> PreviewDesign:
    """Design the optimal preview servo of a discrete-time linear system.

    Args:
        system: Plant with a sampling time in seconds and no direct feedthrough (D = 0).
        Q_e: (p, p) weight of the tracking error, symmetric and positive semidefinite; a scalar
            stands for that multiple of the identity, here and below.
        Q_x: (n, n) weight of the state increment, symmetric and positive semidefinite.
        R: (m, m) weight of the input increment, symmetric and positive definite.
        N: Preview horizon in samples.

    Returns:
        The gains and everything they were made from.

    Raises:
        InvalidInput: If a shape or a weight cannot be, if no stabilising servo exists, or if the
            horizon is shorter than `MIN_TIME_CONSTANTS` time constants of the slow mode.

    """
    _check_system(system)
    n, m, p = system.nstates, system.ninputs, system.noutputs
    q_e, q_x, r = _weight("Q_e", Q_e, p), _weight("Q_x", Q_x, n), _weight("R", R, m, definite=True)
    if isinstance(N, bool) or not isinstance(N, int | np.integer) or N < 1:
        raise InvalidInput(f"expected the horizon N to be a whole number of samples >= 1, got {N}.")

    a, b, c = system.A, system.B, system.C
    phi = np.block([[np.eye(p), c @ a], [np.zeros((n, p)), a]])
    g = np.vstack([c @ b, b])
    q = np.block([[q_e, np.zeros((p, n))], [np.zeros((n, p)), q_x]])
    _check_solvable(a, b, phi, g, q)

    try:
        riccati = np.asarray(control.dare(phi, g, q, r)[0], dtype=float)
        riccati = (riccati + riccati.T) / 2.0
        left = np.linalg.solve(r + g.T @ riccati @ g, g.T)
        gain = left @ riccati @ phi
    except (np.linalg.LinAlgError, control.ControlArgument) as error:
        raise InvalidInput(f"found no solution of the Riccati equation: {error}.") from error
    closed = phi - g @ gain
    defect = phi.T @ riccati @ closed - riccati + q
    residual = float(np.abs(defect).max() / np.abs(riccati).max())
    radius = float(np.abs(np.linalg.eigvals(closed)).max())
    if not (residual < _RESIDUAL_TOLERANCE and radius < 1.0):
        raise InvalidInput(
            "expected a Riccati equation with a stabilising solution, got one with a relative "
            f"residual of {residual:.1e} and a closed loop of spectral radius {radius:.9f}."
        )

    column = -riccati[:, :p]
    slow = _slow_mode(closed, left, column)
    _check_horizon(N, slow, system.dt)
    preview = np.empty((N, m, p))
    for row in preview:
        row[:] = left @ column
        column = closed.T @ column
    integral, state = gain[:, :p].copy(), gain[:, p:].copy()
    return PreviewDesign(
        system, q_e, q_x, r, integral, state, preview, riccati, closed, residual, slow
    )


def _read_only(array: Array) -> Array:
    array.flags.writeable = False
    return array


def _check_system(system: control.StateSpace) -> None:
    if not isinstance(system, control.StateSpace):
        raise InvalidInput(f"expected a control.StateSpace, got a {type(system).__name__}.")
    if isinstance(system.dt, bool) or system.dt is None or not system.dt > 0.0:
        raise InvalidInput(
            "expected a discrete-time system with a sampling time in seconds, got "
            f"dt = {system.dt}; control.c2d(system, dt) makes one."
        )
    if not all(np.isfinite(part).all() for part in (system.A, system.B, system.C, system.D)):
        raise InvalidInput("expected finite system matrices, got NaN or infinity in A, B, C or D.")
    if np.any(system.D):
        raise InvalidInput("expected a system with D = 0, got a direct feedthrough.")


def _weight(name: str, value: ArrayLike, size: int, definite: bool = False) -> Array:
    weight = np.array(value, dtype=float)
    if weight.ndim == 0:
        weight = weight * np.eye(size)
    if weight.shape != (size, size):
        raise InvalidInput(
            f"expected {name} to be a scalar or of shape ({size}, {size}), got shape "
            f"{weight.shape}."
        )
    if not np.isfinite(weight).all():
        raise InvalidInput(f"expected {name} to be finite, got NaN or infinity.")
    largest = np.abs(weight).max()
    if np.abs(weight - weight.T).max() > 1e-12 * largest:
        raise InvalidInput(f"expected {name} to be symmetric, got an asymmetric matrix.")
    smallest = float(np.linalg.eigvalsh(weight)[0])
    if smallest < -1e-12 * largest or (definite and smallest <= 0.0):
        kind = "definite" if definite else "semidefinite"
        raise InvalidInput(
            f"expected {name} to be positive {kind}, got a smallest eigenvalue of {smallest:.3g}."
        )
    return weight


def _lost_mode(a: Array, b: Array) -> str | None:
    """Return a mode on or outside the unit circle that b does not reach (Hautus), or None."""
    smallest = _RANK_TOLERANCE * max(1.0, float(np.abs(a).max()))
    b = b / max(float(np.abs(b).max()), np.finfo(float).tiny)
    for mode in np.linalg.eigvals(a):
        pencil = np.hstack([a - mode * np.eye(len(a)), b])
        if abs(mode) >= 1.0 - 1e-9 and np.linalg.svd(pencil)[1][-1] < smallest:
            return f"z = {mode.real:.6g}" if mode.imag == 0.0 else f"z = {mode:.6g}"
    return None


def _check_solvable(a: Array, b: Array, phi: Array, g: Array, q: Array) -> None:
    mode = _lost_mode(a, b)
    if mode is not None:
        raise InvalidInput(
            f"expected a stabilisable system, got a mode at {mode} that the input does not reach."
        )
    if _lost_mode(phi, g) is not None:
        raise InvalidInput(
            "expected outputs that can all be held at any constant value, got "
            f"{len(phi) - len(a)} outputs and {b.shape[1]} inputs with [A - I, B; C, 0] not of "
            "full row rank: a zero at z = 1, dependent outputs or too few inputs."
        )
    mode = _lost_mode(phi.T, q)
    if mode is not None:
        raise InvalidInput(
            "expected weights Q_e and Q_x that make the system detectable, got a mode at "
            f"{mode} that they do not see."
        )


def _slow_mode(closed: Array, left: Array, column: Array) -> float:
    """Return the largest modulus among the modes that the gains left (A_c')^l column contain."""
    values, vectors = np.linalg.eig(closed.T)
    try:
        shares = np.abs(np.linalg.solve(vectors, column)).max(axis=1)
    except np.linalg.LinAlgError:  # defective: count every mode
        return float(np.abs(values).max())
    shares *= np.abs(left @ vectors).max(axis=0)
    present = shares > _SHARE_TOLERANCE * np.abs(left @ column).max()
    return float(np.abs(values[present]).max(initial=0.0))


def _check_horizon(horizon: int, slow: float, dt: float) -> None:
    constant = -dt / math.log(slow) if slow > 0.0 else 0.0
    shortest = math.ceil(MIN_TIME_CONSTANTS * constant / dt)
    if horizon < shortest:
        raise InvalidInput(
            f"expected a preview horizon of at least {shortest} samples ({shortest * dt:.4g} s), "
            f"{MIN_TIME_CONSTANTS:g} time constants of the closed loop's slow mode "
            f"({constant:.3g} s), got {horizon} samples ({horizon * dt:.4g} s)."
        )
