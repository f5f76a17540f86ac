"""What a weight of the whole-body QP does: the posture's pull against the CoM's error.

python examples/change_a_weight.py --out change_a_weight.png
"""

import argparse
from dataclasses import replace

from matplotlib.figure import Figure

import preview_walk as pw

FACTORS = (0.2, 1.0, 5.0, 25.0)


def main() -> None:
    """Walk with each weight, print the table and draw the CoM's error."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", default="change_a_weight.png", help="the picture to write")
    out = parser.parse_args().out

    robot = pw.load_robot("talos")
    planner = pw.FootstepPlanner(step_length=0.25, step_width=robot.step_width, step_time=0.8)
    plan = planner.generate_footsteps(5, ramp=2)
    default = pw.TrackingGains()

    figure = Figure(figsize=(11, 5), layout="constrained")
    left, right = figure.subplots(1, 2, width_ratios=[2, 1])
    errors = []
    print("posture weight   CoM error rms x, y, z (mm)   outcome")
    for factor in FACTORS:
        weight = factor * default.posture_weight
        record = pw.simulate(robot, plan, gains=replace(default, posture_weight=weight))
        summary = record.summary()
        errors.append([1e3 * (error or 0.0) for error in summary.com_error_rms])
        x, y, z = errors[-1]
        outcome = "fell" if summary.fell else "walked"
        print(f"{weight:14.4f}   {x:8.2f} {y:8.2f} {z:8.2f}   {outcome}")
        off = 1e3 * (record.com - record.com_ref)[:, 0]
        left.plot(record.time, off, linewidth=0.9, label=f"{weight:g}")
    left.set(xlabel="time [s]", ylabel="CoM error in x [mm]")
    left.legend(title="posture weight")
    for k, axis in enumerate("xyz"):
        values = [error[k] for error in errors]
        right.loglog([f * default.posture_weight for f in FACTORS], values, "o-", label=axis)
    right.set(xlabel="posture weight", ylabel="CoM error rms [mm]")
    right.legend()
    figure.savefig(out, dpi=120)
    print(f"wrote {out}")


if __name__ == "__main__":
    main()
