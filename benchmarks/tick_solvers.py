"""Other solvers of the same control tick, for `control_tick.py` to race against.

Each is a function of a filled `TickProblem` that prepares what its solver may have ready before the
tick, and returns the solve that is timed.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import daqp
import numpy as np
import osqp
import qpsolvers
import scipy.sparse as sparse

from preview_walk import Array, TickProblem

Solve = Callable[[], tuple[Array, Array]]
"""Returns accelerations and wrenches."""

Prepare = Callable[[TickProblem], Solve]

DAQP_INFINITY = 1e30


def fresh_osqp(problem: TickProblem) -> Solve:
    """Return a solve by an OSQP set up for this one tick, whose matrices are made beforehand.

    Task residuals are variables, which keeps the matrices sparse: OSQP's favourite form.
    """
    nv, nf, n, m = problem.nv, problem.nf, problem.n, problem.m
    qp: Any = problem.build()
    rest = m - 6
    prior = np.concatenate([problem.regularization_weight, np.diag(qp.P)[nv:], np.ones(rest)])
    scale = 1.0 / np.sqrt(problem.inverse_weight[:rest])
    tasks = np.zeros((rest, len(prior)))
    tasks[:, :nv] = problem.rows[:rest] * scale[:, None]
    tasks[:, nv + nf + n :] = -np.eye(rest)

    def wide(a: Array) -> Array:
        return np.hstack([a, np.zeros((len(a), rest))])

    bounds = np.isfinite(qp.ub)
    box = np.eye(len(prior))[np.flatnonzero(bounds)]
    target = problem.target[:rest] * scale
    A = sparse.csc_matrix(np.vstack([wide(qp.A), tasks, wide(qp.G), box]))
    low = np.concatenate([qp.b, target, np.full(len(qp.h), -np.inf), qp.lb[bounds]])
    high = np.concatenate([qp.b, target, qp.h, qp.ub[bounds]])
    q = np.zeros(len(prior))
    q[:nv] = -problem.regularization_weight * problem.regularization_target
    P = sparse.diags(prior, format="csc")

    def solve() -> tuple[Array, Array]:
        solver = osqp.OSQP()
        solver.setup(
            P,
            q,
            A,
            low,
            high,
            verbose=False,
            scaling=0,
            rho=0.1,
            eps_abs=1e-5,
            eps_rel=0.0,
            check_termination=5,
            max_iter=2000,
        )
        return problem.split(solver.solve(raise_error=False).x)

    return solve


class DirectDaqp:
    """The same tick, handed to daqp as one would by hand.

    Dense and small: accelerations and wrenches only, contacts as equalities, joint limits as simple
    bounds; without what makes the QP solvable in every state.
    """

    def __init__(self, problem: TickProblem) -> None:
        self.problem = problem
        p = problem
        size = p.nv + p.nf
        tasks = p.m - p.nf - 6
        self.tasks, self.contacts = slice(0, tasks), slice(tasks, tasks + p.nf)
        self.H = np.zeros((size, size))
        self.f = np.zeros(size)
        cone = p.contact_rows
        self.normal = np.flatnonzero(p.contact_low == 0.0)
        self.cone = np.flatnonzero(p.contact_low != 0.0)
        rows = 6 + p.nf + p.n + len(self.cone)
        self.A = np.zeros((rows, size))
        self.A[6 + p.nf + p.n :, p.nv :] = cone[self.cone] * p.unit / 100.0
        self.low = np.full(size + rows, -DAQP_INFINITY)
        self.high = np.full(size + rows, DAQP_INFINITY)
        self.high[size + 6 + p.nf + p.n :] = 0.0
        self.sense = np.zeros(size + rows, dtype=np.int32)
        self.sense[size : size + 6 + p.nf] = 5
        self.wrench = np.arange(p.nv, size)

    def solve(self) -> tuple[Array, Array]:
        """Fill the matrices from the problem and solve."""
        p, H, A, low, high = self.problem, self.H, self.A, self.low, self.high
        nv, nf, n, size = p.nv, p.nf, p.n, p.nv + p.nf
        rows = p.rows[self.tasks]
        weighted = rows.T / p.inverse_weight[self.tasks]
        np.matmul(weighted, rows, out=H[:nv, :nv])
        H.reshape(-1)[: nv * size : size + 1] += p.regularization_weight
        H[self.wrench, self.wrench] = p.wrench_weight * p.unit**2
        self.f[:nv] = (
            -p.regularization_weight * p.regularization_target - weighted @ p.target[self.tasks]
        )
        torque = A[6 + nf : 6 + nf + n]
        A[:6, :nv] = p.rows[-6:]
        A[:6, nv:] = -p.wrench_map * p.unit
        A[6 : 6 + nf, :nv] = p.contact_jacobian
        mass = np.triu(p.mass)
        torque[:, :nv] = (mass + np.triu(mass, 1).T)[6:]
        torque[:, nv:] = -p.contact_jacobian[:, 6:].T * p.unit
        low[6:nv], high[6:nv] = p.limits[:, n:]
        low[nv + 2 : size : 6] = 0.0
        high[nv + 2 : size : 6] = p.contact_high[self.normal] / 100.0
        low[size : size + 6] = high[size : size + 6] = p.target[-6:]
        equal = slice(size + 6, size + 6 + nf)
        low[equal] = high[equal] = p.target[self.contacts]
        limits = slice(size + 6 + nf, size + 6 + nf + n)
        low[limits], high[limits] = p.limits[:, :n] - p.bias[6:]
        x, _, flag, _ = daqp.solve(H, self.f, A, high, low, self.sense)
        if flag != 1:
            return np.full(nv, np.nan), np.full(nf, np.nan)
        return p.split(x)


def by_qpsolvers(name: str) -> Prepare:
    """Return the preparation of a backend of qpsolvers, at its default tolerances."""

    def prepare(problem: TickProblem) -> Solve:
        def solve() -> tuple[Array, Array]:
            found = qpsolvers.solve_problem(problem.build(), name)
            if not found.found or found.x is None:
                return problem.split(np.full(problem.nv + problem.nf, np.nan))
            return problem.split(found.x)

        return solve

    return prepare


def exact(problem: TickProblem) -> Solve:
    """Return the reference: the whole QP by daqp, tolerances 1e-10."""

    def solve() -> tuple[Array, Array]:
        found = qpsolvers.solve_problem(problem.build(), "daqp", primal_tol=1e-10, dual_tol=1e-10)
        assert found.x is not None
        return problem.split(found.x)

    return solve
