"""The least x with rows x <= bounds, exactly: what Wieber's walk asks of the jerks of a horizon.

Lawson and Hanson's least distance programming ("Solving least squares problems", 1974, chapter 23)
turns it into a non-negative least-squares problem, which an active-set method ends in finitely many
steps: some tens of active rows take about a millisecond, and there is no tolerance to choose.
"""

from __future__ import annotations

import numpy as np
from scipy.optimize import nnls

from preview_walk.types import Array

_NOTHING = 1e-12
"""A row of this norm says that nothing that can still be done reaches its bound."""

_CONTRADICTION = 1e-9
"""A residual below this, where 1 is that of no bound at all, tells bounds that contradict."""


def least_distance(rows: Array, bounds: Array) -> Array | None:
    """Return the least x (n,) with rows (k, n) x <= bounds (k,), or None where there is none."""
    sizes = np.linalg.norm(rows, axis=1)
    idle = sizes < _NOTHING
    if (bounds[idle] < 0.0).any():
        return None
    rows, bounds = rows[~idle] / sizes[~idle, None], bounds[~idle] / sizes[~idle]
    scale = float(np.abs(bounds).max(initial=0.0))
    if not (bounds < 0.0).any():
        return np.zeros(rows.shape[1])
    # Multipliers y >= 0 that bring -rows' y to 0 and -bounds' y to 1 would be a contradiction;
    # what they leave is, scaled, the least x.
    matrix = np.vstack([-rows.T, -bounds[None] / scale])
    aim = np.zeros(len(matrix))
    aim[-1] = 1.0
    try:
        multipliers, residual = nnls(matrix, aim, maxiter=10 * len(matrix) + 10 * len(rows))
    except RuntimeError:  # it did not end within so many steps
        return None
    if residual < _CONTRADICTION:
        return None
    rest = matrix @ multipliers - aim
    found: Array = rest[:-1] * (-scale / rest[-1])
    return found
