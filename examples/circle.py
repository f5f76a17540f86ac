"""TALOS walks a full circle of 1 m radius and ends on the spot where it began.

python examples/circle.py --out circle.png
"""

import argparse
from math import pi

import numpy as np

import preview_walk as pw
from preview_walk import gait_limits

RADIUS = 1.0


def main() -> None:
    """Walk the circle, print how round it was and draw it from above."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", default="circle.png", help="the picture to write")
    out = parser.parse_args().out

    robot = pw.load_robot("talos")
    planner = pw.FootstepPlanner(step_length=0.25, step_width=robot.step_width, step_time=0.8)
    plan = pw.arc(RADIUS, 2.0 * pi, planner, limits=gait_limits(robot), ramp=2)
    record = pw.simulate(robot, plan)

    # The circle lies to the left of the start, so its centre is at (0, 1) m. While the robot sways
    # over its feet, the mean over one step tells where it walks.
    step = round(planner.step_time / record.dt)
    track = np.column_stack(
        [np.convolve(record.com[:, k], np.full(2 * step, 0.5 / step), "valid") for k in (0, 1)]
    )
    radius = np.hypot(track[:, 0], track[:, 1] - RADIUS)
    print(record.summary())
    print(f"{len(plan.steps)} steps; the CoM's mean path is {radius.mean():.3f} m from the centre,")
    print(f"between {radius.min():.3f} and {radius.max():.3f} m")
    pw.save_plot(record, "top_view", out)
    print(f"wrote {out}")


if __name__ == "__main__":
    main()
