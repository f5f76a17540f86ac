"""The base's filter against its own linearisation, against the truth, and in slip."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from preview_walk.constants import GRAVITY
from preview_walk.estimation.base_filter import SIZE, BaseFilter, FilterNoise
from preview_walk.types import Array

DT = 0.002
NOISE = FilterNoise(
    gyro=0.004,
    accelerometer=0.05,
    gyro_walk=1e-5,
    accelerometer_walk=1e-4,
    gyro_bias=0.01,
    accelerometer_bias=0.05,
    contact=1e-3,
    turn=0.1,
    leg=1e-3,
    ground=0.01,
)


def started(tilt: float = 0.01) -> BaseFilter:
    """Return a filter of a base 1 m above two soles, away from the origin."""
    soles = np.array(((2.0, 1.1, 0.0), (2.1, 0.9, 0.0)))
    return BaseFilter(NOISE, np.eye(3), np.array((2.0, 1.0, 1.0)), soles, tilt)


def moved(base: BaseFilter, error: Array) -> BaseFilter:
    """Return the filter whose state is the truth if `error` (21,) is that of `base`."""
    other = started()
    other.rotation, other.vectors = base.rotation.copy(), base.vectors.copy()
    other.gyro_bias = base.gyro_bias.copy()
    other.accelerometer_bias = base.accelerometer_bias.copy()
    other._move(error)
    return other


def error_of(base: BaseFilter, truth: BaseFilter) -> Array:
    """Return the error (21,) of a filter against the truth, to first order."""
    turn = truth.rotation @ base.rotation.T
    vectors = truth.vectors - base.vectors @ turn.T
    return np.concatenate(
        (
            Rotation.from_matrix(turn).as_rotvec(),
            vectors.reshape(12),
            truth.gyro_bias - base.gyro_bias,
            truth.accelerometer_bias - base.accelerometer_bias,
        )
    )


def test_a_small_error_grows_as_the_covariance_has_it() -> None:
    """Column by column: the flow is the derivative of the motion by the error."""
    gyro, force = np.array((0.3, -0.5, 0.8)), np.array((1.0, -2.0, 10.5))
    for k in range(SIZE):
        error = np.zeros(SIZE)
        error[k] = 1e-6
        base = started()
        base.rotation = Rotation.from_rotvec((0.1, 0.2, 0.9)).as_matrix()
        base.vectors[0] = 0.4, 0.2, -0.1
        truth = moved(base, error)
        base.spread(DT, 1, (0.5, 0.5))
        base.predict(gyro, force, DT)
        truth.predict(gyro, force, DT)
        # Second order in the time of a tick is left out of the flow.
        np.testing.assert_allclose(error_of(base, truth), base._flow @ error, atol=1e-6 * 4e-5)


def test_a_turned_sole_place_is_seen_as_it_is() -> None:
    """Many exact readings take a wrong place of the soles away, and the height of the ground."""
    base, soles = started(), np.array(((2.02, 1.1, 0.004), (2.1, 0.92, 0.004)))
    for _ in range(3000):
        base.correct(soles - base.position, (0.004, 0.004))
    legs = base.vectors[2:] - base.position
    np.testing.assert_allclose(legs, soles - base.position, atol=1e-4)
    np.testing.assert_allclose(base.vectors[2:, 2], 0.004, atol=2e-4)


def swaying(seed: int, seconds: float) -> list[tuple[Array, Array]]:
    """Filter a swaying base with noisy signals; return errors (9,) and covariances (9, 9)."""
    rng = np.random.default_rng(seed)
    start = NOISE.gyro_bias * rng.standard_normal(3), 0.05 * rng.standard_normal(3)
    base, out = started(0.02), []
    base.rotation = Rotation.from_rotvec((*(0.02 * rng.standard_normal(2)), 0.0)).as_matrix()
    soles, w = base.vectors[2:].copy(), 4.0
    base.vectors[0] = np.array((0.0, 0.05 * w, 0.0)) + 0.02 * rng.standard_normal(3)
    for k in range(round(seconds / DT)):
        t0, t1 = k * DT, (k + 1) * DT
        spot = lambda t: np.array((2.0, 1.0 + 0.05 * np.sin(w * t), 1.0))  # noqa: E731
        turn = [Rotation.from_rotvec((0.0, 0.05 * np.sin(w * t), 0.0)) for t in (t0, t1)]
        speed = [0.05 * w * np.cos(w * t) for t in (t0, t1)]
        gyro = (turn[0].inv() * turn[1]).as_rotvec() / DT
        force = np.array((0.0, (speed[1] - speed[0]) / DT, GRAVITY))
        force = turn[0].inv().apply(0.5 * force) + turn[1].inv().apply(0.5 * force)
        base.predict(
            gyro + start[0] + NOISE.gyro * rng.standard_normal(3),
            force + start[1] + NOISE.accelerometer * rng.standard_normal(3),
            DT,
        )
        base.spread(DT, 1, (0.5, 0.5))
        legs = turn[1].inv().apply(soles - spot(t1)) + NOISE.leg * rng.standard_normal((2, 3))
        base.correct(legs, (None, None))
        velocity = np.array((0.0, speed[1], 0.0))
        out.append((base.error(turn[1].as_matrix(), velocity, spot(t1)), base.covariance[:9, :9]))
    return out


def test_a_wrong_start_converges() -> None:
    """Tilt and velocity come right, though biases and 0.02 rad of tilt were not known."""
    for seed in range(2):
        error, _ = swaying(seed, 4.0)[-1]
        assert np.abs(error[:2]).max() < 0.012
        assert np.abs(error[3:6]).max() < 0.01


def test_the_errors_are_those_that_the_covariance_says() -> None:
    """NEES of tilt and velocity: of a consistent filter its mean over runs is their number."""
    seen = [0, 1, 3, 4, 5]
    nees = []
    for seed in range(8):
        for error, p in swaying(seed, 1.0)[199::100]:
            e = error[seen]
            nees.append(float(e @ np.linalg.solve(p[np.ix_(seen, seen)], e)))
    assert 2.5 < np.mean(nees) < 7.5


def test_a_standing_leg_tells_the_bias_of_the_gyro() -> None:
    base, bias = started(), np.array((0.01, -0.02, 0.015))
    legs = base.vectors[2:] - base.position
    for _ in range(2000):
        base.predict(bias, np.array((0.0, 0.0, GRAVITY)), DT)
        base.spread(DT, 1, (0.5, 0.5))
        base.correct(legs, (None, None), [bias])
    np.testing.assert_allclose(base.gyro_bias, bias, atol=2e-3)


@pytest.mark.parametrize("load", [0.5, 0.0])
def test_a_sole_that_slips_does_not_throw_the_base(load: float) -> None:
    """5 cm within a tick, loaded or not: the base stays where the other sole has it."""
    base = started()
    soles = base.vectors[2:].copy()
    for k in range(400):
        base.predict(np.zeros(3), np.array((0.0, 0.0, GRAVITY)), DT)
        base.spread(DT, 1, (0.5, load))
        if k == 200:
            soles[1, 0] += 0.05
        base.correct(soles - np.array((2.0, 1.0, 1.0)), (None, None))
    assert np.abs(base.position - (2.0, 1.0, 1.0)).max() < 0.004
    assert np.abs(base.velocity).max() < 0.01
    assert base.vectors[3, 0] == pytest.approx(2.15, abs=0.005)
