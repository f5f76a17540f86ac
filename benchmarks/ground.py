"""What ground robots walk on: known to them and unseen.

    python benchmarks/ground.py --robot talos --seeds 20 --jobs 2
    python benchmarks/ground.py --robot g1 --kind slope --largest

Known ground is walked along footsteps laid on it, at 0.2 m/s or faster for TALOS and as fast for
the length of their legs for others; unseen ground by a velocity command of 0.3 m/s for TALOS. The
first form walks fixed sizes, the blocks and rough ground with several seeds; the second one looks
for the largest size of each kind that is walked. One line a walk: CoM error (rms, mm), how often a
swinging foot touched the ground on its way, and whether the robot fell.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterator
from math import sqrt
from typing import Any

import numpy as np
from campaign import make_parser, run

import preview_walk as pw

LEG = 0.812
"""Length of TALOS's leg, m: sizes and speeds are its, others' are in proportion."""

KNOWN = {
    "stairs up": "stairs:rise={size},tread={tread},count=10",
    "stairs down": "stairs:rise=-{size},tread={tread},count=10",
    "slope up": "slope:degrees={size}",
    "slope down": "slope:degrees=-{size}",
    "slope across": "slope:degrees=0,bank={size}",
    "slope diagonal": "slope:degrees={size},bank={size}",
    "blocks": "blocks:height={size},size={block},seed={seed}",
}
"""Kinds of known ground."""

UNSEEN = {
    "step up": "stairs:rise={size},tread=2,count=2",
    "step down": "stairs:rise=-{size},tread=2,count=2",
    "slope up": "slope:degrees={size},length=40",
    "slope down": "slope:degrees=-{size},length=40",
    "slope across": "slope:degrees=0,bank={size},length=40",
    "blocks": "blocks:height={size},size={block},length=40,seed={seed}",
    "rough": "rough:height={size},size={rough},length=40,seed={seed}",
}
"""Kinds of unseen ground."""

SIZES = {
    False: {"stairs": 0.185, "slope": 15.0, "slope diagonal": 10.7, "blocks": 0.08},
    True: {"step up": 0.05, "step down": 0.08, "slope": 8.0, "blocks": 0.03, "rough": 0.04},
}
"""Sizes for TALOS, known and unseen: m or degrees."""

WAYS = {"blocks": 30.0, "rough": 20.0, "slope": 20.0, "step": 6.0}
"""How far TALOS walks on unseen ground, m."""


def tread_of(robot: pw.Robot) -> float:
    """Return the length of a tread, as long as the robot's sole and leg ask for, m."""
    return 2.0 * robot.sole.half_length + 0.07 * robot.leg_length / LEG


def ground_of(robot: pw.Robot, kind: str, blind: bool, size: float, seed: int) -> pw.Ground:
    """Return the ground of a case; treads and blocks are as long as the robot's leg asks for."""
    scale = robot.leg_length / LEG
    text = (UNSEEN if blind else KNOWN)[kind]
    return pw.read_ground(
        text.format(
            size=size,
            seed=seed,
            tread=tread_of(robot),
            block=max((0.3 if blind else 0.4) * scale, 2.0 * robot.sole.half_length + 0.03),
            rough=0.5 * scale,
        )
    )


def record_of(robot: pw.Robot, kind: str, blind: bool, ground: pw.Ground, seed: int) -> pw.Record:
    """Return the record of a walk: along a plan on known ground, by command on unseen."""
    scale = robot.leg_length / LEG
    pace = sqrt(scale)
    if blind:
        way = next(length for name, length in WAYS.items() if kind.startswith(name)) * scale
        speed = 0.3 * pace
        # Another seed begins elsewhere too.
        start = (0.013 * seed % 0.3, 0.0, 0.0)
        return pw.simulate_commands(
            robot, [((speed, 0.0, 0.0), way / speed)], start=start, ground=ground, blind=True
        )
    stairs = kind.startswith("stairs")
    length, time = (tread_of(robot), 1.3 * pace) if stairs else (0.25 * scale, pace)
    planner = pw.FootstepPlanner(length, robot.step_width, time)
    return pw.simulate(robot, planner.generate_footsteps(16, ramp=1), ground=ground)


