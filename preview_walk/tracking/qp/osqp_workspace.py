"""OSQP, kept warm from tick to tick, on the QP that `elimination` leaves.

OSQP's pace and accuracy depend on units. Here both are settled by the problem itself: variables
x = factor^T w make the Hessian the identity, and each constraint is scaled to a row of length one.
Then a fixed penalty rho near one suits every robot, posture and contact, `eps_abs` means the same
everywhere, and for any multipliers y the best x is -gradient - constraints^T y, which is where each
solve starts from.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import osqp
import scipy.sparse as sparse

from preview_walk.tracking.qp.active_set import nearest_point
from preview_walk.tracking.qp.condensing import CondensedQP, inverse_factor
from preview_walk.types import Array

INFINITY = osqp.constant("OSQP_INFTY")
"""What OSQP takes for an infinite bound."""

SETTINGS = {
    "rho": 0.5,
    "adaptive_rho": False,
    "scaling": 0,
    "eps_abs": 1e-6,
    "eps_rel": 0.0,
    # The QP always has a solution: whatever looks infeasible has not converged yet.
    "eps_prim_inf": 1e-12,
    "eps_dual_inf": 1e-12,
    "check_termination": 5,
    "warm_starting": True,
    "polishing": False,
    "verbose": False,
}


class OsqpWorkspace:
    """A persistent OSQP solver for one `CondensedQP`; only values change between solves.

    `iterations`: those of the last solve.
    """

    def __init__(self, elimination: CondensedQP, max_iterations: int) -> None:
        self.elimination = elimination
        self.iterations = 0
        rows, size = elimination.constraints.shape
        self._low: Array = np.full(rows, -INFINITY)
        self._high: Array = np.full(rows, INFINITY)
        # Transposed, and thus in the order in which OSQP keeps the entries of a full matrix.
        self._constraints: Array = np.zeros((size, rows))
        self._max_iterations = max_iterations
        self._solver: Any = None  # set up when first needed: most ticks do not

    def _set_up(self) -> Any:
        size, rows = self._constraints.shape
        solver = osqp.OSQP()
        solver.setup(
            sparse.identity(size, format="csc"),
            np.zeros(size),
            sparse.csc_matrix(np.ones((rows, size))),
            self._low,
            self._high,
            max_iter=self._max_iterations,
            **SETTINGS,
        )
        return solver

    def solve(self, multipliers: Array) -> tuple[Array, Array] | None:
        """Return w and its multipliers (one per constraint), or None when not converged.

        `multipliers`: a guess to start from; the better, the faster.
        """
        if self._solver is None:
            self._solver = self._set_up()
        e, solver = self.elimination, self._solver
        inverse = inverse_factor(e.factor)
        constraints = np.matmul(inverse, e.constraints.T, out=self._constraints)
        scale = 1.0 / np.sqrt(np.einsum("ij,ij->j", constraints, constraints))
        constraints *= scale
        np.multiply(e.low, scale, out=self._low)
        np.multiply(e.high, scale, out=self._high)
        gradient = inverse @ e.gradient
        guess = multipliers / scale
        solver.update(q=gradient, l=self._low, u=self._high, Ax=constraints.reshape(-1))
        solver.warm_start(-gradient - constraints @ guess, guess)
        result = solver.solve(raise_error=False)
        self.iterations = int(result.info.iter)
        x, y = result.x, result.y
        if result.info.status_val != osqp.SolverStatus.OSQP_SOLVED:
            # Nearly parallel constraints, as of a foot just landed, are beyond OSQP's patience.
            exact = nearest_point(gradient, constraints.T, self._low, self._high, y)
            if exact is None:
                return None
            x, y = exact
        return x @ inverse, y * scale
