"""What ground robots walk on: known to them and unseen.

    python benchmarks/ground.py --robot talos --seeds 20 --jobs 2 --out ground.jsonl
    python benchmarks/ground.py --robot g1 --largest

Known ground is walked along footsteps laid on it, at 0.2 m/s or faster for TALOS and as fast for
the length of their legs for others; unseen ground by a velocity command of 0.3 m/s for TALOS. The
first form walks fixed sizes, the blocks and rough ground with several seeds; the second one looks
for the largest size of each kind that is walked. One line a walk: CoM error (rms, mm), how often a
swinging foot touched the ground on its way, and whether the robot fell. Walks that are in the file
already are not walked again.
"""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from dataclasses import asdict, dataclass
from functools import cache
from math import sqrt
from pathlib import Path
from typing import Any

import numpy as np

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


@dataclass(frozen=True)
class Case:
    """One walk: which robot, on what ground of what size, seen or not."""

    robot: str
    kind: str
    blind: bool
    size: float
    seed: int = 0


@cache
def robot_of(name: str) -> pw.Robot:
    """Return a robot, loaded once in each process."""
    return pw.load_robot(name)


def ground_of(case: Case) -> pw.Ground:
    """Return the ground of a case; treads and blocks are as long as the robot's leg asks for."""
    robot = robot_of(case.robot)
    scale = robot.leg_length / LEG
    text = (UNSEEN if case.blind else KNOWN)[case.kind]
    return pw.read_ground(
        text.format(
            size=case.size,
            seed=case.seed,
            tread=2.0 * robot.sole.half_length + 0.07 * scale,
            block=max((0.3 if case.blind else 0.4) * scale, 2.0 * robot.sole.half_length + 0.03),
            rough=0.5 * scale,
        )
    )


def walked(case: Case) -> dict[str, Any]:
    """Walk and return the row of a case."""
    robot = robot_of(case.robot)
    scale = robot.leg_length / LEG
    pace = sqrt(scale)
    try:
        ground = ground_of(case)
        if case.blind:
            kind = next(kind for kind in WAYS if case.kind.startswith(kind))
            speed, way = 0.3 * pace, WAYS[kind] * scale
            # Another seed begins elsewhere too.
            start = (0.013 * case.seed % 0.3, 0.0, 0.0)
            record = pw.simulate_commands(
                robot, [((speed, 0.0, 0.0), way / speed)], start=start, ground=ground, blind=True
            )
        else:
            stairs = case.kind.startswith("stairs")
            tread = 2.0 * robot.sole.half_length + 0.07 * scale
            length, time = (tread, 1.3 * pace) if stairs else (0.25 * scale, pace)
            planner = pw.FootstepPlanner(length, robot.step_width, time)
            plan = planner.generate_footsteps(16, ramp=1)
            record = pw.simulate(robot, plan, ground=ground)
    except pw.InvalidInput as error:
        return {**asdict(case), "fell": True, "reason": f"refused: {error}"}
    error = 1e3 * np.sqrt(((record.com - record.com_ref) ** 2).mean(axis=0))
    steady = record.com[-1, 0] - record.com[0, 0]
    return {
        **asdict(case),
        "fell": record.run.fell,
        "reason": record.run.fall_reason,
        "error": [round(float(e), 2) for e in error],
        "touches": touches(record),
        "way": round(float(steady), 2),
        "time": round(float(record.time[-1]), 1),
        "torque": round(float(record.summary().torque_ratio_max), 2),
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


def fixed(name: str, seeds: int) -> Iterator[Case]:
    """Yield the cases of fixed sizes."""
    scale = robot_of(name).leg_length / LEG
    for blind, kinds in ((False, KNOWN), (True, UNSEEN)):
        sizes = SIZES[blind]
        for kind in kinds:
            size = sizes.get(kind) or sizes[kind.split()[0]]
            size = size if "slope" in kind else round(size * scale, 4)
            for seed in range(seeds if kind in ("blocks", "rough") and blind else 1):
                yield Case(name, kind, blind, size, seed)


def largest(name: str, kind: str, blind: bool) -> dict[str, Any]:
    """Return the largest size walked of a kind, and the smallest one that was not: eight walks."""
    scale = robot_of(name).leg_length / LEG
    low, high = 0.0, 30.0 if "slope" in kind else 0.35 * scale
    for _ in range(8):
        size = round(0.5 * (low + high), 4)
        if walked(Case(name, kind, blind, size))["fell"]:
            high = size
        else:
            low = size
    return {"robot": name, "kind": kind, "blind": blind, "walked": low, "not": high}


def line(row: dict[str, Any]) -> str:
    """Return a row in words."""
    seen = "unseen" if row["blind"] else "known"
    head = f"{row['robot']:12} {seen:7} {row['kind']:15}"
    if "walked" in row:
        return f"{head} up to {row['walked']:.3f}, not {row['not']:.3f}"
    end = f"fell: {row['reason']}" if row["fell"] else "walked"
    rest = ""
    if "error" in row:
        x, y, z = row["error"]
        rest = f"{x:7.2f} {y:6.2f} {z:6.2f} mm, {row['touches']:2} touches, {row['way']:6.2f} m in "
        rest += f"{row['time']:5.1f} s, torque {row['torque']:.2f}, "
    return f"{head} {row['size']:6.3f} seed {row['seed']:2} {rest}{end}"


def main() -> int:
    """Walk all cases; return how many fell."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--robot", action="append", help="may be repeated (default: talos)")
    parser.add_argument("--seeds", type=int, default=3, help="of random ground (default 3)")
    parser.add_argument("--kind", help="walk only the kinds that contain this text")
    parser.add_argument("--largest", action="store_true", help="look for the largest sizes")
    parser.add_argument("--jobs", type=int, default=1, help="processes (default 1)")
    parser.add_argument("--out", type=Path, help="file of rows, one JSON object a line")
    given = parser.parse_args()
    names = given.robot or ["talos"]
    out = given.out
    done = (
        [json.loads(text) for text in out.read_text().splitlines()] if out and out.exists() else []
    )
    fell = 0
    with ProcessPoolExecutor(given.jobs) as pool:
        wanted = [case for name in names for case in fixed(name, given.seeds)]
        wanted = [case for case in wanted if not given.kind or given.kind in case.kind]
        if given.largest:
            keys = list(dict.fromkeys((c.robot, c.kind, c.blind) for c in wanted))
            rows = pool.map(largest, *zip(*keys, strict=True))
        else:
            known = [
                {name: row[name] for name in asdict(wanted[0])} for row in done if "seed" in row
            ]
            rows = pool.map(walked, [case for case in wanted if asdict(case) not in known])
        for row in rows:
            print(line(row), flush=True)
            fell += row.get("fell", False)
            if out:
                with out.open("a") as file:
                    file.write(json.dumps(row) + "\n")
    return fell


if __name__ == "__main__":
    sys.exit(min(main(), 125))
