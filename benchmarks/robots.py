"""Every robot of the catalogue by the numbers: its body, a straight walk, a turn, its fastest walk.

- straight: 12 steps of 0.25 of the leg's length; turn: 90 degrees on the spot. Step times follow
  from the leg: 3.13 sqrt(leg / g), which is 0.9 s for a leg of 0.81 m.
- fastest: the highest velocity command that the robot holds (within 5 %, no fall) for 15 s, found
  by going up in steps of a twentieth of sqrt(g leg) until it fails, then halving to `CLOSE`. What
  it may hold by luck beyond does not count.

Finished robots are kept in the folder; run again to go on where it stopped.

    python benchmarks/robots.py --jobs 2 --out robots
"""

from __future__ import annotations

import argparse
import json
import os
import sys
from concurrent.futures import ProcessPoolExecutor, as_completed
from math import pi, sqrt
from multiprocessing import get_context
from pathlib import Path
from typing import Any

# One thread for each walk: their matrices are small, and the walks run beside each other.
os.environ.setdefault("OMP_NUM_THREADS", "1")
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

from speed_sweep import holds, walk_at
from tqdm import tqdm

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
    while holds(failed, summary := walk_at(name, failed)):
        held, failed, best = failed, failed + 0.05 * unit, figures(summary)
    while failed - held > CLOSE * unit * 1.01:
        speed = 0.5 * (held + failed)
        summary = walk_at(name, speed)
        if holds(speed, summary):
            held, best = speed, figures(summary)
        else:
            failed = speed
    return best


def study(name: str) -> dict[str, Any]:
    """Return a robot's row."""
    robot = pw.load_robot(name)
    unit = sqrt(GRAVITY * robot.leg_length)
    time = 3.13 * unit / GRAVITY
    planner = pw.FootstepPlanner(0.25 * robot.leg_length, robot.step_width, time)
    straight = pw.simulate(robot, planner.generate_footsteps(12)).summary()
    turn = turn_in_place(0.5 * pi, planner, limits=command_limits(robot))
    return {
        "name": name,
        "title": robot.title,
        "mass": robot.mass,
        "joints": len(robot.joint_names),
        "leg": robot.leg_length,
        "com": robot.com_height,
        "straight": figures(straight),
        "turn": figures(pw.simulate(robot, turn).summary()),
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


def main() -> int:
    """Study all robots and print the table; return 1 where a straight walk or a turn fell."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--robots", nargs="*", default=catalogue(), help="names (default: all)")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="processes (default: all)")
    parser.add_argument("--out", type=Path, default=Path("robots"), help="folder of the results")
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)

    files = {name: options.out / f"{name}.json" for name in options.robots}
    rest = [name for name, file in files.items() if not file.exists()]
    with ProcessPoolExecutor(options.jobs, mp_context=get_context("spawn")) as pool:
        futures = {pool.submit(study, name): name for name in rest}
        for future in tqdm(as_completed(futures), total=len(rest), unit="robot"):
            part = files[futures[future]].with_suffix(".part")
            part.write_text(json.dumps(future.result(), indent=2) + "\n")
            part.replace(files[futures[future]])

    rows = [json.loads(file.read_text()) for file in files.values()]
    print(HEAD)
    print("\n".join(row(facts) for facts in rows))
    return int(any(facts[walk]["fell"] for facts in rows for walk in ("straight", "turn")))


if __name__ == "__main__":
    sys.exit(main())
