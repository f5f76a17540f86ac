"""Sole sensors: their zero, their noise, and what stands in for a dead one."""

from __future__ import annotations

import numpy as np

from preview_walk.estimation.sole_forces import ForceNoise, SoleForces

WEIGHT, DT = 900.0, 0.002
HEIGHTS = np.zeros(2)


def read(left: float, right: float) -> np.ndarray:
    wrench = np.zeros((2, 6))
    wrench[:, 2] = left, right
    return wrench


def test_a_swinging_sole_feels_nothing_and_gets_its_zero() -> None:
    rng = np.random.default_rng(0)
    soles = SoleForces(WEIGHT, ForceNoise(0.01, 0.02))
    bias = 0.03 * WEIGHT
    for _ in range(300):
        noise = 0.01 * WEIGHT * rng.standard_normal(2)
        soles.update(read(bias + noise[0], WEIGHT + noise[1]), WEIGHT, HEIGHTS, DT)
        assert soles.loads[0] == 0.0
    soles.update(read(0.1 * WEIGHT + bias, 0.9 * WEIGHT), WEIGHT, HEIGHTS, DT)
    for _ in range(10):
        soles.update(read(0.1 * WEIGHT + bias, 0.9 * WEIGHT), WEIGHT, HEIGHTS, DT)
    assert abs(soles.loads[0] - 0.1) < 0.015


def test_a_dead_sensor_is_told_and_made_good_for() -> None:
    soles = SoleForces(WEIGHT, ForceNoise(0.01, 0.01))
    for _ in range(30):
        soles.update(read(0.0, 0.0), WEIGHT, np.array((0.0, 0.05)), DT)
    assert soles.dead == [True, False]
    np.testing.assert_allclose(soles.loads, (1.0, 0.0))
    for _ in range(30):
        soles.update(read(0.0, 0.4 * WEIGHT), WEIGHT, HEIGHTS, DT)
    np.testing.assert_allclose(soles.loads, (0.6, 0.4), atol=0.01)
    for _ in range(30):  # it comes back
        soles.update(read(0.5 * WEIGHT, 0.5 * WEIGHT), WEIGHT, HEIGHTS, DT)
    assert soles.dead == [False, False]


def test_a_base_that_is_lifted_by_a_swing_kills_no_sensor() -> None:
    soles = SoleForces(WEIGHT, ForceNoise(0.01, 0.01))
    for _ in range(100):
        soles.update(read(0.0, 0.98 * WEIGHT), 1.35 * WEIGHT, HEIGHTS, DT)
    assert soles.dead == [False, False]
    assert soles.loads[0] == 0.0
