"""Which gaits of a robot are accepted, which walk: seven step lengths by seven step times each.

Step lengths are shares of the leg, up to what legs reach; step times are multiples of the leg's
pendulum time sqrt(leg / g), from the shortest that is accepted to about a second for a leg of
0.8 m. Every gait is a straight walk of eight steps. It is checked as `simulate` checks it, and then
walked whatever the check says: what is accepted should not fall, and what the motors are said to
forbid should. What is out of the legs' reach is not walked.

    python benchmarks/gaits.py --robots talos g1 --jobs 2
"""

from __future__ import annotations

import argparse
import sys
from dataclasses import replace
from math import sqrt
from typing import Any

import numpy as np
from campaign import make_parser, run

import preview_walk as pw
from preview_walk import catalogue, check_plan, gait_limits
from preview_walk.robots.robot import Robot

GRAVITY = 9.81
SHARES = (0.15, 0.25, 0.35, 0.45, 0.55, 0.65, 0.74)
"""Step lengths over the leg's length."""

BEATS = (1.07, 1.3, 1.6, 2.0, 2.5, 3.0, 3.5)
"""Step times over sqrt(leg / g)."""

STEPS, RAMP = 8, 2
"""Steps of a walk, and how many of them speed up and slow down."""

BEFORE = 0.3
"""The peaks of a walk that falls are those up to so long (s) before it is down."""


def peaks(robot: Robot, record: pw.Record, until: float) -> dict[str, dict[str, float]]:
    """Return the leg joints' largest torque and speed over their limits up to a time (s)."""
    rows = max(1, int(np.searchsorted(record.time, until)))
    legs = [robot.pin.joints[j].idx_v - 6 for leg in robot.legs.values() for j in leg.joints]
    used: dict[str, dict[str, float]] = {"torque": {}, "speed": {}}
    for i in legs:
        name = robot.joint_names[i]
        if robot.effort[i] > 0.0:
            used["torque"][name] = float(np.abs(record.tau[:rows, i]).max() / robot.effort[i])
        used["speed"][name] = float(np.abs(record.v[:rows, 6 + i]).max() / robot.v_limit[i])
    return used


def judged(plan: pw.FootstepPlan, robot: Robot) -> dict[str, Any]:
    """Return whether a plan is accepted; if not, why, and whether motors alone forbid it."""
    limits = gait_limits(robot)
    found = check_plan(plan, limits)
    return {
        "accepted": not found,
        "refusal": found[0].text if found else None,
        "by_motors": bool(found) and not check_plan(plan, replace(limits, motors=None)),
    }


def walked(name: str, share: float, beat: float) -> dict[str, Any]:
    """Return a gait's row; it succeeds where what is said of it is what happens."""
    robot = pw.loaded_robot(name)
    length, time = share * robot.leg_length, beat * sqrt(robot.leg_length / GRAVITY)
    planner = pw.FootstepPlanner(length, robot.step_width, time)
    plan = planner.generate_footsteps(STEPS, ramp=RAMP)
    verdict = {"step_length": length, "step_time": time, **judged(plan, robot)}
    if not verdict["accepted"] and not verdict["by_motors"]:
        return {"success": True, **verdict, "fell": None}
    record = pw.Walk(robot, plan).run().record()
    summary = record.summary()
    until = np.inf if summary.fall_time is None else summary.fall_time - BEFORE
    return {
        "success": verdict["accepted"] != summary.fell,
        **verdict,
        "fell": summary.fell,
        "fall_time": summary.fall_time,
        "why": summary.fall_reason,
        "com_error": max(error or 0.0 for error in summary.com_error_rms),
        **peaks(robot, record, until),
    }


def study(given: argparse.Namespace) -> pw.Study:
    """Return the gaits."""
    factors = {"name": given.robots, "share": SHARES, "beat": BEATS}
    return pw.Study(factors, walked, name="gaits")


def line(name: str, rows: Any) -> str:
    """Return a robot's line of the table."""
    accepted = rows[rows["accepted"].astype(bool)]
    refused = rows[rows["by_motors"].astype(bool)]
    fell, stood = accepted["fell"].sum(), len(refused) - refused["fell"].sum()
    total = len(accepted) + len(refused)
    before = accepted["fell"].sum() + refused["fell"].sum()
    return f"| {name} | {total} | {before} | {len(accepted)} | {fell} | {len(refused)} | {stood} |"


HEAD = """\
| robot | gaits | of them fall | accepted | of them fall | motors forbid | of them walk |
|---|---|---|---|---|---|---|"""


def report(results: pw.Results, given: argparse.Namespace) -> int:
    """Print the table and what is not as it is said; return 1 where something accepted fell."""
    done = results.table[results.table["outcome"] == "done"]
    print(HEAD)
    for name, rows in done.groupby("name", sort=False):
        print(line(str(name), rows))
    print(line("all", done))
    for row in done[~done["success"].astype(bool)].itertuples():
        what = f"fell: {row.why}" if row.accepted else f"walked, but step said: {row.refusal}"
        print(f"{row.name} {row.step_length:.3f} m in {row.step_time:.3f} s {what}")
    return int((done["accepted"].astype(bool) & ~done["success"].astype(bool)).any())


def main() -> int:
    """Walk the gaits, print the table; return 1 where something accepted fell."""
    parser = make_parser(__doc__, "gaits")
    parser.add_argument("--robots", nargs="*", default=catalogue(), help="names (default: all)")
    return run(parser, study, report)


if __name__ == "__main__":
    sys.exit(main())
