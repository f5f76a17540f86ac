"""Walking by velocity commands: the robot does what it is told, whenever it is told."""

from __future__ import annotations

import importlib.util
import re
import sys
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest

import preview_walk as pw
from preview_walk.errors import InvalidInput
from preview_walk.footsteps.plan import FootstepPlan
from preview_walk.footsteps.velocity import follow_velocity
from preview_walk.geometry.poses import pose_at
from preview_walk.record.record import Record
from preview_walk.robots.robot import Robot
from preview_walk.simulation.commands import FORGET, VelocityCommands


def benchmark(name: str) -> ModuleType:
    """Return a file of `benchmarks/`, whose folder is on no path: its names are those of rooms."""
    path = Path(__file__).parents[2] / "benchmarks" / f"{name}.py"
    spec = importlib.util.spec_from_file_location(name, path)
    assert spec is not None
    assert spec.loader is not None
    module = sys.modules[name] = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture(scope="module")
def study() -> ModuleType:
    """Return the benchmark of which these tests are a sample: 20 sequences and long walks."""
    benchmark("campaign")
    return benchmark("command_study")


def assert_on_plan(record: Record) -> None:
    """Hold a walk to 5 cm and 3 degrees of where its plan ends, without a fall or a lost QP."""
    summary = record.summary()
    assert not summary.fell, summary.fall_reason
    assert summary.final_position_error is not None
    assert summary.final_yaw_error is not None
    assert summary.final_position_error <= 0.05
    assert summary.final_yaw_error <= np.radians(3.0)
    assert summary.qp_failures == 0


def mean_velocity(record: Record, start: float, end: float) -> float:
    """Return the CoM's mean forward speed between two times (s)."""
    a, b = np.searchsorted(record.time, (start, end))
    return float(record.com[b, 0] - record.com[a, 0]) / (end - start)


@pytest.mark.parametrize("seed", [4, 16])
def test_obeys_random_commands_at_random_times(talos: Robot, study: ModuleType, seed: int) -> None:
    """Twenty seconds of them; and it walks where pure planning, without a robot, says."""
    table = study.random_commands(seed)
    record = study.obey(talos, table)
    assert_on_plan(record)
    walk = pw.Walk.standing(talos)
    plan, limits = walk.plan, walk.limits
    soles = replayed(plan, table, limits, record)
    for foot in ("left", "right"):
        off = record.plans[-1].last_pose(foot)[:3, 3] - soles.sole(foot, np.inf)[:3, 3]
        assert np.linalg.norm(off) <= 0.05


def replayed(
    plan: FootstepPlan, table: list[tuple[float, tuple[float, ...]]], limits: object, record: Record
) -> FootstepPlan:
    """Return the last plan of a walk that nothing disturbs: planned again at every lift."""
    due, command, obey_at = list(table), (0.0, 0.0, 0.0), np.inf
    for t in record.time.tolist():
        told = bool(due) and t >= due[0][0] - 1e-9
        if told:
            command = due.pop(0)[1]  # type: ignore[assignment]
        if told or t >= obey_at:
            plan = follow_velocity(plan, t, command, limits)  # type: ignore[arg-type]
            lift = plan.next_lift(t)
            obey_at = lift.lift + 1e-3 if any(command) and lift is not None else np.inf
    return plan


def test_goes_backwards_and_stops_when_told(talos: Robot) -> None:
    """0, 0.5, -0.2, 0 m/s at instants that have nothing to do with steps."""
    walk = pw.Walk.standing(talos)
    for time, speed in ((0.37, 0.5), (5.631, -0.2), (11.777, 0.0)):
        walk.run(until=time)
        walk.command(speed, 0.0, 0.0)
    record = walk.run().record()
    assert_on_plan(record)
    assert np.abs(record.com_velocity[record.time < 0.3]).max() < 0.02
    assert mean_velocity(record, 4.1, 5.6) == pytest.approx(0.5, rel=0.07)
    assert mean_velocity(record, 9.5, 11.7) == pytest.approx(-0.2, rel=0.07)
    assert np.abs(record.com_velocity[-200:]).max() < 0.01
    assert np.abs(record.com[:, 1]).max() < 0.1


def test_holds_a_metre_a_second(talos: Robot) -> None:
    record = pw.simulate_commands(talos, [((1.0, 0.0, 0.0), 10.0)])
    assert_on_plan(record)
    speed = record.summary().speed
    assert speed is not None
    assert speed >= 0.95
    assert mean_velocity(record, 7.0, 10.0) >= 0.95


