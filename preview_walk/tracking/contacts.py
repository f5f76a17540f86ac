"""A sole on the ground: the wrench it can carry.

The wrench [force; moment] (N, N·m) acts on the robot at the sole's centre, in the sole's axes.
With coulomb friction under a rectangle it must lie in a cone of constant matrix (Caron, Pham and
Nakamura, ICRA 2015), which saves the QP from moving entries.
"""

from __future__ import annotations

import itertools
from collections.abc import Sequence

import numpy as np

from preview_walk.robots.robot import RobotSole
from preview_walk.types import Array

COP_MARGIN = 0.05
"""Share of the sole's half size, at each edge, that the centre of pressure keeps clear of."""

MIN_SHARE = 0.01
"""Least share of the load given to a sole in contact, so that its wrench has a finite weight."""

CONE_ROWS = 16
"""Rows of a wrench cone."""


def wrench_cone(half_length: float, half_width: float, friction: float) -> Array:
    """Return C (16, 6) such that C @ wrench <= 0 for every wrench that a sole can carry.

    The friction cone is its inscribed pyramid. Rows: 4 of friction, 4 of the centre of pressure, 8
    of the yaw moment (Caron, Pham and Nakamura, ICRA 2015, eqs. 8-15).

    Args:
        half_length: half size of the sole along its x axis, m.
        half_width: half size along its y axis, m.
        friction: Coulomb's coefficient.
    """
    x, y, mu = half_length, half_width, friction / np.sqrt(2.0)
    rows = [
        [1, 0, -mu, 0, 0, 0],
        [-1, 0, -mu, 0, 0, 0],
        [0, 1, -mu, 0, 0, 0],
        [0, -1, -mu, 0, 0, 0],
        [0, 0, -y, 1, 0, 0],
        [0, 0, -y, -1, 0, 0],
        [0, 0, -x, 0, 1, 0],
        [0, 0, -x, 0, -1, 0],
    ]
    # Yaw moment, side * mz <= mu (x + y) fz - |y fx + side mu mx| - |x fy + side mu my|.
    for side, a, b in itertools.product((1, -1), (1, -1), (1, -1)):
        rows.append([a * y, b * x, -mu * (x + y), side * a * mu, side * b * mu, side])
    return np.array(rows, dtype=float)


def sole_cone(sole: RobotSole, friction: float, edge: float = 0.0) -> Array:
    """Return the wrench cone (16, 6) of a robot's sole, shrunk by `COP_MARGIN` and an edge (m)."""
    keep = 1.0 - COP_MARGIN
    x, y = keep * sole.half_length - edge, keep * sole.half_width - edge
    return wrench_cone(x, y, friction)


def contact_rows(
    soles: Sequence[RobotSole], friction: float, edge: float = 0.0
) -> tuple[Array, Array, Array]:
    """Return C (17 k, 6 k), low and high (17 k,): low <= C @ wrenches <= high for k soles.

    Per sole the `CONE_ROWS` rows of its cone and a last one for the normal force, whose upper
    bound is infinite at first.
    """
    count = CONE_ROWS + 1
    rows = np.zeros((count * len(soles), 6 * len(soles)))
    low, high = np.full(len(rows), -np.inf), np.zeros(len(rows))
    for k, sole in enumerate(soles):
        rows[count * k : count * k + CONE_ROWS, 6 * k : 6 * k + 6] = sole_cone(sole, friction, edge)
        last = count * k + CONE_ROWS
        rows[last, 6 * k + 2], low[last], high[last] = 1.0, 0.0, np.inf
    return rows, low, high


def load_shares(
    zmp: Sequence[float], first: Sequence[float], second: Sequence[float]
) -> tuple[float, float]:
    """Return the shares of the load on two soles for a ZMP wanted.

    The lever rule: with these shares the ZMP lies where it is wanted without any moment under the
    soles, and the load leaves a sole before it lifts and comes upon it after it has landed.

    Args:
        zmp: (x, y) wanted, world, m.
        first: (x, y) of one sole's centre, m.
        second: (x, y) of the other's, m.
    """
    x, y = second[0] - first[0], second[1] - first[1]
    distance = x * x + y * y
    along = (zmp[0] - first[0]) * x + (zmp[1] - first[1]) * y
    share = along / distance if distance > 0.0 else 0.5
    share = min(1.0 - MIN_SHARE, max(MIN_SHARE, share))
    return 1.0 - share, share
