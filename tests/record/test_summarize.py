"""The figures of a run, against a record whose figures are known in closed form."""

from __future__ import annotations

import dataclasses
import json
from pathlib import Path

import numpy as np
import pytest
from synthetic_walk import COM_ERROR, DT, GRAVITY, MASS, TAU_MAX, ZMP_ERROR, walk_record

from preview_walk.record.record import Record
from preview_walk.record.summary import Summary


@pytest.fixture(scope="module")
def record() -> Record:
    return walk_record(8)


@pytest.fixture(scope="module")
def summary(record: Record) -> Summary:
    return record.summary()


def test_errors_are_those_the_record_was_made_with(summary: Summary) -> None:
    np.testing.assert_allclose(summary.com_error_rms, np.abs(COM_ERROR), atol=1e-12)
    np.testing.assert_allclose(summary.zmp_error_rms, np.abs(ZMP_ERROR), atol=1e-12)
    assert summary.final_position_error == pytest.approx(0.005)  # a 3-4-5 triangle, in mm
    assert summary.final_yaw_error == pytest.approx(0.0, abs=1e-12)


def test_outcome_time_and_steps(summary: Summary, record: Record) -> None:
    assert not summary.fell
    assert summary.fall_time is None
    assert summary.duration == pytest.approx(len(record) * DT)
    assert summary.steps == 8
    assert summary.real_time_factor == pytest.approx(len(record) * DT / 2.0)


def test_distance_and_speed_leave_out_the_sway(summary: Summary, record: Record) -> None:
    # Seven step lengths; the sway of 3 cm puts a few mm into the first and the last chord.
    assert summary.distance == pytest.approx(7 * 0.25, abs=0.006)
    plan = record.plans[-1]
    constant = 7 * 0.25 / (plan.landings[-1] - plan.lifts[0])
    assert summary.speed == pytest.approx(constant, rel=1e-3)


@pytest.mark.parametrize("n_steps", range(1, 9))
def test_speed_takes_whole_strides_only(n_steps: int) -> None:
    record = walk_record(n_steps)
    plan = record.plans[-1]
    constant = (n_steps - 1) * 0.25 / (plan.landings[-1] - plan.lifts[0])
    speed = record.summary().speed
    assert speed is None if n_steps < 3 else speed == pytest.approx(constant, rel=1e-3)


def test_distance_follows_a_circle() -> None:
    record = walk_record(8)
    angle = np.linspace(0, 2 * np.pi, len(record))
    com = np.column_stack([np.cos(angle), np.sin(angle), np.ones_like(angle)])
    circle = dataclasses.replace(record, com=com)
    assert 0.75 * 2 * np.pi < circle.summary().distance < 2 * np.pi


def test_effort(summary: Summary, record: Record) -> None:
    assert summary.torque_ratio_max == pytest.approx(45.0 / TAU_MAX[1], rel=1e-3)
    hip, knee = record.tau[:, 0], record.tau[:, 1]
    work = float(np.sum(np.abs(hip) * 0.5 + np.abs(knee) * 1.0)) * DT
    assert summary.cost_of_transport == pytest.approx(
        work / (MASS * GRAVITY * summary.distance), rel=1e-9
    )


def test_braking_costs_nothing_of_the_positive_work(record: Record) -> None:
    n = len(record)
    rates = np.zeros((n, 9))
    rates[:, 6], rates[:, 7] = 2.0, -3.0
    torques = np.tile([10.0, 5.0, 0.0], (n, 1))  # 20 W drive, 15 W brake
    summary = dataclasses.replace(record, v=rates, tau=torques).summary()
    assert summary.cost_of_transport is not None
    assert summary.cost_of_transport_positive is not None
    energy = n * DT / (MASS * GRAVITY * summary.distance)
    assert summary.cost_of_transport == pytest.approx(35.0 * energy, rel=1e-12)
    assert summary.cost_of_transport_positive == pytest.approx(20.0 * energy, rel=1e-12)


