"""The divergent component of motion (DCM), xi = c + c' / omega: what decides whether one falls."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from scipy.signal import lfilter

from preview_walk.planning.support import Sole, support_polygon
from preview_walk.types import Array


def planned_dcm(zmp: Array, omega_dt: float) -> Array:
    """Return the DCM (N, 2) in m that goes with a sampled ZMP (N, 2) in m.

    xi(t) = omega * integral from t of exp(-omega (s - t)) p(s) ds: the one bounded solution of
    xi' = omega (xi - p) (Englsberger et al. 2015, eq. 6 backwards in time), with the ZMP constant
    over each sample and held after the last. `omega_dt` is omega times the sample time.
    """
    decay = float(np.exp(-omega_dt))
    last = zmp[-1]
    back, _ = lfilter([1.0 - decay], [1.0, -decay], zmp[::-1], axis=0, zi=decay * last[None])
    result: Array = back[::-1]
    return result


def within_support(point: Array, poses: Sequence[Array], sole: Sole) -> Array:
    """Return the point (2,) of the support polygon of standing soles nearest to `point` (2,).

    `poses`: (4, 4) of the soles, at least one; `sole`: their half sizes.
    """
    x, y = point.tolist()
    for pose in poses:  # nearly always over a sole: no need of the hull
        dx, dy = x - float(pose[0, 3]), y - float(pose[1, 3])
        along = dx * float(pose[0, 0]) + dy * float(pose[1, 0])
        aside = dx * float(pose[0, 1]) + dy * float(pose[1, 1])
        if abs(along) <= sole.half_length and abs(aside) <= sole.half_width:
            return point
    return nearest_inside(support_polygon(poses, sole), point)


def nearest_inside(polygon: Array, point: Array) -> Array:
    """Return the point (2,) of a convex polygon (M, 2), counter-clockwise, nearest to `point`."""
    x, y = point.tolist()
    corners = polygon.tolist()
    best, nearest, outside = float("inf"), (x, y), False
    for (ax, ay), (bx, by) in zip(corners, corners[1:] + corners[:1], strict=True):
        ex, ey = bx - ax, by - ay
        px, py = x - ax, y - ay
        if ex * py - ey * px >= 0.0:
            continue
        outside = True
        share = min(1.0, max(0.0, (px * ex + py * ey) / (ex * ex + ey * ey)))
        dx, dy = px - share * ex, py - share * ey
        distance = dx * dx + dy * dy
        if distance < best:
            best, nearest = distance, (ax + share * ex, ay + share * ey)
    return np.array(nearest) if outside else point
