"""The least x with rows x <= bounds, by OSQP: what the predictive servo comes down to."""

from __future__ import annotations

import numpy as np
import qpsolvers
import scipy.sparse

from preview_walk.types import Array

ROUNDS = 30
"""How often limits that a solution breaks may be added before it counts as not solved."""

TOLERANCE = 1e-7
"""A limit may be broken by this share of 1 + its size; OSQP solves to a tenth of it."""

_NOTHING = 1e-12
"""A row of this norm says that nothing that can still be done reaches its limit."""

_ENDLESS = 1e25
"""OSQP takes a bound of 1e30 for none."""


def least_norm(rows: Array, bounds: Array) -> Array | None:
    """Return the least x (n,) with rows (k, n) x <= bounds (k,), or None where there is none."""
    sizes = np.linalg.norm(rows, axis=1)
    if (sizes < _NOTHING).any() or not (np.abs(bounds) < _ENDLESS * sizes).all():
        return None
    used = np.flatnonzero(rows.any(axis=0))
    # Rows of norm one and the identity as Hessian: OSQP needs no scaling of its own.
    matrix = scipy.sparse.csc_matrix(rows[:, used] / sizes[:, None])
    problem = qpsolvers.Problem(
        scipy.sparse.identity(len(used), format="csc"), np.zeros(len(used)), matrix, bounds / sizes
    )
    solution = qpsolvers.solve_problem(
        problem, "osqp", eps_abs=0.1 * TOLERANCE, eps_rel=0.1 * TOLERANCE, max_iter=20_000,
        polishing=True, scaling=0,
    )  # fmt: skip
    if not solution.found or solution.x is None:
        return None
    whole = np.zeros(rows.shape[1])
    whole[used] = solution.x
    return whole