def walked(robot: str, kind: str, blind: bool, size: float, seed: int = 0) -> dict[str, Any]:
    """Walk and return the figures of a case; what the planner refuses counts as not walked."""
    body = pw.loaded_robot(robot)
    try:
        record = record_of(body, kind, blind, ground_of(body, kind, blind, size, seed), seed)
    except pw.InvalidInput as error:
        return {"success": False, "why": f"refused: {error}"}
    x, y, z = (1e3 * np.sqrt(((record.com - record.com_ref) ** 2).mean(axis=0))).tolist()
    return {
        "success": not record.run.fell,
        "why": record.run.fall_reason,
        "error_x": x,
        "error_y": y,
        "error_z": z,
        "touches": touches(record),
        "way": float(record.com[-1, 0] - record.com[0, 0]),
        "time": float(record.time[-1]),
        "torque": record.summary().torque_ratio_max,
    }


def touches(record: pw.Record) -> int:
    """Return how many swings touched the ground between 10 and 85 % of their time."""
    plan, count = record.plans.walked(float(record.time[-1])), 0
    for foot, lift, land in zip(plan.foot[2:], plan.lifts, plan.landings, strict=True):
        force = record.left_force if foot == 0 else record.right_force
        share = (record.time - lift) / (land - lift)
        inside = (share > 0.1) & (share < 0.85)
        count += bool((np.linalg.norm(force[inside, :3], axis=1) > 5.0).any())
    return count


def fixed(name: str, seeds: int) -> Iterator[dict[str, Any]]:
    """Yield the cases of fixed sizes."""
    scale = pw.load_robot(name).leg_length / LEG
    for blind, kinds in ((False, KNOWN), (True, UNSEEN)):
        sizes = SIZES[blind]
        for kind in kinds:
            size = sizes.get(kind) or sizes[kind.split()[0]]
            size = size if "slope" in kind else round(size * scale, 4)
            for seed in range(seeds if kind in ("blocks", "rough") and blind else 1):
                yield {"robot": name, "kind": kind, "blind": blind, "size": size, "seed": seed}


def study(given: argparse.Namespace) -> pw.Study:
    """Return the walks on fixed sizes, or the search for the largest ones."""
    names = given.robot or ["talos"]
    rows = [row for name in names for row in fixed(name, given.seeds)]
    rows = [row for row in rows if not given.kind or given.kind in row["kind"]]
    if not given.largest:
        return pw.Study(rows, walked, name="ground")
    if len({"slope" in row["kind"] for row in rows}) > 1 or len(names) > 1:
        raise pw.InvalidInput(
            "--largest looks for one size: give one --robot, and --kind slope, stairs, step, "
            "blocks or rough."
        )
    slope = "slope" in rows[0]["kind"]
    high = 30.0 if slope else 0.35 * pw.load_robot(names[0]).leg_length / LEG
    kept = [{k: v for k, v in row.items() if k != "size"} for row in rows if row["seed"] == 0]
    return pw.Study(kept, walked, margin=pw.Margin("size", 0.0, high, high / 256), name="ground")


def line(row: Any) -> str:
    """Return a row in words."""
    seen = "unseen" if row.blind else "known"
    head = f"{row.robot:12} {seen:7} {row.kind:15}"
    if hasattr(row, "margin"):
        return f"{head} up to {row.margin:.3f}, not {row.fatal:.3f}"
    end = "walked" if row.success else f"fell: {row.why}"
    rest = ""
    if row.time == row.time:
        rest = (
            f"{row.error_x:7.2f} {row.error_y:6.2f} {row.error_z:6.2f} mm, {row.touches:2.0f} "
            f"touches, {row.way:6.2f} m in {row.time:5.1f} s, torque {row.torque:.2f}, "
        )
    return f"{head} {row.size:6.3f} seed {row.seed:2} {rest}{end}"


def report(results: pw.Results, given: argparse.Namespace) -> int:
    """Print a line a walk or a search; return 1 where a walk fell."""
    for row in results.table[results.table["outcome"] == "done"].itertuples():
        print(line(row))
    return 0 if results.table["success"].all() else 1


def main() -> int:
    """Walk all cases; return 1 where one fell."""
    parser = make_parser(__doc__, "ground")
    parser.add_argument("--robot", action="append", help="may be repeated (default: talos)")
    parser.add_argument("--seeds", type=int, default=3, help="of random ground (default 3)")
    parser.add_argument("--kind", help="walk only the kinds that contain this text")
    parser.add_argument("--largest", action="store_true", help="look for the largest sizes")
    return run(parser, study, report)


if __name__ == "__main__":
    sys.exit(main())
