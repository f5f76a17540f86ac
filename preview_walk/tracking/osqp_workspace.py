"""OSQP, kept warm from tick to tick, on the QP that `elimination` leaves.

OSQP's pace and accuracy depend on units. Here both are settled by the problem itself: variables
x = factor^T w make the Hessian the identity, and each constraint is scaled to a row of length one.
Then a fixed penalty rho near one suits every robot, posture and contact, `eps_abs` means the same
everywhere, and for any multipliers y the best x is -gradient - constraints^T y, which is where each
solve starts from.
"""

from __future__ import annotations

import numpy as np
import osqp
import scipy.sparse as sparse

from preview_walk.tracking.active_set import nearest_point
from preview_walk.tracking.elimination import Elimination, inverse_factor
from preview_walk.types import Array

INFINITY = 1e30
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

_SOLVED = int(osqp.SolverStatus.OSQP_SOLVED)


class OsqpWorkspace:
    """A persistent OSQP solver for one `Elimination`; only values change between solves.

    `iterations`: those of the last solve.
    """

    def __init__(self, elimination: Elimination, max_iterations: int) -> None:
        self.elimination = elimination
        self.iterations = 0
        rows, size = elimination.constraints.shape
        self._low: Array = np.zeros(rows)
        self._high: Array = np.zeros(rows)
        # Transposed, and thus in the order in which OSQP keeps the entries of a full matrix.
        self._constraints: Array = np.zeros((size, rows))
        self._solver = osqp.OSQP()
        self._solver.setup(
            sparse.identity(size, format="csc"),
            np.zeros(size),
            sparse.csc_matrix(np.ones((rows, size))),
            self._low,
            self._high,
            max_iter=max_iterations,
            **SETTINGS,
        )
        # The compiled solver under OSQP's Python class: for so small a QP, half the time of a call.
        self._compiled = self._solver._solver

    def solve(self, multipliers: Array) -> tuple[Array, Array] | None:
        """Return w and its multipliers (one per constraint), or None when not converged.

        `multipliers`: a guess to start from; the better, the faster.
        """
        e, compiled = self.elimination, self._compiled
        inverse = inverse_factor(e.factor)
        constraints = np.matmul(inverse, e.constraints.T, out=self._constraints)
        scale = 1.0 / np.sqrt(np.einsum("ij,ij->j", constraints, constraints))
        constraints *= scale
        np.multiply(e.low, scale, out=self._low)
        np.multiply(e.high, scale, out=self._high)
        np.maximum(self._low, -INFINITY, out=self._low)
        np.minimum(self._high, INFINITY, out=self._high)
        gradient = inverse @ e.gradient
        guess = multipliers / scale
        compiled.update_data_vec(q=gradient, l=self._low, u=self._high)
        compiled.update_data_mat(P_x=None, P_i=None, A_x=constraints.reshape(-1), A_i=None)
        compiled.warm_start(-gradient - constraints @ guess, guess)
        compiled.solve()
        info = compiled.info
        self.iterations = int(info.iter)
        solution = compiled.solution
        x, y = solution.x, solution.y
        if info.status_val != _SOLVED:
            # Nearly parallel constraints, as of a foot just landed, are beyond OSQP's patience.
            exact = nearest_point(gradient, constraints.T, self._low, self._high, y)
            if exact is None:
                return None
            x, y = exact
        return x @ inverse, y * scale
