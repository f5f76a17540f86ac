"""The regulator problem behind a preview servo, with and without integral action.

Both are X(k+1) = Phi X(k) + G v(k) + (terms of the known future) at the cost

    sum_k  X' Q X + 2 X' S v + v' R v.

*With integral action* v = du and X = [e; dx], where e(k) = C x(k) + D u(k-1) - r(k) is the error
just before the input changes (the error y - r itself where D = 0) and d marks an increment:

    Phi = [I  C A; 0  A],  G = [C B + D; B],  Gamma_r = [-I; 0] on dr(k+1),  Gamma_w = [C E; E] on
    dw(k),  Q = diag(Q_e, Q_x),  S = [Q_e D; 0],  R + D' Q_e D.

(Katayama et al. 1985 for D = 0, E = 0.) *Without*, v = u and X = x: Phi = A, G = B, Q = C' Q_e C
+ Q_x, S = C' Q_e D, R + D' Q_e D; the reference enters the cost linearly, see `gains`.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from preview_walk.errors import InvalidInput
from preview_walk.preview.plant import Plant
from preview_walk.types import Array

RANK_TOLERANCE = 1e-10
"""A singular value below this share of the largest entry counts as zero."""


@dataclass(frozen=True, eq=False)
class Weights:
    """Q_e (p, p) of the error, Q_x (n, n) of (increments of) the state, R (m, m) of the input."""

    Q_e: Array
    Q_x: Array
    R: Array


@dataclass(frozen=True, eq=False)
class Problem:
    """A regulator problem; S is None where it is zero.

    Raises:
        InvalidInput: If products of plant and weights are too large to be numbers.

    """

    phi: Array
    g: Array
    q: Array
    r: Array
    s: Array | None

    def __post_init__(self) -> None:
        """Look for overflows."""
        parts = self.phi, self.g, self.q, self.r, self.s
        if not all(np.isfinite(part).all() for part in parts if part is not None):
            raise InvalidInput(
                "expected a system and weights whose products are finite, got an overflow.",
                argument="Q_e",
            )


def error_augmented(plant: Plant, weights: Weights) -> Problem:
    """Return the problem in X = [e; dx] and du: the servo with integral action."""
    a, b, c, d = plant.A, plant.B, plant.C, plant.D
    n, p = len(a), len(c)
    phi = np.block([[np.eye(p), c @ a], [np.zeros((n, p)), a]])
    g = np.vstack([c @ b, b])
    q = np.block([[weights.Q_e, np.zeros((p, n))], [np.zeros((n, p)), weights.Q_x]])
    if not np.any(d):
        return Problem(phi, g, q, weights.R, None)
    g[:p] += d
    s = np.vstack([weights.Q_e @ d, np.zeros((n, d.shape[1]))])
    return Problem(phi, g, q, weights.R + d.T @ weights.Q_e @ d, s)


def positional(plant: Plant, weights: Weights) -> Problem:
    """Return the problem in x and u: the servo without integral action."""
    c, d = plant.C, plant.D
    seen = c.T @ weights.Q_e
    q = seen @ c + weights.Q_x
    if not np.any(d):
        return Problem(plant.A, plant.B, (q + q.T) / 2.0, weights.R, None)
    return Problem(plant.A, plant.B, (q + q.T) / 2.0, weights.R + d.T @ weights.Q_e @ d, seen @ d)


def lost_mode(a: Array, b: Array) -> str | None:
    """Return a mode on or outside the unit circle that b does not reach (Hautus), or None."""
    smallest = RANK_TOLERANCE * max(1.0, float(np.abs(a).max()))
    b = b / max(float(np.abs(b).max()), np.finfo(float).tiny)
    for mode in np.linalg.eigvals(a):
        pencil = np.hstack([a - mode * np.eye(len(a)), b])
        if abs(mode) >= 1.0 - 1e-9 and np.linalg.svd(pencil)[1][-1] < smallest:
            return f"z = {mode.real:.6g}" if mode.imag == 0.0 else f"z = {mode:.6g}"
    return None


def require_stabilisable(plant: Plant) -> None:
    """Refuse a plant with a mode that grows whatever the input."""
    mode = lost_mode(plant.A, plant.B)
    if mode is not None:
        raise InvalidInput(
            f"expected a stabilisable system, got a mode at {mode} that the input does not reach.",
            argument="system",
        )


def require_detectable(phi: Array, q: Array) -> None:
    """Refuse weights that do not see a mode which does not decay by itself."""
    mode = lost_mode(phi.T, q)
    if mode is not None:
        raise InvalidInput(
            "expected weights Q_e and Q_x that make the system detectable, got a mode at "
            f"{mode} that they do not see.",
            argument="Q_e",
        )
