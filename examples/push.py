"""TALOS is pushed while it walks and steps elsewhere to go on.

python examples/push.py --out push.png
"""

import argparse
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

import preview_walk as pw
from preview_walk import PlanRevision

FORCE, DURATION = (240.0, 100.0, 0.0), 0.2  # N, forward and to the left; s


def draw_soles(axes: Axes, plan: PlanRevision, sole: pw.Sole, **style: Any) -> None:
    """Outline every sole of a plan."""
    for pose in plan.pose:
        corners = sole.corners(pose)
        axes.fill(corners[:, 0], corners[:, 1], fill=False, **style)


def main() -> None:
    """Push, print how many steps moved and draw the footholds before and after."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", default="push.png", help="the picture to write")
    out = parser.parse_args().out

    robot = pw.load_robot("talos")
    planner = pw.FootstepPlanner(step_length=0.25, step_width=robot.step_width, step_time=0.8)
    plan = planner.generate_footsteps(12, ramp=2)
    push = pw.Push(t=plan.steps[5].lift + 0.1, duration=DURATION, force=FORCE)
    record = pw.simulate(robot, plan, pushes=[push])

    before, after = record.plans[0], record.plans[-1]
    moved = np.linalg.norm(after.pose[:, :2, 3] - before.pose[:, :2, 3], axis=1)
    print(record.summary())
    impulse = np.linalg.norm(FORCE) * DURATION
    print(f"{impulse:.0f} N·s at {push.t:.2f} s; the plan changed {len(record.plans) - 1} times")
    print(f"first changed step: {1e3 * moved[moved > 1e-9][0]:.0f} mm from where it was planned")

    figure = Figure(figsize=(12, 9), layout="constrained")
    top, forward, sideways = figure.subplots(3, 1, height_ratios=[1.2, 2, 2])
    sole = pw.Sole(*record.run.sole)
    draw_soles(top, before, sole, color="0.6", linestyle="--")
    draw_soles(top, after, sole, color="tab:red")
    top.plot(*record.com[:, :2].T, color="tab:blue", label="CoM")
    top.plot(*record.dcm.T, color="tab:green", linewidth=0.9, label="DCM")
    at = record.com[np.searchsorted(record.time, push.t), :2]
    top.quiver(*at, *FORCE[:2], color="tab:red", angles="xy", scale=2000.0, label="push")
    top.set(xlabel="x [m]", ylabel="y [m]", aspect="equal", title="Soles before (grey) and after")
    top.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
    for k, axes in enumerate((forward, sideways)):
        axes.axvspan(push.t, push.t + DURATION, color="tab:red", alpha=0.2)
        axes.plot(record.time, record.zmp[:, k], color="tab:orange", linewidth=0.8, label="ZMP")
        axes.plot(record.time, record.dcm[:, k], color="tab:green", label="DCM")
        axes.plot(record.time, record.dcm_ref[:, k], "k--", linewidth=0.8, label="DCM planned")
        axes.set(xlabel="time [s]", ylabel=f"{'xy'[k]} [m]")
    forward.legend(loc="upper left")
    figure.savefig(out, dpi=120)
    print(f"wrote {out}")


if __name__ == "__main__":
    main()
