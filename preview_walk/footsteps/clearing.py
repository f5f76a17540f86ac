"""The shape of a swing that clears what lies between its two soles.

The ground that the whole sole passes over gives the least height of the sole at every place of its
way. Of many shapes the gentlest whose path is above that is taken: over an edge upwards the foot
rises first, over an edge downwards it travels first.
"""

from __future__ import annotations

from itertools import product
from math import cos, sin

import numpy as np

from preview_walk.footsteps.swing_shape import LONGEST_WAIT, PLAIN, SwingShape
from preview_walk.geometry.planar import wrap
from preview_walk.geometry.poses import rpy_of
from preview_walk.geometry.support import Sole
from preview_walk.terrain.ground import Ground
from preview_walk.types import Array

MARGIN = 0.02
"""A sole passes over the ground at least so high (m) around its apex, less towards its ends."""

ASIDE = 0.008
"""And at least so far (m) beside edges that are higher."""

SUNK = 0.005
"""A sole that lies on uneven ground may be so deep (m) in its highest points at lift and landing,
where it has not risen yet: what a foothold is allowed to be uneven, and its rim."""

LEAST_HEIGHT = 0.04
"""Height (m) of an apex above the higher sole, at least, that every swing is taken to have."""

_PLACES = np.linspace(0.0, 1.0, 81)
"""Shares of the way at which the ground is looked at: nearer to each other than `ASIDE`."""

_TIMES = np.linspace(0.0, 1.0, 41)[1:-1]
"""Shares of the swing's time at which the path is looked at."""

_WAITS = tuple(
    (a, b)
    for a, b in product(np.arange(0.0, 0.55, 0.05).round(2).tolist(), repeat=2)
    if a + b <= LONGEST_WAIT - 0.1
)
_SHAPES = np.array(
    [
        (LEAST_HEIGHT + extra, before, after, apex)
        for extra in (0.0, 0.02, 0.04, 0.08, 0.12, 0.2)
        for before, after in _WAITS
        for apex in (0.3, 0.4, 0.5, 0.6, 0.7)
    ]
)
"""Height (m), before, after and apex of the shapes that are tried."""

_TRIED = 64
"""So many shapes are looked at together, the gentlest first."""


def _share(u: Array) -> Array:
    """Return the share of a quintic's way from rest to rest that is done at share u of its time."""
    u = u.clip(0.0, 1.0)
    share: Array = u * u * u * (10.0 - u * (15.0 - 6.0 * u))
    return share


def clearing_shape(start: Array, end: Array, ground: Ground, sole: Sole) -> SwingShape:
    """Return the gentlest shape of a swing that clears the ground.

    Where none does it is the one that comes nearest to it.

    Args:
        start: sole pose (4, 4) at lift, on the ground.
        end: sole pose (4, 4) at landing, on the ground.
        ground: what lies between.
        sole: half sizes, m.
    """
    z0, z1 = float(start[2, 3]), float(end[2, 3])
    least = _least_heights(start, end, ground, sole)
    line = (1.0 - _PLACES) * z0 + _PLACES * z1
    if (least - line).max() < 1e-3 and abs(z1 - z0) < LEAST_HEIGHT:
        return PLAIN
    distance = float(np.hypot(*(end[:2, 3] - start[:2, 3])))
    order = np.argsort(_effort(distance, z0, z1), kind="stable")
    best, found = -np.inf, PLAIN
    for first in range(0, len(order), _TRIED):
        shapes = _SHAPES[order[first : first + _TRIED]]
        room = _room(shapes, z0, z1, least)
        clear = int((room > -1e-3).argmax())
        if room[clear] > -1e-3:
            return SwingShape(*shapes[clear].tolist())
        if room.max() > best + SUNK:  # a gentler shape is as good
            best, found = room.max(), SwingShape(*shapes[int(room.argmax())].tolist())
    return found


def _effort(distance: float, z0: float, z1: float) -> Array:
    """Return the square (S,) of the largest acceleration of each shape, in m^2 per time^4."""
    height, before, after, apex = _SHAPES.T
    top = max(z0, z1) + height
    way = distance / (1.0 - before - after) ** 2
    vertical = np.maximum((top - z0) / apex**2, (top - z1) / (1.0 - apex) ** 2)
    effort: Array = way**2 + vertical**2
    return effort


def _room(shapes: Array, z0: float, z1: float, least: Array) -> Array:
    """Return by how much (S,), m, the path of each shape is above where it must be, at least."""
    height, before, after, apex = shapes.T[:, :, None]
    way = _share((_TIMES - before) / (1.0 - before - after))
    risen, fallen = _share(_TIMES / apex), _share((_TIMES - apex) / (1.0 - apex))
    top = max(z0, z1) + height
    path = z0 + (top - z0) * risen + (z1 - top) * fallen
    high = risen - fallen  # 0 at lift and landing, 1 at the apex
    room: Array = path - np.interp(way, _PLACES, least) - MARGIN * high + SUNK * (1.0 - high) ** 8
    return np.asarray(room.min(axis=1))


def _least_heights(start: Array, end: Array, ground: Ground, sole: Sole) -> Array:
    """Return the height (K,) of the sole's centre at which it touches the ground on its way."""
    r0, p0, y0 = rpy_of(start)
    r1, p1, y1 = rpy_of(end)
    length, width = sole.half_length + ASIDE, sole.half_width + ASIDE
    grid = np.array(list(product(np.linspace(-length, length, 9), (-width, 0.0, width))))
    s = _PLACES[:, None]
    yaw = y0 + s * wrap(y1 - y0)
    x = start[0, 3] + s * (end[0, 3] - start[0, 3]) + np.cos(yaw) * grid[:, 0]
    x -= np.sin(yaw) * grid[:, 1]
    y = start[1, 3] + s * (end[1, 3] - start[1, 3]) + np.sin(yaw) * grid[:, 0]
    y += np.cos(yaw) * grid[:, 1]
    # A tilted sole's points are higher or lower than its centre.
    tilt = np.array(((-sin(p0), sin(r0) * cos(p0)), (-sin(p1), sin(r1) * cos(p1))))
    above = ((1.0 - s) * tilt[0] + s * tilt[1]) @ grid.T
    least: Array = (ground.height(x, y) - above).max(axis=1)
    return least
