"""OSQP, kept warm from tick to tick, on the QP that condensing leaves.

OSQP's pace and accuracy depend on units. Here both are settled by the problem itself: variables
x = factor^T w make the Hessian the identity, and each constraint is scaled to a row of length one.
Then a fixed penalty rho suits every robot, posture and contact, `eps_abs` means the same
everywhere, and for any multipliers y the best x is -gradient - constraints^T y.

A solve starts from the point that belongs to the constraints that were active a tick ago. Where
they still are, OSQP has only to confirm it. Where others have become active, its first iterations
find out which, and it is their last digits that would cost it hundreds more: so its iterates are
polished, and a polished one that obeys all conditions of optimality is the answer.
"""

from __future__ import annotations

from functools import cache
from typing import Any, NamedTuple

import numpy as np
import osqp
import scipy.sparse as sparse

from preview_walk.tracking.qp.active_set import polish
from preview_walk.tracking.qp.condensing import UNBOUNDED, NearestPoint
from preview_walk.types import Array

_SOLVED = int(osqp.SolverStatus.OSQP_SOLVED)

SETTINGS = {
    "rho": 2.0,
    "adaptive_rho": False,
    "scaling": 0,
    "eps_abs": 1e-6,
    "eps_rel": 0.0,
    # The QP always has a solution: whatever looks infeasible has not converged yet.
    "eps_prim_inf": 1e-12,
    "eps_dual_inf": 1e-12,
    "check_termination": 1,
    # The gap is a product of large numbers, whose rounding alone may exceed `eps_abs`.
    "check_dualgap": False,
    "warm_starting": True,
    # Not OSQP's own: it begins only at `eps_abs`, and goes unchecked.
    "polishing": False,
    "verbose": False,
}


class Answer(NamedTuple):
    """What OSQP found: a point, its multipliers, the iterations, and whether they are optimal."""

    x: Array
    multipliers: Array
    iterations: int
    optimal: bool


class OsqpWorkspace:
    """A persistent OSQP for all QPs of at most so many constraints and variables.

    Only values change between solves; what a smaller QP leaves unused is zero.
    `size`: the most variables.
    """

    def __init__(self, count: int, size: int, *, burst: int) -> None:
        """Set OSQP up.

        Args:
            count: constraints.
            size: variables.
            burst: iterations between two trials of polishing.
        """
        self.size = size
        self._shape = (count, size)
        self._room = NearestPoint(count, size)
        self._used = (0, 0)
        self._solver = _set_up(count, size, burst)

    def solve(self, qp: NearestPoint, guess: Array | None, bursts: int) -> Answer:
        """Return what OSQP finds in so many bursts of iterations.

        `guess`: multipliers, one per constraint, or None for zeros; where they name the right
        constraints, OSQP has only to confirm them.
        """
        solver, (m, n) = self._solver, qp.rows.shape
        to = qp if (m, n) == self._shape else self._padded(qp)
        solver.update_data_vec(q=to.gradient, l=to.low, u=to.high)
        solver.update_data_mat(P_x=None, P_i=None, A_x=to.rows.T.reshape(-1), A_i=None)
        x, y = np.zeros(self._shape[1]), np.zeros(self._shape[0])
        if guess is None:
            np.negative(qp.gradient, out=x[:n])
        else:
            x[:n], y[:m], _ = polish(qp.gradient, qp.rows, qp.low, qp.high, guess)
        solver.warm_start(x, y)
        iterations = 0
        for _ in range(bursts):
            solver.solve()
            info, found = solver.info, solver.solution
            iterations += info.iter
            x, y = found.x[:n], found.y[:m]
            if info.status_val == _SOLVED:
                return Answer(x, y, iterations, True)
            polished = polish(qp.gradient, qp.rows, qp.low, qp.high, y)
            if polished.optimal:
                return Answer(polished.x, polished.multipliers, iterations, True)
        return Answer(x, y, iterations, False)

    def _padded(self, qp: NearestPoint) -> NearestPoint:
        """Return a QP in the size of the workspace, with zeros for what it does not use."""
        to, (m, n) = self._room, qp.rows.shape
        if self._used != (m, n):
            self._used = (m, n)
            to.gradient.fill(0.0)
            to.rows.fill(0.0)
            # Not zero: equal bounds would make OSQP take unused rows for equalities.
            to.low.fill(-1.0)
            to.high.fill(1.0)
        to.gradient[:n], to.rows[:m, :n] = qp.gradient, qp.rows
        to.low[:m], to.high[:m] = qp.low, qp.high
        return to


def _set_up(count: int, size: int, burst: int) -> Any:
    """Return OSQP's solver object, without the layer of Python around it.

    That layer costs more than the solve: it looks up modules and builds a record of all results at
    each call. The classes underneath are those that it uses itself.
    """
    ext = _extension()
    settings = ext.OSQPSettings()
    ext.osqp_set_default_settings(settings)
    for name, value in SETTINGS.items():
        setattr(settings, name, value)
    settings.max_iter = burst
    return ext.OSQPSolver(
        ext.CSC(sparse.identity(size, format="csc")),
        np.zeros(size),
        ext.CSC(sparse.csc_matrix(np.ones((count, size)))),
        np.full(count, -UNBOUNDED),
        np.full(count, UNBOUNDED),
        count,
        size,
        settings,
    )


@cache
def _extension() -> Any:
    return osqp.OSQP(algebra="builtin").ext
