r"""The largest jump of the DCM that steps at given times capture: one linear programme.

The linear inverted pendulum with frequency omega has the DCM xi = c + c' / omega, whose motion
xi' = omega (xi - p) depends on the CoP p alone (Englsberger, Ott, Albu-Schaeffer, "Three-
dimensional bipedal walking control based on divergent component of motion", T-RO 2015). Solved
backwards from a DCM at rest it is the discounted mean of the CoP to come,

    xi(0) = omega * integral over t >= 0 of exp(-omega t) p(t) dt,

so the set of DCMs from which n steps can stop the pendulum (n-step capturability: Koolen et al.,
"Capturability-based analysis and control of legged locomotion, part 1", IJRR 2012, section 3) is
the set of values of that integral. Let stride d_k lead from foothold f_k to f_(k+1), land at l_k
and the foot behind lift at m_k. In single support the CoP is the stance foot plus a point of the
sole, in double support also plus a share of the stride, hence

    xi(0) = f_0 + s + sum over k of c_k d_k,   s in the sole,
    exp(-omega m_k) <= c_k <= exp(-omega l_k),

where the share of c_k is free because the CoP of a double support is. The last double support
never ends, so the last c_k reaches down to 0. A stride that is bound to a polygon, N d_k <= h,
makes q_k = c_k d_k obey N q_k <= c_k h, which is linear in (q_k, c_k): nothing is lost.

Only one limit is not linear in them: a foot travels d_(k-1) + d_k in the swing to its second
foothold, at no more than the swing speed. The programme is solved without it first; where the
answer breaks it, it is solved again with the c_k fixed (linear again), and then improved by
linearising d_k = q_k / c_k about the answer, within a trust region.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import cos, inf, pi

import numpy as np
from scipy.optimize import linprog

from preview_walk.geometry.support import Sole
from preview_walk.types import Array

_SIDES = 32
"""A disc is a polygon of this many sides inside it."""

_ANGLES = 2.0 * pi / _SIDES * np.arange(_SIDES)
"""Directions (rad) of the normals of these sides."""

_AROUND = np.stack([np.cos(_ANGLES), np.sin(_ANGLES)], axis=1)
"""The normals, (M, 2)."""

_AXES = np.array([[1.0, 0.0], [-1.0, 0.0], [0.0, 1.0], [0.0, -1.0]])
"""Normals of a rectangle along the axes."""

_LEAST_SHARE = 1e-4
"""The last foothold carries at least this share, so that it is a definite place."""

_TOLERANCE = 1e-6
"""A way may be longer than the swing's limit by this much (m): rounding."""


@dataclass(frozen=True, eq=False)
class Polygon:
    """The convex polygon of the points d with normals @ d <= limits.

    Attributes:
        normals: (M, 2), any length.
        limits: (M,).
    """

    normals: Array
    limits: Array

    @classmethod
    def box(cls, x: tuple[float, float], y: tuple[float, float]) -> Polygon:
        """Return a rectangle along the axes.

        Args:
            x: both ends of its range, in any order, m.
            y: the same for y.
        """
        return cls(_AXES, np.array([max(x), -min(x), max(y), -min(y)]))

    @classmethod
    def point(cls, point: Array) -> Polygon:
        """Return a single point."""
        return cls(_AXES, _AXES @ point)

    @classmethod
    def disc(cls, centre: Array, radius: float) -> Polygon:
        """Return the regular polygon of 32 sides inscribed in a disc.

        Args:
            centre: (2,), m.
            radius: m.
        """
        return cls(_AROUND, _AROUND @ centre + radius * cos(pi / _SIDES))

    def __and__(self, second: Polygon) -> Polygon:
        """Return the intersection."""
        return Polygon(
            np.vstack([self.normals, second.normals]),
            np.concatenate([self.limits, second.limits]),
        )


@dataclass(frozen=True, eq=False)
class CaptureStep:
    """What one stride may be.

    Attributes:
        most: largest weight c_k, at landing: exp(-omega l_k).
        least: smallest weight c_k, as a share of `most`: exp(-omega (m_k - l_k)), in [0, 1].
        reach: where the foot may land, relative to the other foot (m).
        travel: longest way of the foot through the air, d_(k-1) + d_k (m).
    """

    most: float
    least: float
    reach: Polygon
    travel: float = inf


@dataclass(frozen=True, eq=False)
class Capture:
    """The largest jump and the strides that capture it.

    Attributes:
        jump: length of the DCM's jump (m).
        point: (2,) the point of the sole, relative to its centre, that the CoP keeps (m).
        shares: (n,) the weights c_k as shares of their `most`.
        strides: (n, 2) the strides d_k (m).
    """

    jump: float
    point: Array
    shares: Array
    strides: Array


