"""What each gain does: TALOS walks with one gain halved and doubled, and is pushed once.

Prints the table of `tuning.md` and draws `tuning.png`.

    python docs/tuning.py
"""

from dataclasses import replace
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

import preview_walk as pw
from preview_walk import FootstepPlan, Robot

HERE = Path(__file__).parent
GAINS = (
    "dcm",
    "height",
    "foot",
    "torso",
    "posture",
    "com_weight",
    "foot_weight",
    "torso_weight",
    "posture_weight",
    "trunk_weight",
    "wrench_weight",
)
FACTORS = (0.5, 2.0)
COLUMNS = ("CoM x", "CoM y", "CoM z", "ZMP x", "ZMP y", "push", "torso", "effort")
UNITS = ("mm", "mm", "mm", "mm", "mm", "mm", "deg", "")
PUSH_SHARE, IMPULSE = 0.6, 6.0  # of the walk; N·s to the left, small enough to need no other step


def measure(robot: Robot, plan: FootstepPlan, gains: pw.TrackingGains) -> list[float]:
    """Return the columns of the table for a walk with these gains."""
    at = PUSH_SHARE * plan.end
    push = pw.Push(at, 0.1, (0.0, IMPULSE / 0.1, 0.0))
    record = pw.simulate(robot, plan, gains=gains, pushes=[push])
    calm, after = record.time < at, record.time >= at
    if record.run.fell:
        return [np.nan] * len(COLUMNS)
    com = 1e3 * (record.com - record.com_ref)
    zmp = 1e3 * (record.zmp - record.zmp_ref)
    motors = robot.effort > 0.0
    return [
        *np.sqrt((com[calm] ** 2).mean(axis=0)),
        *np.sqrt(np.nanmean(zmp[calm] ** 2, axis=0)),
        np.hypot(com[after, 0], com[after, 1]).max(),
        np.degrees(record.torso_tilt.max()),
        np.sqrt(((record.tau[calm] / np.where(motors, robot.effort, np.inf)) ** 2).mean()),
    ]


def main() -> None:
    """Walk with every gain halved and doubled."""
    robot = pw.load_robot("talos")
    planner = pw.FootstepPlanner(0.35, robot.step_width, step_time=0.7)
    plan = planner.generate_footsteps(8, ramp=2)
    default = pw.TrackingGains()
    usual = measure(robot, plan, default)
    print("| gain | value | " + " | ".join(COLUMNS) + " |")
    print("|---|---" + "|---" * len(COLUMNS) + "|")

    def row(name: str, value: str, figures: list[float]) -> None:
        digits = [3 if unit == "" else 2 for unit in UNITS]
        cells = [f"{x:.{d}f}" for x, d in zip(figures, digits, strict=True)]
        print(f"| {name} | {value} | " + " | ".join(cells) + " |", flush=True)

    row("all as they are", "", usual)
    ratios = np.ones((len(GAINS), len(FACTORS), len(COLUMNS)))
    for i, name in enumerate(GAINS):
        for k, factor in enumerate(FACTORS):
            value = factor * getattr(default, name)
            figures = measure(robot, plan, replace(default, **{name: value}))
            ratios[i, k] = np.array(figures) / usual
            row(f"`{name}`", f"{value:g}", figures)

    figure = Figure(figsize=(11, 6), layout="constrained")
    for k, axes in enumerate(figure.subplots(1, 2, sharey=True)):
        image = axes.imshow(np.log2(ratios[:, k]), cmap="RdBu_r", vmin=-1.0, vmax=1.0)
        axes.set(title=f"gain times {FACTORS[k]:g}")
        axes.set_xticks(range(len(COLUMNS)), COLUMNS, rotation=45, ha="right")
        axes.set_yticks(range(len(GAINS)), GAINS)
        for i in range(len(GAINS)):
            for j in range(len(COLUMNS)):
                ratio = ratios[i, k, j]
                ink = "white" if abs(np.log2(ratio)) > 0.65 else "black"
                axes.text(j, i, f"{ratio:.2f}", ha="center", va="center", fontsize=7, color=ink)
    figure.colorbar(image, label="log2 of the figure over that of the usual gains")
    figure.savefig(HERE / "tuning.png", dpi=80)
    print(f"wrote {HERE / 'tuning.png'}")


if __name__ == "__main__":
    main()
