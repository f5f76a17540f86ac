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

Direct feedthrough, previewed disturbances, more outputs than inputs and the servo without integral
action follow the same lines: docs/preview-control.md derives them all.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from preview_walk.arguments import shown
from preview_walk.errors import InvalidInput
from preview_walk.preview.checks import computable
from preview_walk.preview.design import PreviewDesign
from preview_walk.preview.horizon import check_horizon, samples, slow_mode, warn_if_short
from preview_walk.preview.plant import Linear, Plant, read_plant
from preview_walk.preview.problem import (
    Weights,
    error_augmented,
    positional,
    require_stabilisable,
)
from preview_walk.preview.receding import receding_horizon
from preview_walk.preview.riccati import Law, solve_riccati
from preview_walk.preview.unreachable import solve_reachable
from preview_walk.preview.weights import weight_matrix
from preview_walk.types import Array


def preview_gains(
    system: Linear,
    Q_e: ArrayLike,
    Q_x: ArrayLike,
    R: ArrayLike,
    N: float,
    *,
    E: ArrayLike | None = None,
    dt: float | None = None,
    integral: bool = True,
    final_cost: ArrayLike | None = None,
) -> PreviewDesign:
    """Design the optimal preview servo of a linear system.

    Args:
        system: Plant with n states, m inputs and p outputs: a `control.StateSpace` or
            `control.TransferFunction`, (A, B, C, D) of a discrete-time plant, or (A, B, C, D, dt).
        Q_e: (p, p) weight of the tracking error, symmetric and positive semidefinite; (p,) stands
            for its diagonal and a scalar for that multiple of the identity, here and below.
        Q_x: (n, n) weight of the state increment, symmetric and positive semidefinite.
        R: (m, m) weight of the input increment, symmetric and positive definite.
        N: Preview horizon in samples; 0 is a servo without preview, `math.inf` one that sees all
            that numbers can tell from nothing.
        E: (n, q) matrix of disturbances that are previewed too; (n,) for one.
        dt: Sampling time (s) at which a continuous-time plant is discretised.
        integral: Whether the servo has integral action. Without, Q_x weights the state and R the
            input, and the servo knows by the model alone what holds an output.
        final_cost: Weight of X = [e; dx] N samples ahead, (p + n, p + n), in place of all that
            comes after: the first step of the N-step optimum, taken anew at each sample.

    Returns:
        The gains and everything they were made from.

    Raises:
        InvalidInput: If a shape or a weight cannot be or no stabilising servo exists.

    Warns:
        ShortHorizonWarning: If the horizon is shorter than `horizon.MIN_TIME_CONSTANTS` time
            constants of the slow mode of the gains.

    """
    with computable("system"):
        plant = read_plant(system, dt, E)
        weights = Weights(
            weight_matrix("Q_e", Q_e, len(plant.C)),
            weight_matrix("Q_x", Q_x, len(plant.A)),
            weight_matrix("R", R, plant.B.shape[1], definite=True),
        )
        horizon = check_horizon(N)
        require_stabilisable(plant)
        if not isinstance(integral, bool | np.bool_):
            raise InvalidInput(
                f"expected integral to be True or False, got {shown(integral)}.",
                argument="integral",
            )
        if final_cost is not None:
            if not integral:
                raise InvalidInput(
                    "expected final_cost for a servo with integral action only, got "
                    "integral=False.",
                    argument="final_cost",
                )
            final = weight_matrix("final_cost", final_cost, len(plant.C) + len(plant.A))
            return _usable(receding_horizon(plant, weights, final, horizon))
        design = _usable(_of_all_time(plant, weights, horizon, bool(integral)))
    warn_if_short(design.horizon, design.slow_mode, design.dt, stacklevel=2)
    return design


def _of_all_time(plant: Plant, weights: Weights, horizon: float, integral: bool) -> PreviewDesign:
    """Return the servo that minimises the cost of all samples to come."""
    p = len(plant.C)
    if integral:
        law = solve_reachable(error_augmented(plant, weights), p)
        columns = -law.riccati[:, :p], law.riccati @ np.vstack([plant.C @ plant.E, plant.E])
        own = law.gain[:, :p].copy()
    else:
        law = solve_riccati(positional(plant, weights))
        columns = _held_reference(plant, weights, law), law.riccati @ plant.E
        own = _reference_gain(plant, weights, law, columns[0])
    slow = slow_mode(law.closed, law.left, np.hstack(columns))
    count = samples(horizon, slow, len(law.closed))
    return PreviewDesign(
        plant, weights.Q_e, weights.Q_x, weights.R,
        own, law.gain[:, p:].copy() if integral else law.gain,
        _decaying(law, columns[0], count), law.riccati, law.closed, law.residual, slow,
        _decaying(law, columns[1], count), integral,
    )  # fmt: skip


def _usable(design: PreviewDesign) -> PreviewDesign:
    """Return a design whose law as a window can be formed, or refuse its weights."""
    try:
        parts = design.feedback, design.window_gain, design.disturbance_window_gain
        usable = all(np.isfinite(part).all() for part in parts)
    except np.linalg.LinAlgError:
        usable = False
    if not usable:
        raise InvalidInput(
            "expected weights whose gains can be computed, got R + G' P G singular to rounding.",
            argument="R",
        )
    return design


def _decaying(law: Law, column: Array, count: int) -> Array:
    """Return the gains W G' (A_c')^l column for l = 0 to count - 1."""
    gains = np.empty((count, len(law.left), column.shape[1]))
    for row in gains:
        row[:] = law.left @ column
        column = law.closed.T @ column
    return gains


def _held_reference(plant: Plant, weights: Weights, law: Law) -> Array:
    """Return what a step of the reference, held for ever, adds to the costate of x.

    The costate s(k) = A_c' s(k+1) + C_c' Q_e r(k), C_c = C - D K, is then a geometric sum.
    """
    seen = (plant.C - plant.D @ law.gain).T @ weights.Q_e
    return np.asarray(-np.linalg.solve(np.eye(len(law.closed)) - law.closed.T, seen))


def _reference_gain(plant: Plant, weights: Weights, law: Law, column: Array) -> Array:
    """Return G_I without integral action: the input that a constant reference asks for."""
    gain = -law.left @ column
    if np.any(plant.D):
        inner = weights.R + plant.D.T @ weights.Q_e @ plant.D + plant.B.T @ law.riccati @ plant.B
        gain = gain + np.linalg.solve(inner, plant.D.T @ weights.Q_e)
    return gain
