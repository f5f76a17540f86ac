"""The nearest point of a polyhedron, exactly: what finishes the ticks on which OSQP is slow.

A dual active-set method (Goldfarb and Idnani, Mathematical Programming 27, 1983) for

    minimise |x + gradient|^2 / 2  subject to  low <= rows @ x <= high

with rows of length one. From a guess of the multipliers it adds the most violated constraint, one
after the other, dropping those that stand in the way; it ends after finitely many steps.
"""

from __future__ import annotations

import numpy as np
from scipy.linalg.lapack import dposv

from preview_walk.types import Array

MAX_STEPS = 300
"""Steps after which the method gives up; it needs few more than there are active constraints."""

_TOLERANCE = 1e-10
"""Violation, relative to the point's distance, and squared sine of an angle that count as zero."""


def nearest_point(
    gradient: Array, rows: Array, low: Array, high: Array, multipliers: Array
) -> tuple[Array, Array] | None:
    """Return x (n,) and its multipliers (m,), positive at `high`; None where there is none.

    `rows` (m, n) of length one; `multipliers` (m,) are a guess, of which only the signs count.
    """
    tolerance = _TOLERANCE * (1.0 + float(np.abs(gradient).max()))
    active, normals, dual = _start(gradient, rows, low, high, multipliers)
    x = -gradient - dual @ normals
    entering = -1  # the constraint that is becoming active, and its dual so far
    risen = 0.0
    for _ in range(MAX_STEPS):
        if entering < 0:
            values = rows @ x
            over = np.maximum(values - high, low - values)
            over[active] = 0.0
            entering, risen = int(over.argmax()), 0.0
            violation = float(over[entering])
            if violation <= tolerance:
                y = np.zeros(len(rows))
                y[active] = dual * np.einsum("ij,ij->i", normals, rows[active])
                return x, y
            above = values[entering] > high[entering]
            normal = rows[entering] if above else -rows[entering]
        share = dposv(normals @ normals.T, normals @ normal)[1] if active else np.zeros(0)
        direction = normal - share @ normals
        slope = float(direction @ normal)
        full = violation / slope if slope > _TOLERANCE else np.inf
        rising = share > 0.0
        ratio = np.where(rising, dual / np.where(rising, share, 1.0), np.inf)
        blocking = int(ratio.argmin()) if active else -1
        partial = float(ratio[blocking]) if active else np.inf
        length = min(full, partial)
        if length == np.inf:
            return None
        dual = dual - length * share
        risen += length
        if full < np.inf:
            x = x - length * direction
            violation -= length * slope
        if full <= partial:
            active = [*active, entering]
            normals, dual = np.vstack([normals, normal]), np.append(dual, risen)
            entering = -1
        else:
            active = active[:blocking] + active[blocking + 1 :]
            normals, dual = np.delete(normals, blocking, axis=0), np.delete(dual, blocking)
    return None


def _start(
    gradient: Array, rows: Array, low: Array, high: Array, multipliers: Array
) -> tuple[list[int], Array, Array]:
    """Return the part of the guessed active set that belongs to positive duals."""
    at_high = multipliers > 0.0
    bound = np.where(at_high, high, -low)
    index = np.flatnonzero((multipliers != 0.0) & np.isfinite(bound))
    sign = np.where(at_high, 1.0, -1.0)
    while index.size:
        normals = rows[index] * sign[index, None]
        _, dual, info = dposv(normals @ normals.T, -(normals @ gradient) - bound[index])
        if info != 0:
            break
        if (dual >= 0.0).all():
            return index.tolist(), normals, dual
        index = index[dual >= 0.0]
    return [], np.zeros((0, rows.shape[1])), np.zeros(0)