def largest_jump(
    dcm: Array, direction: Array, sole: Sole, strides: Sequence[CaptureStep], refine: bool = True
) -> Capture | None:
    """Return the largest jump of the DCM in a direction that the strides capture, or None.

    Args:
        dcm: (2,) the DCM before the jump, relative to the stance foot (m).
        direction: (2,) unit vector of the jump.
        sole: half sizes of the soles.
        strides: the strides in time order, at least one.
        refine: improve the weights where the swing's travel binds; otherwise two guesses of them
            are tried, which is a little low in a few directions and several times faster.
    """
    jump = _Jump(dcm, direction, sole, strides)
    free = _solve(jump)
    if free is None or _travels(free, strides):
        return free
    early = replace(free, shares=np.ones(len(strides)))
    starts = [start for guess in (free, early) if (start := _solve(jump, guess)) is not None]
    if refine:
        starts = [_refined(jump, start) for start in starts]
    return max(starts, key=lambda capture: capture.jump, default=None)


@dataclass(frozen=True, eq=False)
class _Jump:
    """What a programme is about: the arguments of `largest_jump`."""

    dcm: Array
    direction: Array
    sole: Sole
    strides: Sequence[CaptureStep]


def _travels(capture: Capture, strides: Sequence[CaptureStep]) -> bool:
    """Return whether every swing foot gets as far as it has to."""
    ways = capture.strides[:-1] + capture.strides[1:]
    limits = np.array([stride.travel * cos(pi / _SIDES) for stride in strides[1:]])
    return bool(np.all(np.max(ways @ _AROUND.T, axis=1) <= limits + _TOLERANCE))


def _refined(jump: _Jump, start: Capture) -> Capture:
    """Return a capture no worse than `start`: the weights moved while that pays."""
    best, trust = start, 0.5
    while trust > 0.01:
        moved = _solve(jump, best, trust)
        # The weights that the linearised programme likes, now with strides that are exact.
        exact = _solve(jump, moved) if moved else None
        if exact is not None and exact.jump > best.jump * (1.0 + 1e-5):
            best = exact
        else:
            trust /= 3.0
    return best


def _solve(jump: _Jump, about: Capture | None = None, trust: float = 0.0) -> Capture | None:
    """Return the solution of the linear programme, or None where it has none.

    The unknowns are jump, point (2), then share and q / most (2) of each stride, so that the far
    strides are as well scaled as the near ones.

    Args:
        jump: what is captured.
        about: weights and strides about which the travel is linearised; None ignores it.
        trust: how far the weights may move from those, as a share of their range.
    """
    sole, strides = jump.sole, jump.strides
    count = 3 + 3 * len(strides)
    balance = np.zeros((2, count))
    balance[:, 0] = -jump.direction
    balance[0, 1] = balance[1, 2] = 1.0
    bounds: list[tuple[float | None, float | None]] = [(0.0, None)]
    bounds += [(-size, size) for size in (sole.half_length, sole.half_width)]
    rows, limits = [], []
    for k, stride in enumerate(strides):
        share, q = 3 + 3 * k, slice(4 + 3 * k, 6 + 3 * k)
        balance[:, q] = stride.most * np.eye(2)
        low, high = max(stride.least, _LEAST_SHARE), 1.0
        if about is not None:
            room = trust * (high - low)
            low, high = max(low, about.shares[k] - room), min(high, about.shares[k] + room)
        bounds += [(low, high), (None, None), (None, None)]
        row = np.zeros((len(stride.reach.limits), count))
        row[:, share] = -stride.reach.limits
        row[:, q] = stride.reach.normals
        rows.append(row)
        limits.append(np.zeros(len(row)))
        if about is not None and stride.travel < inf:
            rows.append(_way(about, k, count))
            way = about.strides[k - 1] + about.strides[k]
            limits.append(stride.travel * cos(pi / _SIDES) - _AROUND @ way)
    result = linprog(
        -np.eye(1, count)[0],
        A_ub=np.vstack(rows),
        b_ub=np.concatenate(limits),
        A_eq=balance,
        b_eq=jump.dcm,
        bounds=bounds,
        method="highs",
        options={"primal_feasibility_tolerance": 1e-9},
    )
    if result.status != 0:
        return None
    table = result.x[3:].reshape(-1, 3)
    return Capture(float(result.x[0]), result.x[1:3], table[:, 0], table[:, 1:] / table[:, :1])


def _way(about: Capture, k: int, count: int) -> Array:
    """Return the rows (M, count) of how far the foot of stride k travels, linear about a capture.

    `count`: of the unknowns.
    """
    row = np.zeros((_SIDES, count))
    for j in (k - 1, k):
        row[:, 4 + 3 * j : 6 + 3 * j] = _AROUND / about.shares[j]
        row[:, 3 + 3 * j] = -_AROUND @ about.strides[j] / about.shares[j]
    return row
