"""TALOS walks 1 m to the left, 1 m backwards and 1 m to the right, as one plan.

python examples/sideways_and_backwards.py --out sideways_and_backwards.png
"""

import argparse

import preview_walk as pw
from preview_walk import FEET, gait_limits


def main() -> None:
    """Join three walks to one plan, walk it and draw it from above."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", default="sideways_and_backwards.png", help="the picture to write")
    out = parser.parse_args().out

    robot = pw.load_robot("talos")
    limits = gait_limits(robot)
    planner = pw.FootstepPlanner(step_length=0.2, step_width=robot.step_width, step_time=0.8)
    plan = pw.sideways(1.0, planner, limits=limits)
    plan = pw.straight(-1.0, planner, start=plan, limits=limits, ramp=1)
    plan = pw.sideways(-1.0, planner, start=plan, limits=limits)
    record = pw.simulate(robot, plan)

    print(record.summary())
    for foot in FEET:
        end, planned = getattr(record, f"{foot}_foot")[-1], record.plans[-1].last_pose(foot)
        off = 1e3 * (end - planned)[:2, 3]
        print(f"{foot} sole ends ({off[0]:.1f}, {off[1]:.1f}) mm from where it was planned")
    pw.save_plot(record, "top_view", out)
    print(f"wrote {out}")


if __name__ == "__main__":
    main()
