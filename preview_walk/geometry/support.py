"""Sole rectangles, the support polygon they span, and signed distances to it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import cos, sin

import numpy as np
from numpy.typing import ArrayLike

from preview_walk.arguments import positive_number
from preview_walk.errors import InvalidInput
from preview_walk.geometry.poses import Heading
from preview_walk.types import Array


@dataclass(frozen=True)
class Sole:
    """Half sizes of the sole rectangle around the origin of the sole frame.

    Attributes:
        half_length: half of the extent along the sole's x axis (heel to toe), m.
        half_width: half of the extent along the sole's y axis, m.

    Raises:
        InvalidInput: a size that is not finite and positive.
    """

    half_length: float = 0.1
    half_width: float = 0.045

    def __post_init__(self) -> None:
        """Check the sizes."""
        for name in ("half_length", "half_width"):
            size = positive_number(getattr(self, name), name, "m")
            object.__setattr__(self, name, size)

    def corners(self, pose: Array) -> Array:
        """Return the corners (4, 3) in the world, m, counter-clockwise from the front left.

        Args:
            pose: sole pose (4, 4).
        """
        x = self.half_length * pose[:3, 0]
        y = self.half_width * pose[:3, 1]
        centre = pose[:3, 3]
        return np.array([centre + x + y, centre - x + y, centre - x - y, centre + x - y])


def support_polygon(poses: Sequence[Array], sole: Sole) -> Array:
    """Return the support polygon of the standing soles, seen from above.

    The convex hull of the horizontal projection of all sole corners: the set of horizontal
    positions of the ZMP for which contact forces exist, also on soles that are turned, sloped or
    at different heights.

    Args:
        poses: sole poses (4, 4) of the standing feet, at least one.
        sole: half sizes of the soles.

    Returns:
        Vertices (M, 2), m, counter-clockwise, M >= 3.

    Raises:
        InvalidInput: no foot stands.
    """
    if not poses:
        raise InvalidInput(
            "a support polygon needs at least one standing sole, got none.", argument="poses"
        )
    points = sorted({(float(c[0]), float(c[1])) for pose in poses for c in sole.corners(pose)})
    return np.array(_half_hull(points)[:-1] + _half_hull(points[::-1])[:-1])


def _half_hull(points: list[tuple[float, float]]) -> list[tuple[float, float]]:
    """Return one chain of the hull of sorted points (Andrew's monotone chain)."""
    chain: list[tuple[float, float]] = []
    for p in points:
        while len(chain) >= 2:
            (ax, ay), (bx, by) = chain[-2], chain[-1]
            if (bx - ax) * (p[1] - ay) - (by - ay) * (p[0] - ax) > 0.0:
                break
            chain.pop()
        chain.append(p)
    return chain


def support_margin(polygon: Array, points: ArrayLike) -> Array:
    """Return the signed distance from points to the edge of a convex polygon, m.

    Positive inside (the distance to the nearest edge), negative outside (minus the distance to
    the polygon).

    Args:
        polygon: vertices (M, 2), counter-clockwise.
        points: (2,) or (N, 2), m.

    Returns:
        () or (N,).
    """
    p = np.asarray(points, dtype=np.float64)[..., None, :]
    start = polygon
    edge = np.concatenate((polygon[1:], polygon[:1])) - start
    length = np.hypot(edge[:, 0], edge[:, 1])
    offset = p - start
    left = (edge[:, 0] * offset[..., 1] - edge[:, 1] * offset[..., 0]) / length
    inside = left.min(axis=-1)
    share = np.clip((offset * edge).sum(axis=-1) / length**2, 0.0, 1.0)
    nearest = offset - share[..., None] * edge
    outside = np.hypot(nearest[..., 0], nearest[..., 1]).min(axis=-1)
    return np.asarray(np.where(inside >= 0.0, inside, -outside))


def sole_gap(a: Heading, b: Heading, sole: Sole) -> float:
    """Return the gap (m) between two turned sole rectangles seen from above; negative: overlap.

    The largest separation along the sides' normals (separating axis theorem): exact where a side
    faces the other sole, a lower bound of the distance where two corners do.

    Args:
        a: one sole's x, y (m) and yaw (rad).
        b: the other's.
        sole: half sizes of both.
    """
    dx, dy, turn = b[0] - a[0], b[1] - a[1], b[2] - a[2]
    ct, st = abs(cos(turn)), abs(sin(turn))
    # Extent of the other rectangle along this one's axes, the same for both by symmetry.
    along = sole.half_length + sole.half_length * ct + sole.half_width * st
    across = sole.half_width + sole.half_length * st + sole.half_width * ct
    c, s = cos(a[2]), sin(a[2])
    u, v = cos(b[2]), sin(b[2])
    return max(
        abs(c * dx + s * dy) - along,
        abs(c * dy - s * dx) - across,
        abs(u * dx + v * dy) - along,
        abs(u * dy - v * dx) - across,
    )


def within_support(point: Array, poses: Sequence[Array], sole: Sole) -> Array:
    """Return the point (2,) of the support polygon of standing soles nearest to a point.

    Args:
        point: (2,), m.
        poses: sole poses (4, 4) of the standing feet, at least one.
        sole: half sizes of the soles.
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
    """Return the point (2,) of a convex polygon nearest to a point; the point itself inside.

    Args:
        polygon: vertices (M, 2), counter-clockwise.
        point: (2,), m.
    """
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
