"""More outputs than inputs: errors that no constant input can remove, and the best there is.

With integral action the error-augmented system X = [e; dx] then has modes at z = 1 that the input
does not reach: V' Phi = V', V' G = 0 for an orthonormal V. The part xi = V' X of the error stays
for ever; what is best for it is the constant error e_s(xi) with the least e' Q_e e,

    e_s = Q_e^-1 V_e Y xi,    Y = (V_e' Q_e^-1 V_e)^-1,    X_s = [Q_e^-1 V_e Y; 0].

With a basis T of the rest (T' V = 0) and the coordinates c = L X, L = T' (I - X_s V'), the
deviation from it is a regulator problem of its own with a solution P_c and a loop A_c. The
constant error gives the cost a linear term, (T' Q - K_c' S') X_s xi a sample, whose sum is

    sigma = (I - A_c')^-1 (T' Q - K_c' S') X_s.

All formulas of the law hold for P = L' P_c L + L' sigma V' + V sigma' L in place of the Riccati
solution (the cost that is left after the constant part is taken off), as a brute-force optimum
confirms. Errors of no weight are left out in the same way, T being what is seen of them.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.linalg

from preview_walk.errors import InvalidInput
from preview_walk.preview.problem import RANK_TOLERANCE, Problem
from preview_walk.preview.riccati import Law, law_of, solve_riccati
from preview_walk.types import Array


@dataclass(frozen=True, eq=False)
class _Part:
    """A subspace: coordinates c = lift X, basis T, fixed modes V and their best errors X_s."""

    lift: Array
    basis: Array
    fixed: Array
    best: Array


def solve_reachable(problem: Problem, outputs: int) -> Law:
    """Return the law of an error-augmented problem, of whose rows `outputs` = p are e.

    Raises:
        InvalidInput: If an output cannot be held at a value though there are inputs enough, or
            there is no stabilising solution.

    """
    seen = _seen(problem, outputs)
    shown = _restricted(problem, seen)
    part = _reachable(shown, seen.basis.shape[1] - (len(problem.phi) - outputs))
    if part is None:
        law = solve_riccati(shown)
        if shown is problem:
            return law
        riccati = law.riccati
    else:
        reduced = _restricted(shown, part)
        law = solve_riccati(reduced)
        linear = part.basis.T @ shown.q @ part.best
        if shown.s is not None:
            linear = linear - law.gain.T @ shown.s.T @ part.best
        sigma = np.linalg.solve(np.eye(len(law.closed)) - law.closed.T, linear)
        cross = part.lift.T @ sigma @ part.fixed.T
        riccati = part.lift.T @ law.riccati @ part.lift + cross + cross.T
    try:
        whole = law_of(problem, seen.lift.T @ riccati @ seen.lift)
    except np.linalg.LinAlgError as error:
        raise InvalidInput(
            f"expected weights whose gains can be computed, got: {error}.", argument="R"
        ) from error
    return whole._replace(residual=law.residual)


def _seen(problem: Problem, outputs: int) -> _Part:
    """Return the part of [e; dx] without combinations of errors that have no weight."""
    size = len(problem.phi)
    values, vectors = np.linalg.eigh(problem.q[:outputs, :outputs])
    kept = values > 1e-13 * max(float(values[-1]), np.finfo(float).tiny)
    none = np.zeros((size, 0))
    if kept.all():
        return _Part(np.eye(size), np.eye(size), none, none)
    basis = scipy.linalg.block_diag(vectors[:, kept], np.eye(size - outputs))
    return _Part(basis.T, basis, none, none)


def _reachable(problem: Problem, outputs: int) -> _Part | None:
    """Return the part of [e; dx] that the input reaches, or None where that is all of it."""
    size, inputs = problem.g.shape
    change = np.hstack([(problem.phi - np.eye(size))[:, outputs:], problem.g])
    # The first rows are C times the last: [C, D; A - I, B] has the same rank and better numbers.
    scale = np.abs(problem.g).max()
    change[:, size - outputs :] /= max(scale, np.finfo(float).tiny)
    left, values, _ = np.linalg.svd(change)
    values = np.append(values, np.zeros(max(0, size - len(values))))
    lost = int((values < RANK_TOLERANCE * max(1.0, float(np.abs(problem.phi).max()))).sum())
    if lost == 0:
        return None
    if lost > max(0, outputs - inputs):
        raise InvalidInput(
            "expected outputs that can all be held at any constant value, got "
            f"{outputs} outputs and {inputs} inputs with [A - I, B; C, D] not of "
            "full row rank: a zero at z = 1, dependent outputs or too few inputs.",
            argument="system",
        )
    fixed, basis = left[:, size - lost :], left[:, : size - lost]
    directions = np.linalg.solve(problem.q[:outputs, :outputs], fixed[:outputs])
    best = np.zeros((size, lost))
    best[:outputs] = directions @ np.linalg.inv(fixed[:outputs].T @ directions)
    lift = basis.T @ (np.eye(size) - best @ fixed.T)
    return _Part(lift, basis, fixed, best)


def _restricted(problem: Problem, part: _Part) -> Problem:
    """Return the problem in the coordinates of a part."""
    if part.lift.shape[0] == len(problem.phi):
        return problem
    q = part.basis.T @ problem.q @ part.basis
    s = None if problem.s is None else part.basis.T @ problem.s
    return Problem(
        part.lift @ problem.phi @ part.basis, part.lift @ problem.g, (q + q.T) / 2.0, problem.r, s
    )
