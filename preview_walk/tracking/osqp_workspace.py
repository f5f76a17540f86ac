"""The default solver: one persistent OSQP workspace for a problem of fixed sparsity."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import osqp

from preview_walk.tracking.problem import TickProblem
from preview_walk.types import Array


@dataclass(frozen=True, eq=False)
class Solution:
    """What a solver returned: z (n,), whether it converged, its iterations."""

    z: Array
    solved: bool
    iterations: int
    status: str


class OsqpWorkspace:
    """OSQP kept warm from tick to tick; only values change between `solve` calls."""

    def __init__(self, problem: TickProblem, max_iterations: int = 200) -> None:
        self.problem = problem
        self._solver = osqp.OSQP()
        self._max_iterations = max_iterations
        self._ready = False

    def solve(self) -> Solution:
        """Solve the problem with the values it holds now."""
        p = self.problem
        if not self._ready:
            self._solver.setup(
                p.P,
                p.q,
                p.A,
                p.lower,
                p.upper,
                verbose=False,
                scaling=0,
                rho=float(__import__("os").environ.get("RHO","1e-1")), eps_prim_inf=1e-8, eps_dual_inf=1e-8,
                eps_abs=1e-5,
                eps_rel=0.0,
                check_termination=5,
                max_iter=self._max_iterations,
                warm_starting=True,
                polishing=False,
            )
            self._ready = True
        else:
            self._solver.update(q=p.q, l=p.lower, u=p.upper, Ax=p.A.data)
        result = self._solver.solve(raise_error=False)
        info = result.info
        return Solution(np.asarray(result.x), info.status_val == 1, int(info.iter), info.status)

    def reset(self) -> None:
        """Forget the last solution."""
        if self._ready:
            self._solver.warm_start(x=np.zeros(self.problem.n), y=np.zeros(self.problem.m))
