"""How fast a robot walks: speed against CoM error, torque and cost of transport.

Every speed is commanded to a standing robot for 15 s; beyond what its limits allow, steps are made
as much longer as they are made quicker. The fastest walk that holds its speed (within 5 %, no fall)
is printed, the curves are drawn.

    python benchmarks/speed_sweep.py --robot talos --jobs 4 --out speed_sweep.png
"""

from __future__ import annotations

import argparse
import os
import sys
from concurrent.futures import ProcessPoolExecutor, as_completed
from dataclasses import replace
from math import nan
from multiprocessing import get_context

# One thread for each walk: their matrices are small, and the walks run beside each other.
os.environ.setdefault("OMP_NUM_THREADS", "1")
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import numpy as np
from matplotlib.figure import Figure
from tqdm import tqdm

import preview_walk as pw
from preview_walk import gait_limits, saturated

SHARES = [0.08 * k for k in range(1, 17)]
"""Speeds, as shares of the fastest within the limits."""

SPAN = 15.0
"""How long (s) each is commanded."""

WITHIN = 0.05
"""A walk holds its speed when it is this share from it at most."""


def fastest(limits: pw.GaitLimits) -> float:
    """Return the forward speed (m/s) to which faster commands are scaled down."""
    return saturated((100.0, 0.0, 0.0), limits)[0]


def walk_at(name: str, speed: float) -> pw.Summary:
    """Return the figures of a robot that is commanded a forward speed (m/s)."""
    walk = pw.Walk.standing(pw.load_robot(name))
    limits = walk.limits
    stretch = max(1.0, speed / fastest(limits)) ** 0.5
    walk.limits = replace(
        limits,
        forward=limits.forward * stretch,
        fast_step_time=limits.fast_step_time / stretch,
    )
    walk.command(speed, 0.0, 0.0)
    walk.run(until=SPAN)
    walk.command(0.0, 0.0, 0.0)
    return walk.run().record().summary()


def holds(speed: float, summary: pw.Summary) -> bool:
    """Tell whether a walk kept to its speed (m/s) and on its feet."""
    return not summary.fell and abs((summary.speed or 0.0) - speed) <= WITHIN * speed


def draw(done: dict[float, pw.Summary], name: str, out: str) -> None:
    """Draw error, torque and cost over the commanded speed; hollow where it was not held."""
    figure = Figure(figsize=(9, 10), layout="constrained")
    error, torque, cost = figure.subplots(3, 1, sharex=True)
    speeds = np.array(list(done))
    held = np.array([holds(v, done[v]) for v in done])
    rms = np.array(
        [[nan if e is None else 1e3 * e for e in s.com_error_rms] for s in done.values()]
    )
    curves = [
        (error, rms[:, k], f"tab:{c}", "xyz"[k]) for k, c in enumerate(("blue", "orange", "green"))
    ]
    curves.append((torque, np.array([s.torque_ratio_max or nan for s in done.values()]), "k", ""))
    curves.append((cost, np.array([s.cost_of_transport or nan for s in done.values()]), "k", ""))
    for axes, values, colour, label in curves:
        axes.plot(speeds, values, color=colour, linewidth=1.0)
        axes.plot(speeds[held], values[held], "o", color=colour, label=label)
        axes.plot(speeds[~held], values[~held], "o", color=colour, markerfacecolor="white")
        axes.grid(alpha=0.3)
    error.legend(title="axis")
    error.set(ylabel="CoM error rms [mm]", title=f"{name}: hollow where the speed was not held")
    torque.set(ylabel="largest torque / limit")
    cost.set(ylabel="cost of transport", xlabel="commanded speed [m/s]", ylim=(0.0, None))
    figure.savefig(out, dpi=120)


def main() -> int:
    """Sweep, print the table and the fastest walk; return 1 where no speed was held."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--robot", default="talos", help="name or path of the robot")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="processes (default: all)")
    parser.add_argument("--out", default="speed_sweep.png", help="the picture to write")
    options = parser.parse_args()

    robot = pw.load_robot(options.robot)
    top = fastest(gait_limits(robot))
    speeds = [share * top for share in SHARES]
    found: dict[float, pw.Summary] = {}
    with ProcessPoolExecutor(options.jobs, mp_context=get_context("spawn")) as pool:
        futures = {pool.submit(walk_at, options.robot, speed): speed for speed in speeds}
        for future in tqdm(as_completed(futures), total=len(speeds), unit="walk"):
            found[futures[future]] = future.result()

    done = {speed: found[speed] for speed in speeds}
    print(f"{robot.title}; its limits allow {top:.3f} m/s")
    print("commanded   speed   CoM error rms x, y, z   torque   cost of     QPs")
    print("      m/s     m/s                      mm   /limit   transport   lost   outcome")
    for speed, s in done.items():
        x, y, z = (nan if e is None else 1e3 * e for e in s.com_error_rms)
        outcome = f"fell at {s.fall_time:.1f} s: {s.fall_reason}" if s.fell else "walked"
        print(
            f"{speed:9.3f} {s.speed or nan:7.3f} {x:9.2f} {y:6.2f} {z:6.2f} "
            f"{s.torque_ratio_max or nan:8.2f} {s.cost_of_transport or nan:11.3f} "
            f"{s.qp_failures:6d}   {outcome}"
        )
    draw(done, robot.title, options.out)
    best = max((v for v in done if holds(v, done[v])), default=None)
    if best is None:
        print(f"{options.robot} held none of these speeds")
        return 1
    print(f"fastest walk of {options.robot} that holds its speed: {done[best].speed:.3f} m/s")
    return 0


if __name__ == "__main__":
    sys.exit(main())
