"""How fast a robot walks: speed against CoM error, torque and cost of transport.

Every speed is commanded to a standing robot for 15 s; beyond what its limits allow, steps are made
as much longer as they are made quicker. The fastest walk that holds its speed (within 5 %, no fall)
is printed; `speeds.png` in the folder draws the curves.

    python benchmarks/speed_sweep.py --robot talos --jobs 4
"""

from __future__ import annotations

import argparse
import sys
from dataclasses import replace
from typing import Any

from campaign import make_parser, run, scaled
from matplotlib.figure import Figure

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


def walk_at(robot: str, speed: float) -> pw.Record:
    """Return the record of a robot that is commanded a forward speed (m/s)."""
    walk = pw.Walk.standing(pw.loaded_robot(robot))
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
    return walk.run().record()


def holds(speed: float, summary: pw.Summary) -> bool:
    """Tell whether a walk kept to its speed (m/s) and on its feet."""
    return not summary.fell and abs((summary.speed or 0.0) - speed) <= WITHIN * speed


def walked(robot: str, speed: float) -> dict[str, Any]:
    """Return the figures of a walk at a commanded speed; it succeeds if it holds it."""
    summary = walk_at(robot, speed).summary()
    x, y, z = summary.com_error_rms
    return {
        "success": holds(speed, summary),
        "held": summary.speed,
        "error_x": x,
        "error_y": y,
        "error_z": z,
        "torque": summary.torque_ratio_max,
        "cost": summary.cost_of_transport,
        "lost": summary.qp_failures,
        "fell": summary.fall_time,
        "why": summary.fall_reason,
    }


def study(given: argparse.Namespace) -> pw.Study:
    """Return the walks."""
    top = fastest(gait_limits(pw.load_robot(given.robot)))
    speeds = [share * top for share in SHARES]
    return pw.Study({"robot": given.robot, "speed": speeds}, walked, name="speed sweep")


def draw(results: pw.Results, title: str) -> Figure:
    """Draw error, torque and cost over the commanded speed; hollow where it was not held."""
    figure = Figure(figsize=(9, 10), layout="constrained")
    error, torque, cost = figure.subplots(3, 1, sharex=True)
    table = results.table
    held = table["success"].to_numpy(bool)
    speeds = table["speed"].to_numpy(float)
    curves = [
        (error, 1e3, f"error_{axis}", colour)
        for axis, colour in zip("xyz", ("#0072B2", "#E69F00", "#009E73"), strict=True)
    ]
    curves += [(torque, 1.0, "torque", "k"), (cost, 1.0, "cost", "k")]
    for axes, scale, name, colour in curves:
        values = scale * table[name].to_numpy(float)
        axes.plot(speeds, values, color=colour, linewidth=1.0)
        label = name[-1] if axes is error else None
        axes.plot(speeds[held], values[held], "o", color=colour, label=label)
        axes.plot(speeds[~held], values[~held], "o", color=colour, markerfacecolor="white")
        axes.grid(alpha=0.3)
    error.legend(title="axis")
    error.set(ylabel="CoM error rms [mm]", title=f"{title}: hollow where the speed was not held")
    torque.set(ylabel="largest torque / limit")
    cost.set(ylabel="cost of transport", xlabel="commanded speed [m/s]", ylim=(0.0, None))
    return figure


def report(results: pw.Results, given: argparse.Namespace) -> int:
    """Print the table and the fastest walk; return 1 where no speed was held."""
    robot = pw.load_robot(given.robot)
    print(f"{robot.title}; its limits allow {fastest(gait_limits(robot)):.3f} m/s")
    print("commanded   speed   CoM error rms x, y, z   torque   cost of     QPs")
    print("      m/s     m/s                      mm   /limit   transport   lost   outcome")
    for row in results.table.itertuples():
        outcome = "walked" if row.why is None else f"fell at {row.fell:.1f} s: {row.why}"
        print(
            f"{row.speed:9.3f} {row.held:7.3f} "
            f"{scaled([row.error_x, row.error_y, row.error_z], 1e3, 2):>23} "
            f"{row.torque:8.2f} {row.cost:11.3f} {row.lost:6d}   {outcome}"
        )
    draw(results, robot.title).savefig(given.out / "speeds.png", dpi=120)
    held = results.table[results.table["success"]]
    if not len(held):
        print(f"{given.robot} held none of these speeds")
        return 1
    print(f"fastest walk of {given.robot} that holds its speed: {held['held'].iloc[-1]:.3f} m/s")
    return 0


def main() -> int:
    """Sweep, print, draw; return 1 where no speed was held."""
    parser = make_parser(__doc__, "speed_sweep")
    parser.add_argument("--robot", default="talos", help="name or path of the robot")
    return run(parser, study, report)


if __name__ == "__main__":
    sys.exit(main())
