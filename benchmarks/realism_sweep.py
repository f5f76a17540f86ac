"""One imperfection after the other, larger and larger: what a walk takes.

    python benchmarks/realism_sweep.py --robot talos --jobs 2 --out sweep.jsonl --plot sweep.png

Each number of the laboratory's robot is multiplied by 0, 1, 2, 4 and 8 while all others stay as
they are; 8 s at 0.5 m/s (of TALOS's legs; in proportion to the root of theirs for others), turning.
One line a number and size: share of walks upright, and the median of the true CoM error (rms, the
larger of x and y) and of the estimated velocity's. Walks that are in the file are not walked again.
"""

from __future__ import annotations

import argparse
import json
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.figure import Figure

import preview_walk as pw

SIZES = (0, 1, 2, 4, 8)
"""Multiples of the laboratory's number."""

NUMBERS = {
    "encoders.bias": "encoder zeros [rad]",
    "encoders.delay": "all sensors' delay [s]",
    "imu.gyro_noise": "gyro noise [rad/s]",
    "imu.gyro_bias": "gyro bias [rad/s]",
    "imu.accelerometer_bias": "accelerometer bias [m/s²]",
    "soles.noise": "sole sensor noise [weights]",
    "motors.delay": "torque delay [s]",
    "motors.dry_friction": "dry friction [largest torque]",
    "motors.error": "motor constants [1]",
    "mismatch.mass": "masses [1]",
    "mismatch.com": "centre of mass [m]",
    "payload": "payload in one hand [mass]",
}
"""What is swept, and how it is called in the plot."""

UNITS = {"motors.delay": 0.002, "payload": 0.0125}
"""Size 1 of what the laboratory's robot does not have."""


@dataclass(frozen=True)
class Case:
    """A walk to be made."""

    robot: str
    number: str
    size: int
    seed: int


@cache
def robot_of(name: str) -> pw.Robot:
    """Return a robot, loaded once a process."""
    return pw.load_robot(name)


def value_of(number: str, size: int) -> float:
    """Return the number's value at a multiple of the laboratory's."""
    if number in UNITS:
        return size * UNITS[number]
    part, name = number.split(".")
    return size * float(getattr(getattr(pw.Realism.lab(), part), name))


def realism_of(case: Case, robot: pw.Robot) -> pw.Realism:
    """Return the laboratory's robot with one number changed."""
    lab, value = pw.Realism.lab(), value_of(case.number, case.size)
    if case.number == "payload":
        hand = robot.mj.body(int(robot.mj.nbody) - 1).name
        load = pw.Payload(value * robot.mass, hand) if value else None
        return replace(lab, mismatch=replace(lab.mismatch, payload=load))
    if case.number == "encoders.delay":
        parts = (lab.encoders, lab.imu, lab.soles)
        encoders, imu, soles = (replace(part, delay=value) for part in parts)
        return replace(lab, encoders=encoders, imu=imu, soles=soles)
    part, name = case.number.split(".")
    return replace(lab, **{part: replace(getattr(lab, part), **{name: value})})


def walk(case: Case) -> dict[str, Any]:
    """Walk a case; return its figures."""
    robot = robot_of(case.robot)
    speed = 0.5 * (robot.leg_length / 0.812) ** 0.5
    summary = pw.simulate_commands(
        robot, [((speed, 0.0, 0.2), 8.0)], realism=realism_of(case, robot), seed=case.seed
    ).summary()
    x, y, _ = summary.com_error_rms
    return {
        "fell": summary.fall_time,
        "com": max(x or 0.0, y or 0.0),
        "velocity": max(v or 0.0 for v in summary.velocity_error_rms or [0.0]),
    }


def draw(done: dict[Case, dict[str, Any]], robot: str, path: str) -> None:
    """Draw error and survival against size, one panel a number."""
    figure = Figure(figsize=(12, 10), layout="constrained")
    panels = figure.subplots(4, 3).flat
    for axes, (number, title) in zip(panels, NUMBERS.items(), strict=True):
        upright, errors = [], []
        for size in SIZES:
            found = [f for c, f in done.items() if (c.number, c.size) == (number, size)]
            stood = [f for f in found if f["fell"] is None]
            upright.append(len(stood) / len(found))
            errors.append(1e3 * float(np.median([f["com"] for f in stood])) if stood else np.nan)
        values = [value_of(number, size) for size in SIZES]
        axes.plot(values, errors, "o-", color="#0072B2")
        axes.set(xlabel=title, ylim=(0, 30))
        axes.set_ylabel("CoM error [mm]", color="#0072B2")
        share = axes.twinx()
        share.plot(values, upright, "s--", color="#D55E00", markersize=4)
        share.set(ylim=(-0.05, 1.05))
        share.set_ylabel("upright", color="#D55E00")
        axes.axvline(values[1], color="#BBBBBB", linewidth=1)
    figure.suptitle(f"{robot}: one number of the laboratory's robot (grey line) changed at a time")
    figure.savefig(path, dpi=90)


def main() -> None:
    """Walk what is not in the file yet, sum up, draw."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--robot", default="talos", help="of the catalogue (default talos)")
    parser.add_argument("--seeds", type=int, default=3, help="walks of each size (default 3)")
    parser.add_argument("--jobs", type=int, default=1, help="processes (default 1)")
    parser.add_argument("--out", type=Path, help="file of results, one JSON line a walk")
    parser.add_argument("--plot", help="picture to write")
    given = parser.parse_args()
    done = {}
    if given.out is not None and given.out.exists():
        for text in given.out.read_text().splitlines():
            entry = json.loads(text)
            done[Case(*entry["case"])] = entry["figures"]
    asked = [
        Case(given.robot, number, size, seed)
        for number in NUMBERS
        for size in SIZES
        for seed in range(given.seeds)
    ]
    left = [case for case in asked if case not in done]
    with ProcessPoolExecutor(given.jobs) as pool:
        for case, figures in zip(left, pool.map(walk, left), strict=True):
            done[case] = figures
            if given.out is not None:
                with given.out.open("a") as file:
                    key = [case.robot, case.number, case.size, case.seed]
                    file.write(json.dumps({"case": key, "figures": figures}) + "\n")
    for number in NUMBERS:
        for size in SIZES:
            found = [done[c] for c in asked if (c.number, c.size) == (number, size)]
            stood = [f for f in found if f["fell"] is None]
            line = (
                f"{number:24} {value_of(number, size):8.4g}  upright {len(stood)} of {len(found)}"
            )
            if stood:
                com, velocity = (
                    1e3 * float(np.median([f[k] for f in stood])) for k in ("com", "velocity")
                )
                line += f"  CoM {com:5.1f} mm  velocity {velocity:5.1f} mm/s"
            print(line)
    if given.plot:
        draw({c: done[c] for c in asked}, given.robot, given.plot)


if __name__ == "__main__":
    main()
