"""The best foothold of each landing time: a small convex problem an axis, solved exactly.

The DCM lands at free - lever delta, where delta is how far the ZMP moves from the stance sole's
centre meanwhile. What it is there off the foothold is the plan's offset, a part that the next step
can carry, and a miss:

    free - lever delta = foothold + offset + carry + miss

The cost, miss, foothold, delta and carry squared and weighted, has foothold, delta and carry in a
box. For a given miss the best of each is that miss times a constant, cut to its bounds, so that the
equation above holds for one miss only: it is where a rising, piecewise straight function is zero.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from preview_walk.types import Array

MISS_WEIGHT, STEP_WEIGHT, ZMP_WEIGHT, CARRY_WEIGHT = 100.0, 1.0, 0.05, 2.0
"""Weights of a squared metre of DCM missed, of foothold beside the commanded one, of ZMP, and of
the offset that the next step carries: the miss comes first."""

KEEP_WEIGHT = 2.0
"""Weight of a squared metre by which a changed foothold changes again: the foot cannot dither."""


@dataclass(frozen=True, eq=False)
class Room:
    """What an answer may use, in the stance foot's axes.

    Attributes:
        box: lowest and highest footholds, (N, 2) each, m.
        carried: lowest and highest offset that the next step can catch, (2,) each, m.
        half: (2,) largest shift of the ZMP, m.
    """

    box: tuple[Array, Array]
    carried: tuple[Array, Array]
    half: Array


@dataclass(frozen=True, eq=False)
class Wanted:
    """Where the foot and the DCM would be, (2,) each, m, in the stance foot's axes.

    Attributes:
        goal: the foothold that was commanded.
        current: that of the plan as it is now.
        offset: of the DCM from the foothold.
    """

    goal: Array
    current: Array
    offset: Array


def best_footholds(free: Array, lever: Array, wanted: Wanted, room: Room) -> tuple[Array, Array]:
    """Return the best foothold (N, 2) of each landing time, m, and its cost (N,).

    Args:
        free: (N, 2) where the DCM is at landing with the ZMP at the stance foot's centre, m.
        lever: (N, 1) how far a ZMP 1 m from there moves it, above 0.
        wanted: where foot and DCM would be.
        room: what may be used.
    """
    towards = STEP_WEIGHT * wanted.goal + KEEP_WEIGHT * wanted.current
    stiff, away = STEP_WEIGHT + KEEP_WEIGHT, free - wanted.offset
    by_zmp = MISS_WEIGHT / ZMP_WEIGHT * lever
    by_carry = MISS_WEIGHT / CARRY_WEIGHT

    def answer(miss: Array) -> tuple[Array, Array, Array]:
        """Return foothold, ZMP shift and carry that a miss (..., N, 2) is worth."""
        place, delta, carry = (towards + MISS_WEIGHT * miss) / stiff, by_zmp * miss, by_carry * miss
        for part, low, high in (
            (place, *room.box),
            (delta, -room.half, room.half),
            (carry, *room.carried),
        ):
            np.maximum(part, low, out=part)
            np.minimum(part, high, out=part)
        return place, delta, carry

    # The function is straight between the misses at which one of the three meets a bound.
    bends = np.empty((6, *free.shape))
    for at, bound in enumerate(room.box):
        bends[at] = (stiff * bound - towards) / MISS_WEIGHT
    bends[2] = -room.half / by_zmp
    bends[3] = room.half / by_zmp
    for at, bound in enumerate(room.carried):
        bends[4 + at] = bound / by_carry
    bends.sort(axis=0)
    place, delta, carry = answer(bends)
    miss = _zero(bends, bends + place + lever * delta + carry - away)
    place, delta, carry = answer(miss)
    cost = (
        MISS_WEIGHT * miss**2
        + STEP_WEIGHT * (place - wanted.goal) ** 2
        + KEEP_WEIGHT * (place - wanted.current) ** 2
        + ZMP_WEIGHT * delta**2
        + CARRY_WEIGHT * carry**2
    )
    return place, cost.sum(axis=1)


def _zero(bends: Array, values: Array) -> Array:
    """Return where functions (N, 2) are zero that rise and are straight between bends (B, N, 2).

    `values`: (B, N, 2) of the functions there; beyond the first and the last bend the slope is one.
    """
    shape, last = bends.shape[1:], len(bends) - 1
    bends, values = bends.reshape(last + 1, -1), values.reshape(last + 1, -1)
    each = np.arange(bends.shape[1])
    after = (values < 0.0).sum(axis=0)
    here, there = np.maximum(after - 1, 0), np.minimum(after, last)
    beyond = here == there
    x, y = bends[here, each], values[here, each]
    run = np.where(beyond, 1.0, bends[there, each] - x)
    rise = np.where(beyond, 1.0, values[there, each] - y)
    zero: Array = (x - y * run / rise).reshape(shape)
    return zero
