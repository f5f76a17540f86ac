"""The largest push that a simulated robot survives, over what the pendulum allows.

By bisection, for 8 directions, 5 phases of single support and standing, left and right stance:

    python benchmarks/push_recovery.py --robot talos --jobs 4

Every cell that is done goes into a file (JSON lines); stopped and started again, the benchmark goes
on from there. A cell counts up to its smallest push that was not survived: below the bisection's
result a grid of smaller pushes is tried too, so that no lucky island counts. At the end it prints a
table and draws a polar plot over the bound (`preview_walk.capturability.bound`).

Survived: the robot walks on, or stands again, for 6 s after the push. Angles are in degrees from
straight ahead towards the stance foot's side: 90 is outward, 270 inward.
"""

from __future__ import annotations

import argparse
import json
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor, as_completed
from math import cos, radians, sin
from pathlib import Path
from typing import Any, get_args

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from push_bound_table import GAITS
from tqdm import tqdm

import preview_walk as pw
from preview_walk import Answer, Foot, largest_impulse, other

ANGLES = tuple(range(0, 360, 45))
SHARES = (0.1, 0.3, 0.5, 0.7, 0.9, None)
PUSH_TIME, AFTER = 0.2, 6.0
LARGEST = 2.0
"""The bisection begins between 0 and this impulse per mass (N·s/kg)."""
PRECISION = 0.01
"""And ends at this difference (N·s/kg)."""
ISLANDS = 6
"""Smaller pushes that are tried too."""

Cell = tuple[str, str, float | None, int]
"""Robot, stance foot, share of single support (None: standing), angle (degrees)."""


def survives(cell: Cell, impulse: float, body: str | None = None) -> bool:
    """Return whether the robot survives a push of this impulse (N·s) on a body, else the base."""
    name, stance, share, angle = cell
    robot = pw.load_robot(name)
    gait = GAITS[name.upper()]
    step_time = gait.single_support + gait.double_support
    planner = pw.FootstepPlanner(
        gait.step_length, robot.step_width, step_time, gait.double_support / step_time
    )
    foot: Foot = "left" if stance == "left" else "right"
    plan = planner.generate_footsteps(14 if share is not None else 0)
    begin = 1.0
    if share is not None:
        step = [s for s in plan.steps if s.foot == other(foot)][1]
        begin = step.lift + share * (step.land - step.lift)
    force, mirror = impulse / PUSH_TIME, 1.0 if foot == "left" else -1.0
    along = (force * cos(radians(angle)), mirror * force * sin(radians(angle)), 0.0)
    walk = pw.Walk(robot, plan, pushes=[pw.Push(begin, PUSH_TIME, along, body)])
    return not walk.run(until=begin + PUSH_TIME + AFTER).fallen


def measure(cell: Cell) -> dict[str, Any]:
    """Return the largest survived impulse (N·s) of a cell and the pushes tried."""
    mass = pw.load_robot(cell[0]).mass
    low, high, tried = 0.0, LARGEST * mass, {}
    step = 0.2 * mass
    while high - low > PRECISION * mass:
        # Up in steps from below: most of what is tried is survived or nearly so.
        middle = 0.5 * (low + high)
        impulse = min(low + step, middle) if high == LARGEST * mass else middle
        tried[round(impulse, 3)] = survives(cell, impulse)
        low, high = (impulse, high) if tried[round(impulse, 3)] else (low, impulse)
    top = low
    for impulse in np.linspace(0.4, 0.95, ISLANDS) * low:
        tried[round(float(impulse), 3)] = survives(cell, float(impulse))
    failed = [impulse for impulse, ok in tried.items() if not ok and impulse < top]
    if failed:
        top = max((i for i, ok in tried.items() if ok and i < min(failed)), default=0.0)
    robot, stance, share, angle = cell
    return {
        "robot": robot,
        "stance": stance,
        "share": share,
        "angle": angle,
        "impulse": round(top, 2),
        "islands": len(failed),
        "tried": sorted(tried.items()),
    }


def cells(robot: str, shares: list[float | None], angles: list[int]) -> Iterator[Cell]:
    """Yield the grid; who stands has no stance foot, and the left one's side is outward."""
    for share in shares:
        for stance in ("left",) if share is None else ("left", "right"):
            for angle in angles:
                yield robot, stance, share, angle