def test_infinite_values_give_a_summary_that_can_be_written(record: Record, tmp_path: Path) -> None:
    com, tau = record.com.copy(), record.tau.copy()
    com[-1], tau[5] = np.inf, np.inf
    broken = dataclasses.replace(record, com=com, tau=tau).with_run(wall_time=1e-320)
    path = broken.summary().write(tmp_path / "summary.json")
    read = json.loads(path.read_text(), parse_constant=pytest.fail)
    assert read["distance"] is None
    assert read["cost_of_transport"] is None


def test_share_of_the_qps_that_the_solver_solved_itself(record: Record) -> None:
    status, solver = record.qp_status.copy(), record.qp_solver.copy()
    solver[:10] = 1
    status[:5] = 1  # not solved at all: they do not count
    summary = dataclasses.replace(record, qp_status=status, qp_solver=solver).summary()
    assert summary.qp_own_share == pytest.approx(1.0 - 5 / (len(record) - 5))
    unknown = dataclasses.replace(record, qp_solver=np.full_like(solver, -1)).summary()
    assert unknown.qp_own_share is None


def test_timings_and_failures(record: Record) -> None:
    status = record.qp_status.copy()
    status[[3, 5]] = 1, 2
    ticks = np.full(len(record), 3e-4)
    ticks[0] = 9e-4
    summary = dataclasses.replace(record, qp_status=status, tick_time=ticks).summary()
    assert summary.qp_failures == 2
    assert summary.qp_own_share == 1.0
    assert summary.tick_ms == pytest.approx({"median": 0.3, "p99": 0.3, "max": 0.9})
    assert summary.qp_ms == pytest.approx({"median": 0.15, "p99": 0.15, "max": 0.15})


def test_figures_do_not_depend_on_where_the_robot_stands_and_faces(summary: Summary) -> None:
    there = dataclasses.asdict(walk_record(8, start=(100.0, -50.0, np.radians(137))).summary())
    for key, value in dataclasses.asdict(summary).items():
        if isinstance(value, list):
            np.testing.assert_allclose(there[key], value, atol=1e-9)
        else:
            assert there[key] == pytest.approx(value, abs=1e-9), key


def test_a_turned_foot_is_an_error_wrapped(record: Record) -> None:
    pose = record.left_foot.copy()
    angle = 0.1 - 2 * np.pi
    c, s = np.cos(angle), np.sin(angle)
    pose[-1, :2, :2] = [[c, -s], [s, c]]
    turned = dataclasses.replace(record, left_foot=pose).summary()
    assert turned.final_yaw_error == pytest.approx(0.1)


def test_a_fall_stops_the_count_of_steps(record: Record) -> None:
    time = float(record.plans[-1].landings[2]) + 0.01
    fallen = record.with_run(fell=True, fall_time=time, fall_reason="the torso tilted")
    summary = fallen.summary()
    assert (summary.fell, summary.fall_time, summary.steps) == (True, time, 3)
    assert f"FELL at {time:.2f} s: the torso tilted" in str(summary)


def test_an_interrupted_walk_has_no_final_error(record: Record) -> None:
    half = {name: array[: len(record) // 2] for name, array in record.arrays().items()}
    stopped = dataclasses.replace(record, **half).with_run(interrupted=True)
    assert stopped.summary().final_position_error is None
    assert record.with_run(interrupted=True).summary().final_position_error is not None


def test_flight_and_what_was_not_measured_is_left_out(record: Record) -> None:
    zmp = record.zmp.copy()
    zmp[10:20] = np.nan
    assert dataclasses.replace(record, zmp=zmp).summary().zmp_error_rms == pytest.approx(
        np.abs(ZMP_ERROR).tolist()
    )
    never = np.full_like(record.zmp, np.nan)
    times = np.full(len(record), np.nan)
    bare = dataclasses.replace(record, zmp=never, tick_time=times).with_run(
        wall_time=None, tau_max=[0.0, 0.0, 0.0]
    )
    summary = bare.summary()
    assert summary.zmp_error_rms == [None, None]
    assert summary.tick_ms is None
    assert summary.real_time_factor is None
    assert summary.torque_ratio_max is None


def test_one_tick_has_a_summary_without_speed() -> None:
    record = walk_record(4)
    first = dataclasses.replace(
        record, **{name: array[:1] for name, array in record.arrays().items()}
    )
    summary = first.summary()
    assert summary.steps == 0
    assert summary.speed is None
    assert summary.cost_of_transport is None
