"""Walks of robots as they are: sensors, motors and a model that are not perfect.

    python benchmarks/realism.py --kind turning --robot talos --seeds 20 --jobs 2 --out real.jsonl
    python benchmarks/realism.py --kind faults --robot g1

"turning" walks 20 s at 0.5 m/s, turning left and then right; "random" walks 20 s by random
commands over unseen ground of 1 cm with a push in a random direction every 4 s; "faults" are single
faults of a robot of the laboratory. One line a walk: true CoM error (rms, mm; x, y along the
heading, z), error of the base's estimated velocity (mm/s), drift (% of the way), and whether it
fell. Walks that are in the file already are not walked again; the last lines sum up.
"""

from __future__ import annotations

import argparse
import json
from concurrent.futures import ProcessPoolExecutor
from dataclasses import asdict, dataclass, replace
from functools import cache
from math import nan
from pathlib import Path
from typing import Any

import numpy as np
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


@dataclass(frozen=True)
class Case:
    """A walk to be made."""

    robot: str
    realism: str
    kind: str
    seed: int
    fault: str = ""


@cache
def robot_of(name: str) -> pw.Robot:
    """Return a robot, loaded once a process."""
    return pw.load_robot(name)


def realism_of(case: Case, robot: pw.Robot) -> pw.Realism | None:
    """Return what is not perfect in a case."""
    realism = pw.read_realism(case.realism)
    if case.kind != "faults" or realism is None:
        return realism
    if case.fault == "torque delay 8 ms":
        return replace(realism, motors=replace(realism.motors, delay=0.008))
    if case.fault == "gyro bias 0.05 rad/s":
        return replace(realism, imu=replace(realism.imu, gyro_bias=0.05))
    if case.fault == "payload of a tenth":
        hand = robot.mj.body(int(robot.mj.nbody) - 1).name
        load = pw.Payload(0.1 * robot.mass, hand)
        return replace(realism, mismatch=replace(realism.mismatch, payload=load))
    if case.fault == "wind of a tenth":
        return realism
    fault = FAULTS[case.fault]
    knee = robot.joint_names[int(robot.pin.joints[robot.legs["left"].knee].idx_v) - 6]
    return realism.with_fault(replace(fault, which=knee if fault.which == "KNEE" else fault.which))


def uneven(rng: np.random.Generator) -> pw.HeightField:
    """Return ground of random heights within 1 cm, 0.4 m apart, level where the robot starts.

    Between them it is interpolated every 4 cm, as fine as the heights of `pw.rough`.
    """
    heights = rng.uniform(-0.01, 0.01, (61, 61))
    heights[28:33, 28:33] = 0.0
    return pw.HeightField(zoom(heights, 601 / 61, order=1), 0.04, -12.0, -12.0)


def walk(case: Case) -> dict[str, Any]:
    """Walk a case; return its figures."""
    robot = robot_of(case.robot)
    speed = 0.5 * (robot.leg_length / LEG) ** 0.5
    settings: dict[str, Any] = {"realism": realism_of(case, robot), "seed": case.seed}
    commands = [((speed, 0.0, 0.2), 10.0), ((speed, 0.0, -0.2), 10.0)]
    if case.kind == "random":
        rng = np.random.default_rng(case.seed)
        pushes = pw.random_pushes(4.0, IMPULSE * robot.mass, 0.1, 20.0, case.seed)
        commands = [
            ((speed * float(a), 0.3 * speed * float(b), 0.3 * float(c)), 4.0)
            for a, b, c in rng.uniform((-0.4, -1, -1), 1, (5, 3))
        ]
        settings |= {"pushes": pushes, "ground": uneven(rng), "blind": True}
    if case.kind == "faults":
        commands = [((speed, 0.0, 0.1), 10.0)]
        if case.fault == "wind of a tenth":
            wind = (0.0, 0.1 * robot.mass * robot.gravity, 0.0)
            settings["pushes"] = [pw.Push(3.0, 10.0, wind)]
    summary = pw.simulate_commands(robot, commands, **settings).summary()
    return {
        "fell": summary.fall_time,
        "why": summary.fall_reason,
        "com": summary.com_error_rms,
        "velocity": summary.velocity_error_rms,
        "drift": summary.drift,
        "refused": summary.refused,
    }


MORE_FAULTS = ("torque delay 8 ms", "gyro bias 0.05 rad/s", "payload of a tenth", "wind of a tenth")


def cases(given: argparse.Namespace) -> list[Case]:
    """Return the walks asked for."""
    seeds = range(given.first, given.first + given.seeds)
    faults = (*FAULTS, *MORE_FAULTS) if given.kind == "faults" else ("",)
    return [
        Case(given.robot, given.realism, given.kind, seed, fault)
        for fault in faults
        for seed in seeds
    ]


def line(case: Case, figures: dict[str, Any]) -> str:
    """Return a walk in one line."""
    com = ", ".join(f"{1e3 * x:5.1f}" for x in figures["com"])
    velocity = ", ".join(f"{1e3 * x:5.1f}" for x in figures["velocity"] or [nan])
    end = "walked" if figures["fell"] is None else f"FELL at {figures['fell']:.2f} s"
    drift = 1e2 * (figures["drift"] or 0.0)
    name = f"{case.robot} {case.realism} {case.kind} {case.fault} {case.seed}"
    return f"{name:48} com {com} mm  v {velocity} mm/s  drift {drift:4.1f} %  {end}"


def main() -> None:
    """Walk what is not in the file yet, and sum up."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--robot", default="talos", help="of the catalogue (default talos)")
    parser.add_argument("--realism", default="lab", help="none, lab or field (default lab)")
    kinds = ("turning", "random", "faults")
    parser.add_argument("--kind", choices=kinds, default="turning", help="default turning")
    parser.add_argument("--seeds", type=int, default=5, help="how many (default 5)")
    parser.add_argument("--first", type=int, default=0, help="the first seed (default 0)")
    parser.add_argument("--jobs", type=int, default=1, help="processes (default 1)")
    parser.add_argument("--out", type=Path, help="file of results, one JSON line a walk")
    given = parser.parse_args()
    done = {}
    if given.out is not None and given.out.exists():
        for text in given.out.read_text().splitlines():
            entry = json.loads(text)
            done[Case(**entry["case"])] = entry["figures"]
    asked = cases(given)
    left = [case for case in asked if case not in done]
    with ProcessPoolExecutor(given.jobs) as pool:
        for case, figures in zip(left, pool.map(walk, left), strict=True):
            done[case] = figures
            print(line(case, figures), flush=True)
            if given.out is not None:
                with given.out.open("a") as file:
                    entry = {"case": asdict(case), "figures": figures}
                    file.write(json.dumps(entry) + "\n")
    found = [done[case] for case in asked]
    upright = [f for f in found if f["fell"] is None]
    print(f"{len(upright)} of {len(found)} walks upright")
    for name, scale in (("com", 1e3), ("velocity", 1e3)):
        worst = np.max([f[name] for f in upright], axis=0) * scale if upright else []
        print(f"largest {name} of those: {', '.join(f'{x:.1f}' for x in worst)} (mm, mm/s)")
    if upright:
        print(f"largest drift: {1e2 * max(f['drift'] for f in upright):.1f} %")


if __name__ == "__main__":
    main()
