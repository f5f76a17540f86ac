"""What a solver of ticks returns, and what any solver of ticks is."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from preview_walk.tracking.qp.problem import TickProblem
from preview_walk.types import Array


@dataclass(frozen=True, eq=False)
class Solution:
    """What a backend returned for a tick.

    Attributes:
        acceleration: (nv,) generalised accelerations, m/s^2, rad/s^2.
        wrench: (nf,) of the contacts, in each sole's axes at its centre, N, N·m.
        torques: (n,) of the joints, N·m.
        solved: whether they solve the QP.
        iterations: what the solver needed.
        status: in words.
        finished: whether the exact method finished the tick, the solver's own answer not having
            been reached within its iterations.
    """

    acceleration: Array
    wrench: Array
    torques: Array
    solved: bool
    iterations: int
    status: str = "solved"
    finished: bool = False


class Backend(Protocol):
    """A solver of ticks; it may fail by `solved=False`, by exception or by values not finite."""

    def solve(self, problem: TickProblem) -> Solution:
        """Solve the problem with the values it holds now."""


def unsolved(problem: TickProblem, iterations: int, status: str) -> Solution:
    """Return what a backend says of a tick that it has not solved, in words."""
    nothing = np.full(problem.nv, np.nan)
    wrench = np.full(problem.nf, np.nan)
    return Solution(nothing, wrench, nothing[6:], False, iterations, status)
