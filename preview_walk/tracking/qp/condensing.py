"""The tick's QP without its accelerations: exact, and a fifth of the size.

All rows of the QP that bind the accelerations a read `rows @ a = target + map @ w`, each with its
inverse weight, where w holds the wrenches f and, for each joint limit of the *working set*, the
value u that this torque or acceleration takes. For any w the best a follows from

    K = rows D^-1 rows^T + inverse weights = L L^T,    a = a0 + D^-1 rows^T K^-1 (residual + map w)

(D: regularisation weights; residual = target - rows @ a0, a0 what the regularisation draws to), and
the cost that is left is |L^-1 (residual + map w)|^2 / 2 + wrench weight |f|^2 / 2. Only the last
rows (base and working set) have a map, so L's last corner alone makes the Hessian in w. Base rows
have no inverse weight: any w, even a poor one, comes with accelerations that obey Newton and Euler
to machine precision.

Joint limits are rarely reached, so they enter only once they have been: the solution without a
limit that it obeys is the solution with it. Last, variables x = factor^T w and rows of length one
make the QP that of the nearest point of a polyhedron, which any solver finds at its best.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from scipy.linalg.blas import dtrsm, dtrsv
from scipy.linalg.lapack import dpotrf, dpotrs

from preview_walk.tracking.qp.problem import LIMIT_WEIGHT, TickProblem
from preview_walk.types import Array

TOLERANCE = 1e-7
"""Amount (N, N·m, rad/s^2) by which the solution may cross a constraint that it does not know."""

UNBOUNDED = 1e40
"""Bound of a constraint without one: finite, so that zero times it is zero, and beyond what OSQP
and daqp take for infinite (1e26, 1e30) in any unit."""


class NotSolvable(ArithmeticError):
    """The values of a problem are not finite, or its rows contradict each other."""


class NearestPoint:
    """A QP in x = factor^T w, which makes its Hessian the identity.

        minimise |x + gradient|^2 / 2  subject to  low <= rows @ x <= high

    Attributes:
        gradient: (n,).
        rows: (m, n) in Fortran's order, each of length one.
        low, high: (m,); finite, see `UNBOUNDED`.
        length: (m,) of the rows of the constraints before.
    """

    def __init__(self, count: int, size: int) -> None:
        self.gradient: Array = np.zeros(size)
        self.rows: Array = np.zeros((count, size), order="F")
        self.low, self.high, self.length = np.zeros(count), np.zeros(count), np.zeros(count)


class CondensedQP:
    """The QP in w = [f; u] of a `TickProblem`, for a fixed working set of limits.

        minimise |factor^T w|^2 / 2 + gradient @ w  subject to  low <= constraints @ w <= high

    Attributes:
        problem: the tick's QP.
        working_set: columns of `TickProblem.limits`: torques first, then accelerations.
        constraints, low, high: (k, size), (k,), (k,).
        factor, gradient: (size, size) lower triangular, (size,); valid after `reduce`.
        nearest: the same QP as `normalise` writes it.
        acceleration, torques: (nv,), (n,); valid after `expand`.
    """

    def __init__(self, problem: TickProblem, working_set: Sequence[int]) -> None:
        self.problem = problem
        self.working_set = tuple(working_set)
        p, k = problem, len(self.working_set)
        self._indices = np.array(self.working_set, dtype=int)
        self._dofs = 6 + self._indices[self._indices < p.n]  # whose torque is limited
        self._below = np.arange(p.nv) < self._dofs[:, None]
        self.size = p.nf + k
        self._tail = 6 + k
        m = p.m + k
        scale = 1.0 / np.sqrt(p.regularization_weight)
        self._scale = scale
        self._rows = np.zeros((m, p.nv))
        self._scaled = np.zeros((m, p.nv))
        self._residual = np.zeros(m)
        self._inverse_weight = np.zeros(m)
        self._matrix = np.zeros((m, m))
        self._diagonal = self._matrix.reshape(-1)[:: m + 1]
        self._map = np.zeros((self._tail, self.size), order="F")
        for at, i in enumerate(self.working_set):
            self._map[6 + at, p.nf + at] = 1.0
            if i >= p.n:
                self._rows[p.m + at, 6 + i - p.n] = 1.0
                self._inverse_weight[p.m + at] = 1.0 / LIMIT_WEIGHT
        self.constraints = np.zeros((len(p.contact_rows) + k, self.size), order="F")
        self.constraints[: len(p.contact_rows), : p.nf] = p.contact_rows
        self.constraints[len(p.contact_rows) :, p.nf :] = np.eye(k)
        self.low = np.concatenate([np.maximum(p.contact_low, -UNBOUNDED), np.zeros(k)])
        self.high = np.concatenate([np.minimum(p.contact_high, UNBOUNDED), np.zeros(k)])
        self.factor: Array = np.zeros((self.size, self.size))
        self.gradient: Array = np.zeros(self.size)
        self.acceleration: Array = np.zeros(p.nv)
        self._values: Array = np.zeros(2 * p.n)
        self.torques = self._values[: p.n]
        self._excess = np.zeros((2, 2 * p.n))
        self.nearest = NearestPoint(*self.constraints.shape)

    def reduce(self) -> None:
        """Eliminate the accelerations at the problem's current values.

        Raises:
            NotSolvable: they are not finite.
        """
        p, m = self.problem, self.problem.m
        rows, residual = self._rows, self._residual
        rows[:m] = p.rows
        residual[:m] = p.target
        self._inverse_weight[:m] = p.inverse_weight
        self._map[:6, : p.nf] = p.wrench_map
        if self.working_set:
            self._reduce_working_set()
        residual -= rows @ p.regularization_target
        np.multiply(rows, self._scale, out=self._scaled)
        np.matmul(self._scaled, self._scaled.T, out=self._matrix)
        self._diagonal += self._inverse_weight
        self._lower = _cholesky(self._matrix)
        self._solved = dtrsv(self._lower, residual, lower=1)
        corner = self._lower[-self._tail :, -self._tail :]
        # Not dtrtrs: OpenBLAS starts threads for it, which wait for each other longer than a tick.
        self._response = dtrsm(1.0, corner, self._map, lower=1) if self.size else self._map
        hessian = self._response.T @ self._response
        hessian.reshape(-1)[: p.nf * self.size : self.size + 1] += p.wrench_weight
        self.factor = _cholesky(hessian)
        self.gradient = self._solved[-self._tail :] @ self._response
        np.minimum(p.contact_high, UNBOUNDED, out=self.high[: len(p.contact_high)])

    def _reduce_working_set(self) -> None:
        """Write the rows, map and bounds of the limits of the working set."""
        p, at, dofs = self.problem, self.problem.m, self._dofs
        end = at + len(dofs)
        # Only the upper triangle of the mass matrix is promised, as `Dynamics` says.
        self._rows[at:end] = np.where(self._below, p.mass[:, dofs].T, p.mass[dofs])
        np.negative(p.bias[dofs], out=self._residual[at:end])
        self._residual[end:] = 0.0
        self._map[6 : 6 + len(dofs), : p.nf] = p.contact_jacobian[:, dofs].T
        at = len(p.contact_low)
        self.low[at:], self.high[at:] = p.limits[:, self._indices]

    def free(self) -> Array | None:
        """Return the minimiser w without constraints, or None when it does not obey them."""
        if not self.size:
            return self.gradient
        w: Array = dpotrs(self.factor, self.gradient, lower=1)[0]
        np.negative(w, out=w)
        values = self.constraints @ w
        if (values <= self.high).all() and (values >= self.low).all():
            return w
        if not np.isfinite(values).all():
            raise NotSolvable("the values of the QP are not finite")
        return None

    def normalise(self) -> NearestPoint:
        """Return the reduced QP with the identity for its Hessian and rows of length one."""
        to, factor = self.nearest, self.factor
        rows = dtrsm(1.0, factor, self.constraints, side=1, lower=1, trans_a=1)
        length = np.sqrt(np.einsum("ij,ij->i", rows, rows))
        np.divide(rows.T, length, out=rows.T)
        np.divide(self.low, length, out=to.low)
        np.divide(self.high, length, out=to.high)
        to.gradient = dtrsv(factor, self.gradient, lower=1)
        to.rows, to.length = rows, length
        return to

    def original(self, x: Array) -> Array:
        """Return the w of an x of `nearest`."""
        w: Array = dtrsv(self.factor, x, lower=1, trans=1)
        return w

    def expand(self, w: Array) -> None:
        """Recover `acceleration` and `torques` of a solution w."""
        p = self.problem
        solved = self._solved.copy()
        solved[-self._tail :] += self._response @ w
        multipliers = dtrsv(self._lower, solved, lower=1, trans=1)
        acceleration = multipliers @ self._scaled
        acceleration *= self._scale
        acceleration += p.regularization_target
        self.acceleration = acceleration
        self._values[: p.n] = p.forces(acceleration, w[: p.nf])[6:]
        self._values[p.n :] = acceleration[6:]

    def crossed(self) -> list[int]:
        """Return the limits that the expanded solution crosses and that the working set lacks.

        Raises:
            NotSolvable: the solution is not finite.
        """
        excess = np.subtract(self._values, self.problem.limits, out=self._excess)
        np.negative(excess[0], out=excess[0])
        worst = excess.max()
        if worst <= TOLERANCE:
            return []
        if not worst < np.inf:
            raise NotSolvable("the solution is not finite")
        over = np.flatnonzero(excess.max(axis=0) > TOLERANCE)
        return [i for i in over.tolist() if i not in self.working_set]


def _cholesky(matrix: Array) -> Array:
    """Return the lower Cholesky factor, in the lower triangle, of a symmetric C-ordered matrix."""
    if not matrix.size:
        return matrix
    factor, info = dpotrf(matrix.T, lower=1, clean=1, overwrite_a=1)
    if info != 0:
        raise NotSolvable("the rows of the QP are not finite or contradict each other")
    return np.asarray(factor)
