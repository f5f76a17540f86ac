"""One imperfection after the other, larger and larger: what a walk takes.

    python benchmarks/realism_sweep.py --robot talos --jobs 2

Each number of the laboratory's robot is multiplied by 0, 1, 2, 4 and 8 while all others stay as
they are; 8 s at 0.5 m/s (of TALOS's legs; in proportion to the root of theirs for others), turning.
One line a number and size: share of walks upright, and the median of the true CoM error (rms, the
larger of x and y) and of the estimated velocity's. `sweep.png` in the folder draws them.
"""

from __future__ import annotations

import argparse
import sys
from dataclasses import replace
from typing import Any

import numpy as np
from campaign import make_parser, run
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


def value_of(number: str, size: int) -> float:
    """Return the number's value at a multiple of the laboratory's."""
    if number in UNITS:
        return size * UNITS[number]
    part, name = number.split(".")
    return size * float(getattr(getattr(pw.Realism.lab(), part), name))


def realism_of(number: str, size: int, robot: pw.Robot) -> pw.Realism:
    """Return the laboratory's robot with one number changed."""
    lab, value = pw.Realism.lab(), value_of(number, size)
    if number == "payload":
        hand = robot.mj.body(int(robot.mj.nbody) - 1).name
        load = pw.Payload(value * robot.mass, hand) if value else None
        return replace(lab, mismatch=replace(lab.mismatch, payload=load))
    if number == "encoders.delay":
        parts = (lab.encoders, lab.imu, lab.soles)
        encoders, imu, soles = (replace(part, delay=value) for part in parts)
        return replace(lab, encoders=encoders, imu=imu, soles=soles)
    part, name = number.split(".")
    return replace(lab, **{part: replace(getattr(lab, part), **{name: value})})


def walk(robot: str, number: str, size: int, seed: int) -> dict[str, Any]:
    """Walk a case; return its figures."""
    body = pw.loaded_robot(robot)
    speed = 0.5 * (body.leg_length / 0.812) ** 0.5
    summary = pw.simulate_commands(
        body, [((speed, 0.0, 0.2), 8.0)], realism=realism_of(number, size, body), seed=seed
    ).summary()
    x, y, _ = summary.com_error_rms
    return {
        "success": not summary.fell,
        "fell": summary.fall_time,
        "why": summary.fall_reason,
        "com": max(x or 0.0, y or 0.0),
        "velocity": max(v or 0.0 for v in summary.velocity_error_rms or [0.0]),
    }


def study(given: argparse.Namespace) -> pw.Study:
    """Return the walks asked for."""
    factors = {
        "robot": given.robot,
        "number": list(NUMBERS),
        "size": list(SIZES),
        "seed": list(range(given.seeds)),
    }
    return pw.Study(factors, walk, name="realism sweep")


def draw(results: pw.Results, robot: str) -> Figure:
    """Draw error and survival against size, one panel a number."""
    figure = Figure(figsize=(12, 10), layout="constrained")
    upright = results.survival(("number", "size"))["share"]
    stood = results.table[results.table["success"]]
    errors = 1e3 * stood.groupby(["number", "size"])["com"].median()
    for axes, (number, title) in zip(figure.subplots(4, 3).flat, NUMBERS.items(), strict=True):
        values = [value_of(number, size) for size in SIZES]
        keys = [(number, size) for size in SIZES]
        axes.plot(values, [errors.get(key, np.nan) for key in keys], "o-", color="#0072B2")
        axes.set(xlabel=title, ylim=(0, 30))
        axes.set_ylabel("CoM error [mm]", color="#0072B2")
        share = axes.twinx()
        shares = [upright.get(key, np.nan) for key in keys]
        share.plot(values, shares, "s--", color="#D55E00", markersize=4)
        share.set(ylim=(-0.05, 1.05))
        share.set_ylabel("upright", color="#D55E00")
        axes.axvline(values[1], color="#BBBBBB", linewidth=1)
    figure.suptitle(f"{robot}: one number of the laboratory's robot (grey line) changed at a time")
    return figure


def report(results: pw.Results, given: argparse.Namespace) -> int:
    """Print a line a number and size, and draw them."""
    for (number, size), group in results.table.groupby(["number", "size"], sort=False):
        stood = group[group["success"]]
        line = f"{number:24} {value_of(number, size):8.4g}  upright {len(stood)} of {len(group)}"
        if len(stood):
            com, velocity = (1e3 * stood[name].median() for name in ("com", "velocity"))
            line += f"  CoM {com:5.1f} mm  velocity {velocity:5.1f} mm/s"
        print(line)
    draw(results, given.robot).savefig(given.out / "sweep.png", dpi=90)
    return 0


def main() -> int:
    """Walk, sum up, draw."""
    parser = make_parser(__doc__, "realism_sweep")
    parser.add_argument("--robot", default="talos", help="of the catalogue (default talos)")
    parser.add_argument("--seeds", type=int, default=3, help="walks of each size (default 3)")
    return run(parser, study, report)


if __name__ == "__main__":
    sys.exit(main())