def test_turns_and_walks_on_a_circle(talos: Robot) -> None:
    """Half a circle of 1 m radius by command."""
    record = pw.simulate_commands(talos, [((0.3, 0.0, 0.3), 10.5)])
    assert_on_plan(record)
    feet = 0.5 * (record.left_foot + record.right_foot)[:, :2, 3]
    walked = feet[np.abs(np.gradient(feet[:, 0])) + np.abs(np.gradient(feet[:, 1])) > 1e-5]
    rows = np.column_stack([walked, np.ones(len(walked))])
    x, y, c = np.linalg.lstsq(rows, -(walked**2).sum(axis=1), rcond=None)[0]
    radius = np.sqrt(0.25 * (x * x + y * y) - c)
    assert radius == pytest.approx(1.0, abs=0.08)
    yaw = np.unwrap(np.arctan2(record.left_foot[:, 1, 0], record.left_foot[:, 0, 0]))
    assert yaw[-1] > 2.4


@pytest.mark.parametrize(
    ("command", "moved"),
    [((0.0, 0.12, 0.0), (0.0, 1.0, 0.0)), ((0.0, 0.0, -0.5), (0.0, 0.0, -1.0))],
)
def test_sidesteps_and_turns_on_the_spot(
    talos: Robot, command: tuple[float, float, float], moved: tuple[float, float, float]
) -> None:
    record = pw.simulate_commands(talos, [(command, 6.0)])
    assert_on_plan(record)
    feet = [record.plans[-1].last_pose(foot) for foot in ("left", "right")]
    x, y = 0.5 * (feet[0] + feet[1])[:2, 3]
    yaw = np.arctan2(feet[0][1, 0], feet[0][0, 0])
    off = np.array((x, y, yaw))
    assert off @ moved > 0.4
    assert np.abs(off - (off @ moved) * np.array(moved)).max() < 0.1


def test_a_command_takes_over_from_a_plan(talos: Robot, short_plan: FootstepPlan) -> None:
    walk = pw.Walk(talos, short_plan)
    walk.run(until=short_plan.steps[1].lift + 0.1)
    walk.command(0.0, 0.0, 0.0)
    record = walk.run().record()
    assert_on_plan(record)
    assert len(record.plans) == 2
    assert record.plans[-1].end < short_plan.end


def test_a_command_to_stand_changes_nothing(talos: Robot) -> None:
    walk = pw.Walk.standing(talos)
    plan = walk.plan
    walk.command(0.0, 0.0, 0.0)
    assert walk.plan is plan
    walk.run(until=0.1)
    assert len(walk.record().plans) == 1


def test_a_refused_command_leaves_the_walk_as_it_was(talos: Robot) -> None:
    walk = pw.Walk.standing(talos)
    walk.command(0.2, 0.0, 0.0)
    plan = walk.plan
    with pytest.raises(InvalidInput, match=r"^vy must be finite \(m/s\), got nan\.$"):
        walk.command(0.1, float("nan"), 0.0)
    assert walk.plan is plan
    walk.run(until=3.0)  # replans at the lifts on the way
    assert mean_velocity(walk.record(), 2.0, 2.9) > 0.05


def test_a_walk_for_ever_needs_an_end(talos: Robot) -> None:
    walk = pw.Walk.standing(talos)
    walk.command(0.2, 0.0, 0.0)
    with pytest.raises(
        InvalidInput,
        match=re.escape(
            "until must be given while a command is in force, got a walk at (0.2, 0.0, 0.0) "
            "for ever; command(0, 0, 0) stops it."
        ),
    ):
        walk.run()


def test_a_walk_for_ever_keeps_a_short_plan() -> None:
    """Two minutes of planning alone: what is older than a few seconds is forgotten."""
    limits = pw.GaitLimits()
    commands = VelocityCommands(lambda: limits, 0.002)
    plan = FootstepPlan.standing(pose_at(0.0, 0.1, 0.0), pose_at(0.0, -0.1, 0.0))
    commands.give(0.0, (0.3, 0.0, 0.1))
    for tick in range(1200):
        t = 0.1 * tick
        plan = commands.plan(t, plan) or plan
        assert len(plan.steps) < 15
    assert t - 2.0 * FORGET < plan.start < t
