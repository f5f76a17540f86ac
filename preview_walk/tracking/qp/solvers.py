"""The solvers of a tick's QP: the persistent OSQP by default, or any backend of qpsolvers."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np
import qpsolvers

from preview_walk.errors import InvalidInput
from preview_walk.tracking.qp.condensing import CondensedQP
from preview_walk.tracking.qp.osqp_workspace import OsqpWorkspace
from preview_walk.tracking.qp.problem import TickProblem
from preview_walk.types import Array

DEFAULT = "osqp"
"""Name of the persistent OSQP."""

MAX_ITERATIONS = 50
"""Iterations of OSQP after which an exact method finishes a tick; most ticks need fewer."""

ROUNDS = 8
"""How often a tick may be solved again because its solution crossed further limits of joints."""

FORGET_TICKS = 10
"""A limit leaves the working set after so many ticks in which it was not reached."""

KEEP = 32
"""Workspaces kept, each for one set of contacts and one working set of limits."""

TIGHT: Mapping[str, Mapping[str, Any]] = {
    "clarabel": {"tol_gap_abs": 1e-9, "tol_gap_rel": 0.0, "tol_feas": 1e-9},
    "daqp": {"primal_tol": 1e-9, "dual_tol": 1e-9},
    "piqp": {"eps_abs": 1e-9, "eps_rel": 0.0},
    "proxqp": {"eps_abs": 1e-9, "eps_rel": 0.0},
    "scs": {"eps_abs": 1e-9, "eps_rel": 0.0},
}
"""Tolerances for the backends of qpsolvers whose own are too loose for torques."""


@dataclass(frozen=True, eq=False)
class Solution:
    """What a backend returned for a tick.

    Attributes:
        acceleration: (nv,) generalised accelerations, m/s^2, rad/s^2.
        wrench: (nf,) of the contacts, in each sole's axes at its centre, N, N·m.
        torques: (n,) of the joints, N·m.
        solved: whether they solve the QP.
        iterations: 0 where no limit or edge of a contact was reached, so that none were needed.
        status: in words.
    """

    acceleration: Array
    wrench: Array
    torques: Array
    solved: bool
    iterations: int
    status: str = "solved"


class Backend(Protocol):
    """A solver of ticks; it may fail by `solved=False`, by exception or by values not finite."""

    def solve(self, problem: TickProblem) -> Solution:
        """Solve the problem with the values it holds now."""


def make_backend(name: str) -> Backend:
    """Return the backend of this name: "osqp", kept warm between ticks, or one of qpsolvers.

    Raises:
        InvalidInput: qpsolvers does not know the name or has no installed solver for it.
    """
    if name == DEFAULT:
        return OsqpBackend()
    allowed = ", ".join([DEFAULT, *(n for n in qpsolvers.available_solvers if n != DEFAULT)])
    if name not in qpsolvers.available_solvers:
        raise InvalidInput(
            f"solver must be one of those installed, {allowed}, got '{name}'.", "solver"
        )
    return QpsolversBackend(name)


class OsqpBackend:
    """The default: accelerations eliminated exactly, the rest solved by a persistent OSQP.

    A limit of a joint joins the working set, the constraints of the QP, in the tick in which a
    solution without it crosses it. Multipliers are kept by sole and by joint, so that a solve
    starts warm also when contacts or the working set have changed.
    """

    def __init__(self, max_iterations: int = MAX_ITERATIONS) -> None:
        self.max_iterations = max_iterations
        self._workspaces: dict[tuple[TickProblem, tuple[int, ...]], OsqpWorkspace] = {}
        self._working_set: dict[int, int] = {}  # limit -> ticks since it was reached
        self._multipliers: dict[object, Array] = {}

    def __getstate__(self) -> dict[str, Any]:
        """Leave out OSQP's workspaces: a solve starts from the multipliers, which are kept."""
        return {**vars(self), "_workspaces": {}}

    def solve(self, problem: TickProblem) -> Solution:
        """See `Backend.solve`."""
        iterations = 0
        for _ in range(ROUNDS):
            workspace = self._workspace(problem)
            elimination = workspace.elimination
            elimination.reduce()
            w = elimination.free()
            if w is not None:
                self._multipliers.clear()
            else:
                solved = workspace.solve(self._guess(elimination))
                iterations += workspace.iterations
                if solved is None:
                    return _failed(problem, iterations, "not converged")
                w = solved[0]
                self._remember(elimination, solved[1])
            elimination.expand(w)
            crossed = elimination.crossed()
            if not crossed:
                self._forget()
                return Solution(
                    elimination.acceleration,
                    w[: problem.nf],
                    elimination.torques.copy(),
                    True,
                    iterations,
                )
            self._working_set.update(dict.fromkeys(crossed, 0))
        return _failed(problem, iterations, "joint limits still crossed")

    def _workspace(self, problem: TickProblem) -> OsqpWorkspace:
        key = (problem, tuple(sorted(self._working_set)))
        if key not in self._workspaces:
            if len(self._workspaces) >= KEEP:
                self._workspaces.clear()
            self._workspaces[key] = OsqpWorkspace(CondensedQP(*key), self.max_iterations)
        return self._workspaces[key]

    def _labels(self, elimination: CondensedQP) -> list[tuple[object, slice]]:
        """Return what each group of constraints belongs to: a sole, then a limit each."""
        problem = elimination.problem
        count = len(problem.contact_rows)
        size = count // max(1, len(problem.contacts))
        labels: list[tuple[object, slice]] = [
            (foot, slice(size * k, size * k + size)) for k, foot in enumerate(problem.contacts)
        ]
        labels += [
            (i, slice(count + k, count + k + 1)) for k, i in enumerate(elimination.working_set)
        ]
        return labels

    def _guess(self, elimination: CondensedQP) -> Array:
        guess = np.zeros(len(elimination.constraints))
        if self._multipliers:
            for label, span in self._labels(elimination):
                if label in self._multipliers:
                    guess[span] = self._multipliers[label]
        return guess

    def _remember(self, elimination: CondensedQP, multipliers: Array) -> None:
        self._multipliers = {label: multipliers[span] for label, span in self._labels(elimination)}

    def _forget(self) -> None:
        """Drop the limits that have not been reached for a while."""
        for limit, age in list(self._working_set.items()):
            reached = limit in self._multipliers and self._multipliers[limit].any()
            self._working_set[limit] = 0 if reached else age + 1
            if self._working_set[limit] > FORGET_TICKS:
                del self._working_set[limit]


class QpsolversBackend:
    """Any backend of qpsolvers, on the QP that `TickProblem.build` returns."""

    def __init__(self, name: str) -> None:
        self.name = name

    def solve(self, problem: TickProblem) -> Solution:
        """See `Backend.solve`."""
        tight = dict(TIGHT.get(self.name, {}))
        result = qpsolvers.solve_problem(problem.build(), self.name, **tight)
        if not result.found or result.x is None:
            return _failed(problem, 0, f"{self.name} found no solution")
        acceleration, wrench = problem.split(result.x)
        torques = problem.forces(acceleration, wrench)[6:]
        return Solution(acceleration, wrench, torques, True, int(result.extras.get("iter", 0)))


def _failed(problem: TickProblem, iterations: int, status: str) -> Solution:
    nothing = np.full(problem.nv, np.nan)
    wrench = np.full(problem.nf, np.nan)
    return Solution(nothing, wrench, nothing[6:], False, iterations, status)
