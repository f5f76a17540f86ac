"""Walks of robots as they are: sensors, motors and a model that are not perfect.

    python benchmarks/realism.py --kind turning --robot talos --seeds 20 --jobs 2
    python benchmarks/realism.py --kind faults --robot g1

"turning" walks 20 s at 0.5 m/s, turning left and then right; "random" walks 20 s by random
commands over unseen ground of 1 cm with a push in a random direction every 4 s; "faults" are single
faults of a robot of the laboratory. One line a walk: true CoM error (rms, mm; x, y along the
heading, z), error of the base's estimated velocity (mm/s), drift (% of the way), and whether it
fell; the last lines sum up.
"""

from __future__ import annotations

import argparse
import sys
from dataclasses import replace
from math import nan
from typing import Any

import numpy as np
from campaign import make_parser, run, scaled
from scipy.ndimage import zoom

import preview_walk as pw

LEG = 0.812
"""Length of TALOS's leg, m: speeds are its, others' are in proportion to the root of theirs."""

IMPULSE = 0.13
"""Size of a push, N·s/kg: half of what a pendulum with fixed footholds can take of a push to the
side (docs/push_bounds.png)."""

FAULTS: dict[str, pw.Fault] = {
    "sole sensor dead": pw.Fault("sole", "left", t=4.0, value=0.0),
    "encoder frozen 0.1 s": pw.Fault("encoder", "KNEE", t=4.0, duration=0.1),
    "knee at 80 %": pw.Fault("motor", "KNEE", t=0.0, value=0.8),
    "gyro nan, a tick": pw.Fault("gyro", None, t=4.0, duration=0.002, value=nan),
    "joint speed 1e6, a tick": pw.Fault("speed", "KNEE", t=4.0, duration=0.002, value=1e6),
}
"""Faults of single parts; KNEE stands for the left knee."""


MORE_FAULTS = ("torque delay 8 ms", "gyro bias 0.05 rad/s", "payload of a tenth", "wind of a tenth")
"""Faults that are no single part's."""


def with_fault(realism: pw.Realism, fault: str, robot: pw.Robot) -> pw.Realism:
    """Return what is not perfect, with a fault more."""
    if fault == "torque delay 8 ms":
        return replace(realism, motors=replace(realism.motors, delay=0.008))
    if fault == "gyro bias 0.05 rad/s":
        return replace(realism, imu=replace(realism.imu, gyro_bias=0.05))
    if fault == "payload of a tenth":
        hand = robot.mj.body(int(robot.mj.nbody) - 1).name
        load = pw.Payload(0.1 * robot.mass, hand)
        return replace(realism, mismatch=replace(realism.mismatch, payload=load))
    if fault == "wind of a tenth":  # a push of its own
        return realism
    single = FAULTS[fault]
    knee = robot.joint_names[int(robot.pin.joints[robot.legs["left"].knee].idx_v) - 6]
    which = knee if single.which == "KNEE" else single.which
    return realism.with_fault(replace(single, which=which))


def uneven(rng: np.random.Generator) -> pw.HeightField:
    """Return ground of random heights within 1 cm, 0.4 m apart, level where the robot starts.

    Between them it is interpolated every 4 cm, as fine as the heights of `pw.rough`.
    """
    heights = rng.uniform(-0.01, 0.01, (61, 61))
    heights[28:33, 28:33] = 0.0
    return pw.HeightField(zoom(heights, 601 / 61, order=1), 0.04, -12.0, -12.0)


def walk(robot: str, realism: str, kind: str, seed: int, fault: str = "") -> pw.Record:
    """Walk a case; return its record."""
    body = pw.loaded_robot(robot)
    speed = 0.5 * (body.leg_length / LEG) ** 0.5
    imperfect = pw.read_realism(realism)
    settings: dict[str, Any] = {"realism": imperfect, "seed": seed}
    commands = [((speed, 0.0, 0.2), 10.0), ((speed, 0.0, -0.2), 10.0)]
    if kind == "random":
        rng = np.random.default_rng(seed)
        pushes = pw.random_pushes(4.0, IMPULSE * body.mass, 0.1, 20.0, seed)
        commands = [
            ((speed * float(a), 0.3 * speed * float(b), 0.3 * float(c)), 4.0)
            for a, b, c in rng.uniform((-0.4, -1, -1), 1, (5, 3))
        ]
        settings |= {"pushes": pushes, "ground": uneven(rng), "blind": True}
    if fault:
        commands = [((speed, 0.0, 0.1), 10.0)]
        if imperfect is not None:
            settings["realism"] = with_fault(imperfect, fault, body)
        if fault == "wind of a tenth":
            wind = (0.0, 0.1 * body.mass * body.gravity, 0.0)
            settings["pushes"] = [pw.Push(3.0, 10.0, wind)]
    return pw.simulate_commands(body, commands, **settings)


def study(given: argparse.Namespace) -> pw.Study:
    """Return the walks asked for."""
    faults = [*FAULTS, *MORE_FAULTS] if given.kind == "faults" else [""]
    factors = {
        "robot": given.robot or ["talos"],
        "realism": given.realism,
        "kind": given.kind,
        "fault": faults,
        "seed": list(range(given.first, given.first + given.seeds)),
    }
    return pw.Study(factors, walk, keep="failed", name="realism")


def line(row: Any) -> str:
    """Return a walk in one line."""
    com = scaled([row.com_error_rms_x, row.com_error_rms_y, row.com_error_rms_z], 1e3)
    names = ("velocity_error_rms_x", "velocity_error_rms_y", "velocity_error_rms_z")
    velocity = scaled([getattr(row, name, nan) for name in names], 1e3)
    end = "walked" if row.success else f"FELL at {row.fall_time:.2f} s: {row.fall_reason}"
    drift = scaled(row.drift, 1e2)
    name = f"{row.robot} {row.realism} {row.kind} {row.fault} {row.seed}"
    return f"{name:48} com {com} mm  v {velocity} mm/s  drift {drift} %  {end}"


def report(results: pw.Results, given: argparse.Namespace) -> int:
    """Print every walk, and the largest errors of each robot's that stayed upright."""
    ended = results.table[results.table["outcome"] == "done"]
    for row in ended.itertuples():
        print(line(row))
    print(results)
    columns = ["com_error_rms", "velocity_error_rms"]
    names = [f"{column}_{axis}" for column in columns for axis in "xyz"] + ["drift"]
    largest = ended[ended["success"]].groupby("robot")[[n for n in names if n in ended]].max()
    print("largest of the upright walks, mm, mm/s, % of the way:")
    print((largest * [1e2 if n == "drift" else 1e3 for n in largest]).round(1).to_string())
    return 0 if ended["success"].all() else 1


def main() -> int:
    """Walk and sum up; return 1 where a walk fell."""
    parser = make_parser(__doc__, "realism")
    parser.add_argument("--robot", action="append", help="may be repeated (default: talos)")
    parser.add_argument("--realism", default="lab", help="none, lab or field (default lab)")
    kinds = ("turning", "random", "faults")
    parser.add_argument("--kind", choices=kinds, default="turning", help="default turning")
    parser.add_argument("--seeds", type=int, default=5, help="how many (default 5)")
    parser.add_argument("--first", type=int, default=0, help="the first seed (default 0)")
    return run(parser, study, report)


if __name__ == "__main__":
    sys.exit(main())
