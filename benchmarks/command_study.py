"""Whole walks in MuJoCo: random commands, circles, turns, long and displaced walks, as a table.

Each walk must not fall and must end within 5 cm and 3 degrees of where its plan says; the exit
code is 1 where one does not.

    python benchmarks/command_study.py --jobs 4
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Iterator
from math import nan, pi, radians
from typing import Any

import numpy as np
from campaign import make_parser, run

import preview_walk as pw
from preview_walk import gait_limits

Command = tuple[float, float, float]
Timetable = list[tuple[float, Command]]

SEEDS = range(20)
SPAN = 20.0  # s
POSITION, YAW = 0.05, radians(3.0)

HEAD = f"""\
{"":36}   time           end    yaw  CoM error rms, mm  torque   QPs
{"walk":36}      s steps       mm    deg      x     y     z  /limit  lost"""


def random_commands(seed: int, span: float = SPAN) -> Timetable:
    """Return times (s) and commands (vx, vy in m/s, yaw rate in rad/s), at arbitrary instants.

    Every fifth command is a stop, and the last one, at `span`, is.
    """
    random = np.random.default_rng(seed)
    table: Timetable = []
    t = random.uniform(0.0, 1.0)
    while t < span:
        low, high = (-0.3, -0.15, -0.4), (0.7, 0.15, 0.4)
        vx, vy, wz = random.uniform(low, high).tolist()
        stop = random.uniform() < 0.2
        table.append((t, (0.0, 0.0, 0.0) if stop else (vx, vy, wz)))
        t += random.uniform(0.3, 4.0)
    return [*table, (span, (0.0, 0.0, 0.0))]


def obey(robot: pw.Robot, table: Timetable) -> pw.Record:
    """Return the record of a walk that obeys a timetable of commands and then stands."""
    walk = pw.Walk.standing(robot)
    for time, command in table:
        walk.run(until=time)
        walk.command(*command)
    return walk.run().record()


def talos() -> pw.Robot:
    """Return TALOS, loaded once for each process."""
    return pw.loaded_robot("talos")


def straight_walk(steps: int, start: Command = (0.0, 0.0, 0.0), friction: float = 0.8) -> pw.Record:
    """Return the record of the default walk with another length, place or floor."""
    robot = talos()
    planner = pw.FootstepPlanner(0.25, robot.step_width, 0.9)
    plan = planner.generate_footsteps(steps, start, ramp=2)
    return pw.simulate(robot, plan, friction=friction)


def gait(name: str, size: float) -> pw.Record:
    """Return the record of a whole gait: "circle" (turns), "turn" (rad), "side", "ahead" (m)."""
    robot = talos()
    limits = gait_limits(robot)
    planner = pw.FootstepPlanner(0.25, robot.step_width, 0.8)
    if name == "circle":
        plan = pw.arc(1.0, size, planner, limits=limits, ramp=2)
    elif name == "turn":
        plan = pw.turn_in_place(size, planner, limits=limits)
    elif name == "side":
        plan = pw.sideways(size, planner, limits=limits)
    else:
        plan = pw.straight(size, planner, limits=limits, ramp=2)
    return pw.simulate(robot, plan)


def commanded(*table: tuple[float, Command]) -> pw.Record:
    """Return the record of TALOS obeying a timetable."""
    return obey(talos(), list(table))


def studies() -> Iterator[tuple[str, Callable[..., pw.Record], tuple[object, ...]]]:
    """Yield a name, a function and its arguments for every walk."""
    for seed in SEEDS:
        yield f"random commands, seed {seed}", commanded, tuple(random_commands(seed))
    for seed in range(5):
        first, second, third = np.cumsum(np.random.default_rng(seed).uniform(0.5, 6.0, 3)).tolist()
        table = ((first, (0.5, 0.0, 0.0)), (second, (-0.2, 0.0, 0.0)), (third, (0.0, 0.0, 0.0)))
        yield f"0, 0.5, -0.2, 0 m/s, seed {seed}", commanded, table
    fast = ((0.0, (1.0, 0.0, 0.0)), (15.0, (0.0, 0.0, 0.0)))
    yield "1 m/s for 15 s", commanded, fast
    yield "circle of 1 m, left", gait, ("circle", 2.0 * pi)
    yield "circle of 1 m, right", gait, ("circle", -2.0 * pi)
    yield "turn of 360 degrees, left", gait, ("turn", 2.0 * pi)
    yield "turn of 360 degrees, right", gait, ("turn", -2.0 * pi)
    yield "1 m to the left", gait, ("side", 1.0)
    yield "1 m to the right", gait, ("side", -1.0)
    yield "1 m backwards", gait, ("ahead", -1.0)
    yield "20 steps", straight_walk, (20,)
    yield "20 steps from 100, -50, 137 degrees", straight_walk, (20, (100.0, -50.0, radians(137.0)))
    yield "20 steps, friction 0.5", straight_walk, (20, (0.0, 0.0, 0.0), 0.5)
    yield "200 steps", straight_walk, (200,)


def walked(walk: str) -> dict[str, Any]:
    """Return the figures of the walk of a name; it succeeds if it did what it must."""
    work, arguments = next((call, args) for name, call, args in studies() if name == walk)
    summary = work(*arguments).summary()
    return {
        "success": held(summary),
        "line": row(walk, summary),
        "com_error": summary.com_error_rms,
        "end": summary.final_position_error,
        "yaw": summary.final_yaw_error,
    }


def held(summary: pw.Summary) -> bool:
    """Tell whether a walk did what it must."""
    position, yaw = summary.final_position_error, summary.final_yaw_error
    on_plan = position is not None and position <= POSITION and yaw is not None and yaw <= YAW
    return on_plan and not summary.fell


def row(name: str, summary: pw.Summary) -> str:
    """Return one line of the table."""
    x, y, z = (nan if e is None else 1e3 * e for e in summary.com_error_rms)
    position = 1e3 * (summary.final_position_error or 0.0)
    yaw = np.degrees(summary.final_yaw_error or 0.0)
    outcome = "ok" if held(summary) else f"FAILED {summary.fall_reason or ''}"
    return (
        f"{name:36} {summary.duration:6.1f} {summary.steps:5d} {position:8.1f} {yaw:6.2f} "
        f"{x:6.2f} {y:5.2f} {z:5.2f} {summary.torque_ratio_max or nan:6.2f} "
        f"{summary.qp_failures:5d}  {outcome}"
    )


def study(given: argparse.Namespace) -> pw.Study:
    """Return all walks."""
    return pw.Study({"walk": [name for name, _, _ in studies()]}, walked, name="command study")


def report(results: pw.Results, given: argparse.Namespace) -> int:
    """Print the table; return 1 where a walk did not hold."""
    print(HEAD)
    for line in results.table["line"].dropna():
        print(line)
    count = int(results.table["success"].sum())
    print(f"{count} of {len(results)} walks held")
    return 0 if count == len(results) else 1


if __name__ == "__main__":
    sys.exit(run(make_parser(__doc__, "command_study"), study, report))
