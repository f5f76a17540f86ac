"""The check of a solver's answer, before it reaches the motors.

A solver may return anything. What is used is of the right form, finite, and obeys the equations of
motion, the contact cones and the torque limits to within `ROOM` of the robot's weight.
"""

from __future__ import annotations

import numpy as np

from preview_walk.arguments import shown
from preview_walk.constants import GRAVITY
from preview_walk.tracking.qp.problem import TickProblem
from preview_walk.tracking.qp.solution import Solution

ROOM = 0.01
"""Share of the weight (N; N·m for moments) by which an answer may miss what it must obey: ten times
what the least exact backend misses, and a hundredth of what an answer of zeros does."""


def flaw(problem: TickProblem, answer: object, exact: bool = False) -> str | None:
    """Return what is wrong with a solver's answer, in words; None where it can be used.

    Args:
        problem: the tick's QP.
        answer: what the solver returned for it.
        exact: whether the accelerations were eliminated exactly (`CondensedBackend`): motion is
            obeyed by construction, cones and limits to the solver's own tolerance. Only nan could
            be in such an answer.
    """
    if exact and isinstance(answer, Solution) and answer.solved is True:
        total = answer.torques @ answer.torques
        return None if total < np.inf else "the torques are not finite"
    if not isinstance(answer, Solution):
        return f"the solver returned {shown(answer)}"
    if answer.solved is not True:
        return str(answer.status)
    sizes = ((answer.acceleration, problem.nv), (answer.wrench, problem.nf))
    for values, size in (*sizes, (answer.torques, problem.n)):
        if not _is_vector(values, size):
            return f"the solver returned {shown(values)} where {size} numbers are needed"
    if type(answer.iterations) is not int:
        return f"the solver counted {shown(answer.iterations)} iterations"
    return _miss(problem, answer)


def _is_vector(values: object, size: int) -> bool:
    return isinstance(values, np.ndarray) and values.dtype == np.float64 and values.shape == (size,)


def _miss(problem: TickProblem, answer: Solution) -> str | None:
    """Return by how much an answer misses what it must obey, in words, if it is too much."""
    room = ROOM * GRAVITY * problem.robot.mass
    if problem.nf:
        cone = (problem.contact_rows @ answer.wrench - problem.contact_high).max()
        if not cone <= room:
            return f"the contact cones are left by {cone:.3g} N"
    forces = problem.forces(answer.acceleration, answer.wrench)
    forces[6:] -= answer.torques
    missing = np.abs(forces).max()
    if not missing <= room:
        return f"the equations of motion are missed by {missing:.3g} N"
    beyond = (np.abs(answer.torques) - problem.robot.effort).max()
    return None if beyond <= room else f"the torque limits are crossed by {beyond:.3g} N·m"