def read(path: Path) -> dict[Cell, dict[str, Any]]:
    """Return the cells done before."""
    if not path.exists():
        return {}
    rows = [json.loads(line) for line in path.read_text().splitlines()]
    return {(r["robot"], r["stance"], r["share"], r["angle"]): r for r in rows}


def bounds(robot: str, share: float | None, angle: int) -> list[float]:
    """Return the pendulum's largest impulses (N·s): CoP alone, steps, steps and timing."""
    gait = GAITS[robot.upper()]
    return [largest_impulse(gait, share, radians(angle), answer) for answer in get_args(Answer)]


def report(robot: str, done: dict[Cell, dict[str, Any]], picture: Path) -> None:
    """Print the table and draw the polar plot."""
    mine = {cell: row for cell, row in done.items() if cell[0] == robot}
    shares = [share for share in SHARES if any(cell[2] == share for cell in mine)]
    figure, axes = plt.subplots(
        1, len(shares), figsize=(4 * len(shares), 4.5), subplot_kw={"projection": "polar"}
    )
    print(f"{robot}: largest impulse (N·s), left / right stance (bounds a / b / c), their shares")
    ratios = []
    for share, axis in zip(shares, np.atleast_1d(axes), strict=True):
        angles = sorted({cell[3] for cell in mine if cell[2] == share})
        limit = {angle: bounds(robot, share, angle) for angle in angles}
        title = "standing" if share is None else f"{100 * share:.0f} %"
        for angle in angles:
            rows = [mine.get((robot, stance, share, angle)) for stance in ("left", "right")]
            values = [row["impulse"] for row in rows if row is not None]
            islands = sum(row["islands"] for row in rows if row is not None)
            ratios.append(min(values) / np.array(limit[angle]))
            text = " / ".join(f"{value:5.1f}" for value in values)
            bound = " / ".join(f"{value:5.1f}" for value in limit[angle])
            share_of = " / ".join(f"{ratio:.2f}" for ratio in ratios[-1])
            note = f"  {islands} islands" if islands else ""
            print(f"  {title:>8} {angle:4d}  {text:>13}  ({bound})  {share_of}{note}")
        ring = [radians(angle) for angle in [*angles, angles[0]]]
        for k, style in enumerate((":", "--")):
            axis.plot(ring, [limit[a][k] for a in [*angles, angles[0]]], "k" + style, lw=0.8)
        for stance, colour in (("left", "C0"), ("right", "C1")):
            row = [mine.get((robot, stance, share, a), {}).get("impulse", np.nan) for a in angles]
            axis.plot(ring, [*row, row[0]], colour, marker="o", ms=3)
        axis.set_theta_zero_location("N")
        axis.set_title(title)
    figure.suptitle(
        f"{robot}: largest push (N·s), left stance blue, right stance orange; "
        "dotted: CoP alone, dashed: footholds free"
    )
    figure.tight_layout()
    figure.savefig(picture, dpi=110)
    means = " / ".join(f"{mean:.2f}" for mean in np.mean(ratios, axis=0))
    print(f"mean shares, of the weaker stance, of (a) / (b) / (c): {means}; plot: {picture}")


def main() -> None:
    """Run what is not done yet, then report."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--robot", default="talos", choices=[name.lower() for name in GAITS])
    parser.add_argument("--jobs", type=int, default=None, help="processes (default: all cores)")
    parser.add_argument("--out", type=Path, default=Path("push_recovery.jsonl"))
    parser.add_argument("--shares", default="0.1,0.3,0.5,0.7,0.9,standing")
    parser.add_argument("--angles", default=",".join(map(str, ANGLES)))
    given = parser.parse_args()
    shares = [None if s == "standing" else float(s) for s in given.shares.split(",")]
    angles = [int(angle) for angle in given.angles.split(",")]
    done = read(given.out)
    todo = [cell for cell in cells(given.robot, shares, angles) if cell not in done]
    with ProcessPoolExecutor(given.jobs) as pool, given.out.open("a") as file:
        runs = {pool.submit(measure, cell): cell for cell in todo}
        try:
            for run in tqdm(as_completed(runs), total=len(runs), unit="cell"):
                done[runs[run]] = run.result()
                file.write(json.dumps(done[runs[run]]) + "\n")
                file.flush()
        except KeyboardInterrupt:
            pool.shutdown(cancel_futures=True)
            print(f"stopped; start again to go on from {given.out}")
            return
    report(given.robot, done, given.out.with_suffix(".png"))


if __name__ == "__main__":
    main()
