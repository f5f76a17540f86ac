"""The discrete algebraic Riccati equation, solved by `control.dare` and checked afterwards.

A solution that was found before is taken from `kept`, and checked as a new one is.
"""

from __future__ import annotations

import warnings
from typing import NamedTuple

import numpy as np
import scipy.linalg

from preview_walk.errors import InvalidInput
from preview_walk.preview.kept import keep_solution, kept_solution
from preview_walk.preview.problem import Problem, require_detectable
from preview_walk.types import Array

RESIDUAL_TOLERANCE = 1e-8
"""Largest residual of the equation, relative to its solution, that is taken for a solution."""


class Law(NamedTuple):
    """P, left = (R + G' P G)^-1 G', K, Phi - G K and the equation's relative residual."""

    riccati: Array
    left: Array
    gain: Array
    closed: Array
    residual: float


def law_of(problem: Problem, riccati: Array) -> Law:
    """Return the law that minimises the cost of one sample and of P after it."""
    phi, g, s = problem.phi, problem.g, problem.s
    inner = problem.r + g.T @ riccati @ g
    left = np.linalg.solve(inner, g.T)
    gain = left @ riccati @ phi
    if s is not None:
        gain = gain + np.linalg.solve(inner, s.T)
    closed = phi - g @ gain
    defect = phi.T @ riccati @ closed - riccati + problem.q
    if s is not None:
        defect = defect - s @ gain
    size = np.abs(riccati).max()
    residual = float(np.abs(defect).max() / size) if size > 0.0 else 0.0
    return Law(riccati, left, gain, closed, residual)


def solve_riccati(problem: Problem) -> Law:
    """Return the law of the stabilising solution.

    Raises:
        InvalidInput: If there is none, or none that numbers of this size can hold.

    """
    require_detectable(problem.phi, problem.q)
    kept = kept_solution(problem)
    if kept is not None:
        law = law_of(problem, kept)
        if _stabilises(law, _radius(law)):
            return law
    law, radius = _solved(problem)
    if not _stabilises(law, radius):
        raise InvalidInput(
            "expected a Riccati equation with a stabilising solution, got one with a relative "
            f"residual of {law.residual:.1e} and a closed loop of spectral radius {radius:.9f}.",
            argument="R",
        )
    keep_solution(problem, law.riccati)
    return law


def _solved(problem: Problem) -> tuple[Law, float]:
    """Return the law of `control`'s solution and the spectral radius of its closed loop."""
    import control

    arguments = (problem.phi, problem.g, problem.q, problem.r)
    try:
        with np.errstate(all="ignore"), warnings.catch_warnings():
            # What an ill-conditioned equation gives is checked by the caller.
            warnings.simplefilter("ignore", scipy.linalg.LinAlgWarning)
            solution = control.dare(*arguments, *(() if problem.s is None else (problem.s,)))[0]
            riccati = np.asarray(solution, dtype=float)
            law = law_of(problem, (riccati + riccati.T) / 2.0)
        return law, _radius(law)
    except (np.linalg.LinAlgError, ValueError, control.ControlArgument) as error:
        sentence = str(error).rstrip(".") + "."
        raise InvalidInput(
            f"expected weights and a system whose Riccati equation can be solved, got: {sentence}",
            argument="R",
        ) from error


def _radius(law: Law) -> float:
    return float(np.abs(np.linalg.eigvals(law.closed)).max())


def _stabilises(law: Law, radius: float) -> bool:
    return law.residual < RESIDUAL_TOLERANCE and radius < 1.0
