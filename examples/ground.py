"""TALOS walks where the ground is not flat: up and down a slope, over ramps, on stepping stones.

python examples/ground.py --out ground.png
"""

import argparse

import numpy as np
from matplotlib.figure import Figure

import preview_walk as pw

GROUNDS = ("slope:degrees=8", "slope:degrees=-8", "ramps:degrees=8", "stones:width=0.22")


def main() -> None:
    """Walk over each ground, print how well, and draw soles and CoM from the side."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--robot", default="talos", help="name or path of the robot")
    parser.add_argument("--out", default="ground.png", help="the picture to write")
    options = parser.parse_args()

    robot = pw.load_robot(options.robot)
    length = 0.3 * robot.leg_length
    planner = pw.FootstepPlanner(length, robot.step_width, 0.9)
    figure = Figure(figsize=(12, 3 * len(GROUNDS)), layout="constrained")
    print("ground               CoM error rms x, y, z (mm)   torque / limit")
    for axes, name in zip(figure.subplots(len(GROUNDS), 1), GROUNDS, strict=True):
        ground = pw.read_ground(name)
        # The steps are planned as on level ground; `simulate` lays them on this one.
        record = pw.simulate(robot, planner.generate_footsteps(12, ramp=2), ground=ground)
        summary = record.summary()
        errors = "".join(f"{1e3 * (x or 0.0):8.2f}" for x in summary.com_error_rms)
        end = f"fell: {summary.fall_reason}" if summary.fell else ""
        print(f"{name:20} {errors} {summary.torque_ratio_max:18.2f}  {end}")

        x = np.linspace(-0.5, record.com[-1, 0] + 0.5, 800)
        y = np.full_like(x, 0.5 * robot.step_width)
        axes.fill_between(x, ground.height(x, y), -1.0, color="0.85", label="ground")
        for foot, colour in (("left", "tab:blue"), ("right", "tab:orange")):
            sole = getattr(record, f"{foot}_foot")[:, :3, 3]
            axes.plot(sole[:, 0], sole[:, 2], color=colour, linewidth=1, label=f"{foot} sole")
        axes.plot(record.com[:, 0], record.com[:, 2], color="tab:green", label="CoM")
        axes.plot(record.com_ref[:, 0], record.com_ref[:, 2], "k--", linewidth=0.8)
        axes.set(title=f"{name} (planned: dashed)", xlabel="x (m)", ylabel="z (m)", aspect="equal")
        axes.set(ylim=(record.left_foot[:, 2, 3].min() - 0.2, record.com[:, 2].max() + 0.1))
        axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
    figure.savefig(options.out, dpi=110)
    print(f"wrote {options.out}")


if __name__ == "__main__":
    main()
