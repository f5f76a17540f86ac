"""What the controller does when a QP is not solved.

Never without an answer, in this order:

- 0, `SOLVED`: the torques solve this tick's QP.
- 1, `LAST_SOLUTION`: the accelerations and wrenches of the last solution, put into the dynamics of
  this tick, for at most `STALE_TICKS` ticks in a row.
- 2, `DAMPED_POSTURE`: joints brake and are held where they were, soles in contact carry the weight.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import qpsolvers

from preview_walk.errors import PreviewWalkError
from preview_walk.tracking.dynamics import Dynamics
from preview_walk.tracking.qp.problem import (
    BASE_WEIGHT,
    BRAKE,
    CONTACT_WEIGHT,
    WRENCH_UNIT,
    TickProblem,
)
from preview_walk.tracking.qp.solution import Solution
from preview_walk.types import Array, Foot

SOLVED, LAST_SOLUTION, DAMPED_POSTURE = 0, 1, 2
"""Status codes, as `WholeBodyController.status` and `qp_status` of a record hold them."""

STALE_TICKS = 5
"""How many ticks in a row the last solution may stand in."""

HOLD = 10.0
"""Frequency (rad/s), critically damped, at which the damped posture holds the joints."""


class QPFailure(PreviewWalkError):
    """Evidence of a tick whose QP was not solved.

    Attributes:
        problem: the QP, as a `qpsolvers.Problem`.
        solution: what the backend returned, which may be anything; None where it raised.
        cause: what it raised, or None.
        why: what is wrong with them, in words.
    """

    def __init__(
        self,
        problem: qpsolvers.Problem,
        solution: Any,
        cause: BaseException | None,
        why: str,
    ) -> None:
        self.problem = problem
        self.solution = solution
        self.cause = cause
        self.why = why
        super().__init__(f"the QP of a tick was not solved: {why}.")

    def __reduce__(self) -> tuple[Any, ...]:
        """Make it again from its evidence."""
        return type(self), (self.problem, self.solution, self.cause, self.why)


class Fallback:
    """The answers to unsolved ticks; `status` says which was given last, `count` how often."""

    def __init__(self) -> None:
        self.status = SOLVED
        self.count = 0
        self._row = 0
        self._last: tuple[tuple[Foot, ...], Solution] | None = None
        self._held: Array | None = None

    def solved(self, problem: TickProblem, solution: Solution) -> None:
        """Take note of a solved tick."""
        self.status, self._row = SOLVED, 0
        self._last, self._held = (problem.contacts, solution), None

    def solution(self, problem: TickProblem, dynamics: Dynamics) -> Solution:
        """Return what stands in for the solution of an unsolved tick."""
        self.count += 1
        self._row += 1
        if self._last is not None and self._row <= STALE_TICKS:
            self.status = LAST_SOLUTION
            contacts, last = self._last
            wrench = _for_contacts(problem, contacts, last.wrench)
            torques = problem.forces(last.acceleration, wrench)[6:]
            return Solution(last.acceleration, wrench, torques, False, 0, "last solution")
        self.status = DAMPED_POSTURE
        return self._damped(problem, dynamics)

    def _damped(self, problem: TickProblem, dynamics: Dynamics) -> Solution:
        """Return accelerations that hold the joints while the soles stay, and least wrenches.

        The soles are those that stood when a tick was last solved.
        """
        q, v = dynamics.q[7:], dynamics.v[6:]
        if self._held is None:
            self._held = q.copy()
        contacts = problem.contacts if self._last is None else self._last[0]
        soles = [dynamics.soles[foot] for foot in contacts]
        jacobian = np.vstack([np.zeros((0, problem.nv)), *(sole.jacobian for sole in soles)])
        stay = np.concatenate([[], *(-sole.drift - BRAKE * sole.velocity for sole in soles)])
        weights = np.concatenate([np.full(6, BASE_WEIGHT), np.ones(problem.n)])
        wanted = np.zeros(problem.nv)
        wanted[6:] = HOLD**2 * (self._held - q) - 2.0 * HOLD * v
        acceleration = np.linalg.solve(
            CONTACT_WEIGHT * jacobian.T @ jacobian + np.diag(weights),
            CONTACT_WEIGHT * jacobian.T @ stay + weights * wanted,
        )
        forces = problem.forces(acceleration, np.zeros(problem.nf))
        unit = np.tile(WRENCH_UNIT, len(contacts))
        wrench = np.linalg.lstsq(jacobian[:, :6].T * unit, forces[:6], rcond=None)[0] * unit
        torques = (forces - wrench @ jacobian)[6:]
        wrench = _for_contacts(problem, contacts, wrench)
        return Solution(acceleration, wrench, torques, False, 0, "damped posture")


def _for_contacts(problem: TickProblem, contacts: tuple[Foot, ...], wrench: Array) -> Array:
    """Return the wrenches (nf,) of a problem's contacts out of those of others, or zeros."""
    result = np.zeros(problem.nf)
    for k, foot in enumerate(problem.contacts):
        if foot in contacts:
            at = 6 * contacts.index(foot)
            result[6 * k : 6 * k + 6] = wrench[at : at + 6]
    return result
