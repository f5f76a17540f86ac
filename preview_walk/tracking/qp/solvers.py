"""The solvers of a tick's QP by name: OSQP by default, daqp, or any backend of qpsolvers."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import qpsolvers

from preview_walk.errors import InvalidInput
from preview_walk.tracking.qp.condensed_backend import CondensedBackend
from preview_walk.tracking.qp.daqp_method import DirectDaqp
from preview_walk.tracking.qp.osqp_method import WarmOsqp
from preview_walk.tracking.qp.problem import TickProblem
from preview_walk.tracking.qp.solution import Backend, Solution, unsolved

DEFAULT = "osqp"
"""Name of the persistent OSQP."""

DAQP = "daqp"
"""Name of daqp, called directly."""

TIGHT: Mapping[str, Mapping[str, Any]] = {
    "clarabel": {"tol_gap_abs": 1e-9, "tol_gap_rel": 0.0, "tol_feas": 1e-9},
    "daqp": {"primal_tol": 1e-9, "dual_tol": 1e-9},
    "piqp": {"eps_abs": 1e-9, "eps_rel": 0.0},
    "proxqp": {"eps_abs": 1e-9, "eps_rel": 0.0},
    "scs": {"eps_abs": 1e-9, "eps_rel": 0.0},
}
"""Tolerances for the backends of qpsolvers whose own are too loose for torques."""


def make_backend(name: str) -> Backend:
    """Return the backend of this name: "osqp", "daqp", or one of qpsolvers.

    Raises:
        InvalidInput: qpsolvers does not know the name or has no installed solver for it; daqp is
            not installed.
    """
    if name == DEFAULT:
        return CondensedBackend(WarmOsqp())
    if name == DAQP:
        return CondensedBackend(DirectDaqp())
    allowed = ", ".join([DEFAULT, *(n for n in qpsolvers.available_solvers if n != DEFAULT)])
    if name not in qpsolvers.available_solvers:
        raise InvalidInput(
            f"solver must be one of those installed, {allowed}, got '{name}'.", "solver"
        )
    return QpsolversBackend(name)


class QpsolversBackend:
    """Any backend of qpsolvers, on the QP that `TickProblem.build` returns."""

    def __init__(self, name: str) -> None:
        self.name = name

    def solve(self, problem: TickProblem) -> Solution:
        """See `Backend.solve`."""
        tight = dict(TIGHT.get(self.name, {}))
        result = qpsolvers.solve_problem(problem.build(), self.name, **tight)
        if not result.found or result.x is None:
            return unsolved(problem, 0, f"{self.name} found no solution")
        acceleration, wrench = problem.split(result.x)
        torques = problem.forces(acceleration, wrench)[6:]
        return Solution(acceleration, wrench, torques, True, int(result.extras.get("iter", 0)))
