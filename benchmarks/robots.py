"""Every robot of the catalogue by the numbers: its body, a straight walk, a turn, its fastest walk.

- straight: 12 steps of 0.25 of the leg's length; turn: 90 degrees on the spot. Step times follow
  from the leg: 3.13 sqrt(leg / g), which is 0.9 s for a leg of 0.81 m.
- fastest: the highest velocity command that the robot holds (within 5 %, no fall) for 15 s, found
  by going up in steps of a twentieth of sqrt(g leg) until it fails, then halving to `CLOSE`. What
  it may hold by luck beyond does not count.

    python benchmarks/robots.py --jobs 2
"""

from __future__ import annotations

import argparse
import json
import sys
from math import pi, sqrt
from typing import Any

from campaign import make_parser, run
from speed_sweep import holds, walk_at

import preview_walk as pw
from preview_walk import catalogue, command_limits, turn_in_place

GRAVITY = 9.81
CLOSE = 0.0125
"""The fastest walk is found to this share of sqrt(g leg)."""


def figures(summary: pw.Summary) -> dict[str, Any]:
    """Return what the table shows of a walk."""
    return {
        "fell": summary.fell,
        "reason": summary.fall_reason,
        "speed": summary.speed,
        "com_error": max(error or 0.0 for error in summary.com_error_rms),
        "torque": summary.torque_ratio_max,
        "end": summary.final_position_error,
        "yaw": summary.final_yaw_error,
    }


def fastest(name: str, unit: float) -> dict[str, Any]:
    """Return the figures of the fastest walk held; `unit` (m/s) is sqrt(g leg)."""
    best: dict[str, Any] = {"speed": 0.0}
    held, failed = 0.0, 0.05 * unit
    while holds(failed, summary := walk_at(name, failed).summary()):
        held, failed, best = failed, failed + 0.05 * unit, figures(summary)
    while failed - held > CLOSE * unit * 1.01:
        speed = 0.5 * (held + failed)
        summary = walk_at(name, speed).summary()
        if holds(speed, summary):
            held, best = speed, figures(summary)
        else:
            failed = speed
    return best


def walked_by(name: str) -> dict[str, Any]:
    """Return a robot's row; it succeeds where neither the straight walk nor the turn falls."""
    robot = pw.loaded_robot(name)
    unit = sqrt(GRAVITY * robot.leg_length)
    time = 3.13 * unit / GRAVITY
    planner = pw.FootstepPlanner(0.25 * robot.leg_length, robot.step_width, time)
    straight = figures(pw.simulate(robot, planner.generate_footsteps(12)).summary())
    plan = turn_in_place(0.5 * pi, planner, limits=command_limits(robot))
    turn = figures(pw.simulate(robot, plan).summary())
    return {
        "success": not straight["fell"] and not turn["fell"],
        "title": robot.title,
        "mass": robot.mass,
        "joints": len(robot.joint_names),
        "leg": robot.leg_length,
        "com": robot.com_height,
        "straight": straight,
        "turn": turn,
        "fastest": fastest(name, unit),
    }


def walked(walk: dict[str, Any], end: float, unit: str) -> str:
    """Return a walk's cells: CoM error (mm), torque ratio, how far off it ended."""
    outcome = "fell" if walk["fell"] else f"{end:.1f} {unit}"
    return f"{1e3 * walk['com_error']:.1f} | {walk['torque']:.2f} | {outcome}"


def row(facts: dict[str, Any]) -> str:
    """Return a robot's line of the table."""
    best, straight, turn = facts["fastest"], facts["straight"], facts["turn"]
    cells = [
        facts["name"],
        f"{facts['mass']:.1f}",
        str(facts["joints"]),
        f"{facts['leg']:.3f}",
        f"{facts['com']:.3f}",
        walked(straight, 1e3 * straight["end"], "mm"),
        walked(turn, turn["yaw"] * 180.0 / pi, "deg"),
    ]
    if best["speed"]:
        share = best["speed"] / sqrt(GRAVITY * facts["leg"])
        cells += [f"{best['speed']:.2f}", f"{share:.2f}", f"{1e3 * best['com_error']:.1f}"]
    else:
        cells += ["-"] * 3
    return f"| {' | '.join(cells)} |"


HEAD = """\
| robot | kg | joints | leg m | CoM m | straight: CoM mm | torque | end | \
turn: CoM mm | torque | end | fastest m/s | of sqrt(g leg) | CoM mm |
|---|---|---|---|---|---|---|---|---|---|---|---|---|---|"""


def study(given: argparse.Namespace) -> pw.Study:
    """Return the robots."""
    return pw.Study({"name": given.robots}, walked_by, name="robots")


def report(results: pw.Results, given: argparse.Namespace) -> int:
    """Print the table; return 1 where a straight walk or a turn fell."""
    done = results.table[results.table["outcome"] == "done"]
    print(HEAD)
    for facts in done.to_dict("records"):
        walks = {name: json.loads(facts[name]) for name in ("straight", "turn", "fastest")}
        print(row({**facts, **walks}))
    return 0 if results.table["success"].all() else 1


def main() -> int:
    """Study all robots; return 1 where one fell."""
    parser = make_parser(__doc__, "robots")
    parser.add_argument("--robots", nargs="*", default=catalogue(), help="names (default: all)")
    return run(parser, study, report)


if __name__ == "__main__":
    sys.exit(main())
