"""Walks of robots as they are: the walk holds, the truth is kept, what fails is told."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from math import nan
from pathlib import Path

import numpy as np
import pytest

import preview_walk as pw
from preview_walk.robots.robot import Robot

COMMANDS = [((0.5, 0.0, 0.2), 3.0)]


@pytest.fixture(scope="module")
def walked(talos: Robot) -> pw.Record:
    return pw.simulate_commands(talos, COMMANDS, realism=pw.Realism.lab(), seed=1)


def test_a_laboratorys_robot_walks(walked: pw.Record) -> None:
    """Measured: CoM 3, 3, 3 mm, velocity 4, 3, 3 mm/s, drift 0.1 %."""
    summary = walked.summary()
    assert not summary.fell
    assert max(x for x in summary.com_error_rms if x is not None) < 0.01
    assert max(x for x in summary.velocity_error_rms or [] if x is not None) < 0.01
    assert (summary.drift or 0.0) < 0.02
    assert summary.refused == 0
    assert "base velocity off rms" in str(summary)


def test_truth_measurement_and_estimate_are_kept(walked: pw.Record, tmp_path: Path) -> None:
    sensed = walked.sensed
    assert sensed is not None
    assert np.abs(sensed.angles - walked.q[:, 7:]).max() < 0.05
    assert 1e-3 < np.abs(sensed.estimate_q[-1, :2] - walked.q[-1, :2]).max() < 0.05
    # The robot in the physics is another one than the model: its CoM is elsewhere.
    off = np.linalg.norm(sensed.true_com - walked.com, axis=1)
    assert 2e-3 < off.mean() < 0.03
    assert np.abs(sensed.motor_torque).max() <= max(walked.run.tau_max)
    assert walked.run.realism["imu"]["gyro_noise"] == 0.005
    again = pw.Record.load(walked.save(tmp_path / "r.npz"))
    assert again.differences(walked) == ()
    assert again.sensed is not None


def test_the_same_seed_is_the_same_robot(talos: Robot, walked: pw.Record) -> None:
    settings = {"realism": pw.Realism.lab()}
    walk = pw.Walk.standing(talos, seed=1, **settings)
    walk.schedule(COMMANDS)
    walk.run(until=1.0)
    same = walk.record()
    np.testing.assert_array_equal(same.q, walked.q[: len(same)])
    other = pw.Walk.standing(talos, seed=2, **settings).run(until=0.1).record()
    assert not np.array_equal(other.q, walked.q[: len(other)])


def test_perfect_parts_are_estimated_all_but_exactly(talos: Robot) -> None:
    """What is left is the delay of nothing and the filter's own: 1 mm/s, 1 mm."""
    record = pw.simulate_commands(talos, [((0.3, 0.0, 0.0), 1.0)], realism=pw.Realism())
    summary = record.summary()
    assert not summary.fell
    assert max(x for x in summary.velocity_error_rms or [] if x is not None) < 0.006
    assert max(x for x in summary.com_error_rms if x is not None) < 0.003


@pytest.fixture
def standing(talos: Robot) -> Callable[..., pw.Walk]:
    def make(*faults: pw.Fault) -> pw.Walk:
        return pw.Walk.standing(talos, realism=pw.Realism.lab().with_fault(*faults))

    return make


@pytest.mark.parametrize("value", [nan, 1e7])
@pytest.mark.parametrize("part", ["encoder", "speed", "gyro", "accelerometer"])
def test_a_reading_that_cannot_be_is_refused_and_counted(
    standing: Callable[..., pw.Walk], part: str, value: float
) -> None:
    walk = standing(pw.Fault(part, None, t=0.1, duration=0.0021, value=value))
    summary = walk.run(until=0.4).record().summary()
    assert not summary.fell
    assert 1 <= (summary.refused or 0) <= 4


def test_for_longer_the_walk_ends_and_says_why(standing: Callable[..., pw.Walk]) -> None:
    record = standing(pw.Fault("gyro", "z", t=0.1, value=nan)).run(until=1.0).record()
    assert record.run.fell
    assert "axis of the gyro 2 has given nothing that can be" in (record.run.fall_reason or "")
    assert 0.2 < (record.run.fall_time or 0.0) < 0.25


def test_a_wind_is_leant_against(talos: Robot) -> None:
    """A force of a twentieth of the weight to the left: the CoM stands to the right of the feet.

    By F z / (m g): 1/20 of the pendulum's height.
    """
    share = 0.05
    wind = pw.Push(0.5, 10.0, (0.0, share * talos.mass * talos.gravity, 0.0))
    lab = replace(pw.Realism.lab(), mismatch=pw.Mismatch())
    walk = pw.Walk.standing(talos, realism=lab, pushes=[wind])
    record = walk.run(until=6.0).record()
    assert not record.run.fell
    assert record.sensed is not None
    last = record.time > 5.0
    soles = 0.5 * (record.left_foot[last, 1, 3] + record.right_foot[last, 1, 3])
    lean = float(np.mean(record.com[last, 1] - soles))
    assert lean == pytest.approx(-share * 9.81 / record.run.omega**2, rel=0.25)
