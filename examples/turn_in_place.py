"""TALOS turns once around itself on the spot.

python examples/turn_in_place.py --out turn_in_place.png
"""

import argparse
from math import pi

import numpy as np
from matplotlib.figure import Figure

import preview_walk as pw
from preview_walk import draw_top_view, gait_limits


def main() -> None:
    """Turn, print how far the robot drifted and draw footprints and headings."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", default="turn_in_place.png", help="the picture to write")
    out = parser.parse_args().out

    robot = pw.load_robot("talos")
    planner = pw.FootstepPlanner(step_width=robot.step_width, step_time=0.8)
    plan = pw.turn_in_place(2.0 * pi, planner, limits=gait_limits(robot))
    record = pw.simulate(robot, plan)

    drift = np.hypot(*(0.5 * (record.left_foot + record.right_foot)[-1, :2, 3]))
    print(record.summary())
    print(f"{len(plan.steps)} steps, {plan.end:.1f} s; midfeet ended {1e3 * drift:.1f} mm away")

    figure = Figure(figsize=(16, 7.5), layout="constrained")
    left, right = figure.subplots(1, 2)
    draw_top_view(left, record)
    for name, colour in (("left", "tab:blue"), ("right", "tab:orange")):
        for suffix, style in (("", {"color": colour}), ("_ref", {"color": "k", "dashes": (3, 3)})):
            pose = getattr(record, f"{name}_foot{suffix}")
            yaw = np.degrees(np.unwrap(np.arctan2(pose[:, 1, 0], pose[:, 0, 0])))
            label = f"{name} foot, {'planned' if suffix else 'measured'}"
            right.plot(record.time, yaw, **style, linewidth=1.0, label=label)
    right.set(xlabel="time [s]", ylabel="heading [deg]", title="Heading of the soles")
    right.legend()
    figure.savefig(out, dpi=100)
    print(f"wrote {out}")


if __name__ == "__main__":
    main()
