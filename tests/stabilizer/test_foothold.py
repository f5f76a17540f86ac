"""The best footholds are those that a solver of bounded least squares finds."""

from __future__ import annotations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import lsq_linear

from preview_walk.stabilizer.foothold import (
    CARRY_WEIGHT,
    KEEP_WEIGHT,
    MISS_WEIGHT,
    STEP_WEIGHT,
    ZMP_WEIGHT,
    Room,
    Wanted,
    best_footholds,
)
from preview_walk.types import Array

TIMES = 4


@given(st.integers(0, 2**32 - 1), st.sampled_from([0.02, 0.2, 1.0]))
@settings(max_examples=60, deadline=None)
def test_they_are_the_optimum_of_bounded_least_squares(seed: int, size: float) -> None:
    rng = np.random.default_rng(seed)
    free, lever = rng.normal(0.0, size, (TIMES, 2)), rng.uniform(0.02, 4.0, (TIMES, 1))
    wanted = Wanted(*rng.normal(0.0, 0.2, (3, 2)))
    low = rng.normal(0.0, 0.2, (TIMES, 2))
    box = (low, low + rng.uniform(0.0, 0.4, (TIMES, 2)))
    room = Room(box, tuple(rng.uniform(0.0, 0.2, (2, 2)) * [[-1], [1]]), rng.uniform(0.01, 0.1, 2))
    place, cost = best_footholds(free, lever, wanted, room)
    for time in range(TIMES):
        total = 0.0
        for axis in range(2):
            best, least = _optimum(free, lever, wanted, room, (time, axis))
            total += least
            np.testing.assert_allclose(place[time, axis], best, atol=1e-6)
        np.testing.assert_allclose(cost[time], total, rtol=1e-6, atol=1e-9)


def test_what_lies_within_reach_of_the_zmp_alone_moves_the_foot_by_next_to_nothing() -> None:
    box = (np.full((1, 2), -1.0), np.full((1, 2), 1.0))
    room = Room(box, (np.zeros(2), np.zeros(2)), np.full(2, 0.1))
    still = Wanted(np.zeros(2), np.zeros(2), np.zeros(2))
    place, _ = best_footholds(np.array([[0.05, -0.05]]), np.ones((1, 1)), still, room)
    # The foot and the ZMP share the way by their weights, 3 to 0.05.
    assert 0.0 < place[0, 0] < 0.05 * ZMP_WEIGHT / (STEP_WEIGHT + KEEP_WEIGHT)
    np.testing.assert_allclose(place[0, 1], -place[0, 0], rtol=1e-12)


def _optimum(
    free: Array, lever: Array, wanted: Wanted, room: Room, at: tuple[int, int]
) -> tuple[float, float]:
    """Return foothold and cost by `scipy.optimize.lsq_linear`, at one time and axis."""
    time, axis = at
    miss, step, keep, zmp, carry = np.sqrt(
        [MISS_WEIGHT, STEP_WEIGHT, KEEP_WEIGHT, ZMP_WEIGHT, CARRY_WEIGHT]
    )
    rows = np.array(
        [
            [miss, miss * lever[time, 0], miss],
            [step, 0.0, 0.0],
            [keep, 0.0, 0.0],
            [0.0, zmp, 0.0],
            [0.0, 0.0, carry],
        ]
    )
    right = np.array(
        [
            miss * (free[time, axis] - wanted.offset[axis]),
            step * wanted.goal[axis],
            keep * wanted.current[axis],
            0.0,
            0.0,
        ]
    )
    low = [room.box[0][time, axis], -room.half[axis], room.carried[0][axis]]
    high = [room.box[1][time, axis], room.half[axis], room.carried[1][axis]]
    found = lsq_linear(
        rows, right, (np.array(low) - 1e-12, np.array(high) + 1e-12), tol=1e-14, method="bvls"
    )
    return float(found.x[0]), 2.0 * float(found.cost)
