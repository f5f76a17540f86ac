"""The nearest point of a polyhedron, exactly: what polishes OSQP's answers and finishes others.

The problem is

    minimise |x + gradient|^2 / 2  subject to  low <= rows @ x <= high

with rows of length one. `polish` takes the constraints that some multipliers call active for
equalities: one small solve, which it checks. `nearest_point` is a dual active-set method (Goldfarb
and Idnani, Mathematical Programming 27, 1983): from a guess of the multipliers it adds the most
violated constraint, one after the other, dropping those that stand in the way; it ends after
finitely many steps.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from scipy.linalg.lapack import dposv, dpotrf, dpotrs

from preview_walk.types import Array

MAX_STEPS = 300
"""Steps after which the method gives up; it needs few more than there are active constraints."""

_TOLERANCE = 1e-10
"""Violation, relative to the point's distance, and squared sine of an angle that count as zero."""

_INFINITE = 1e20
"""Bounds from here on are none."""

_DROPS = 4
"""How often `polish` leaves out constraints whose multipliers have the wrong sign."""

_RIDGE = 1e-10
"""Added to the squared lengths of the active rows, of which some may follow from others; a step of
refinement takes its effect out again."""

_POLISHED = 1e-8
"""Violation, relative to the point's distance, that a polished minimiser may have."""


class Polished(NamedTuple):
    """The minimiser with the active constraints as equalities.

    Attributes:
        x: (n,) the point.
        multipliers: (m,) positive at `high`.
        optimal: whether it is the minimiser under all constraints.
    """

    x: Array
    multipliers: Array
    optimal: bool


def polish(gradient: Array, rows: Array, low: Array, high: Array, multipliers: Array) -> Polished:
    """Return the minimiser with those constraints active that the signs of `multipliers` name.

    Constraints whose multiplier comes out with the other sign are left out. The arguments are those
    of `nearest_point`. OSQP's own polishing is the same step, unchecked (Stellato and others,
    Mathematical Programming Computation 12, 2020, section 4).
    """
    y = np.zeros(len(low))
    index, sign, bound = _active(low, high, multipliers)
    normals = rows[index] * sign[:, None]
    gram, wanted = normals @ normals.T, -(normals @ gradient) - bound
    for _ in range(_DROPS):
        if not index.size:
            break
        ridged = gram.copy()
        ridged.reshape(-1)[:: len(gram) + 1] += _RIDGE
        factor = dpotrf(ridged, lower=1)[0]
        dual = dpotrs(factor, wanted, lower=1)[0]
        if dual.min() >= 0.0:
            dual += dpotrs(factor, wanted - gram @ dual, lower=1)[0]
            y[index] = dual * sign
            break
        keep = dual >= 0.0
        index, sign, bound, wanted = index[keep], sign[keep], bound[keep], wanted[keep]
        gram = gram[keep][:, keep]
    x = -gradient - y @ rows
    values = rows @ x
    error = max(float((values - high).max()), float((low - values).max()))
    if index.size:
        error = max(error, float(np.abs(values[index] * sign - bound).max()))
    return Polished(x, y, error <= _POLISHED * (1.0 + float(np.abs(gradient).max())))


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


def _active(low: Array, high: Array, multipliers: Array) -> tuple[Any, Array, Array]:
    """Return index, sign and signed bound of the constraints that multipliers call active."""
    index = multipliers.nonzero()[0]
    sign = np.sign(multipliers[index])
    bound = np.where(sign > 0.0, high[index], -low[index])
    finite = bound < _INFINITE
    if finite.all():
        return index, sign, bound
    return index[finite], sign[finite], bound[finite]


def _start(
    gradient: Array, rows: Array, low: Array, high: Array, multipliers: Array
) -> tuple[list[int], Array, Array]:
    """Return the part of the guessed active set that belongs to positive duals."""
    index, sign, bound = _active(low, high, multipliers)
    while index.size:
        normals = rows[index] * sign[:, None]
        _, dual, info = dposv(normals @ normals.T, -(normals @ gradient) - bound)
        if info != 0:
            break
        keep = dual >= 0.0
        if keep.all():
            return index.tolist(), normals, dual
        index, sign, bound = index[keep], sign[keep], bound[keep]
    return [], np.zeros((0, rows.shape[1])), np.zeros(0)
