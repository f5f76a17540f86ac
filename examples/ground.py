"""TALOS walks where the ground is not flat: stairs, a slope, blocks and stones, from the side.

python examples/ground.py --out ground.png
python examples/ground.py --ground rough:height=0.03 --blind
"""

import argparse

import numpy as np
from matplotlib.figure import Figure

import preview_walk as pw

GROUNDS = (
    "stairs:rise=0.15,tread=0.28,count=4,back=yes",
    "slope:degrees=12",
    "blocks:height=0.06,size=0.4",
    "stones:width=0.22",
)


def main() -> None:
    """Walk over each ground, print how well, and draw soles and CoM from the side."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--robot", default="talos", help="name or path of the robot")
    parser.add_argument("--ground", action="append", help="another ground; may be repeated")
    parser.add_argument("--steps", type=int, default=14, help="on each ground")
    parser.add_argument("--blind", action="store_true", help="the robot takes it for level")
    parser.add_argument("--out", default="ground.png", help="the picture to write")
    options = parser.parse_args()

    robot = pw.load_robot(options.robot)
    planner = pw.FootstepPlanner(0.345 * robot.leg_length, robot.step_width, 1.2)
    names = options.ground or GROUNDS
    figure = Figure(figsize=(12, 3 * len(names)), layout="constrained")
    print("CoM error rms x, y, z (mm)  torque / limit  ground")
    for axes, name in zip(np.atleast_1d(figure.subplots(len(names), 1)), names, strict=True):
        # The steps are planned as on level ground; `simulate` lays them on this one.
        plan = planner.generate_footsteps(options.steps, ramp=1)
        ground = pw.read_ground(name)
        record = pw.simulate(robot, plan, ground=ground, blind=options.blind)
        summary = record.summary()
        errors = "".join(f"{1e3 * (x or 0.0):8.2f}" for x in summary.com_error_rms)
        end = f"  fell: {summary.fall_reason}" if summary.fell else ""
        print(f"{errors} {summary.torque_ratio_max:18.2f}  {name}{end}")
        draw(axes, record, name)
    figure.savefig(options.out, dpi=110)
    print(f"wrote {options.out}")


def draw(axes, record: pw.Record, name: str) -> None:
    """Draw the ground under the left foot's side, both soles and the CoM from the side."""
    x = np.linspace(-0.5, record.com[-1, 0] + 0.5, 800)
    y = np.full_like(x, 0.5 * record.run.step_width)
    axes.fill_between(x, record.ground.height(x, y), -3.0, color="0.85", label="ground")
    for foot, colour in (("left", "tab:blue"), ("right", "tab:orange")):
        sole = getattr(record, f"{foot}_foot")[:, :3, 3]
        axes.plot(sole[:, 0], sole[:, 2], color=colour, linewidth=1, label=f"{foot} sole")
    axes.plot(record.com[:, 0], record.com[:, 2], color="tab:green", label="CoM")
    axes.plot(record.com_ref[:, 0], record.com_ref[:, 2], "k--", linewidth=0.8)
    axes.set(title=f"{name} (planned: dashed)", xlabel="x (m)", ylabel="z (m)", aspect="equal")
    low = min(record.left_foot[:, 2, 3].min(), record.right_foot[:, 2, 3].min())
    axes.set(ylim=(low - 0.2, record.com[:, 2].max() + 0.1), xlim=(x[0], x[-1]))
    axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))


if __name__ == "__main__":
    main()
