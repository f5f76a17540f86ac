"""A robot as it is: one walk with the truth, what its sensors read, and what it believed.

python examples/real_robot.py --realism lab --seed 1 --out real_robot.png
"""

import argparse

import numpy as np
from matplotlib.figure import Figure

import preview_walk as pw

TRUE, READ, BELIEVED = "#000000", "#BBBBBB", "#D55E00"
COMMANDS = [((0.5, 0.0, 0.2), 4.0)]  # m/s forward, m/s left, rad/s left; s


def main() -> None:
    """Walk, print the figures, and draw truth, readings and estimates."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--realism", default="lab", help="lab or field (default lab)")
    parser.add_argument("--seed", type=int, default=1, help="of all errors (default 1)")
    parser.add_argument("--out", default="real_robot.png", help="the picture to write")
    given = parser.parse_args()

    robot = pw.load_robot("talos")
    realism = pw.read_realism(given.realism)
    record = pw.simulate_commands(robot, COMMANDS, realism=realism, seed=given.seed)
    print(record.summary())
    sensed = record.sensed
    if sensed is None:
        raise SystemExit("--realism: must be lab or field, got none: nothing is sensed.")

    t = record.time
    knee = robot.joint_names.index("leg_left_4_joint")
    figure = Figure(figsize=(11, 11), layout="constrained")
    speed, joint, load, error, bias = figure.subplots(5, 1, sharex=True)
    speed.plot(t, record.v[:, 1], TRUE, label="true")
    speed.plot(t, sensed.estimate_v[:, 1], BELIEVED, linewidth=1, label="estimated")
    speed.set_ylabel("base, sideways [m/s]")
    joint.plot(t, sensed.speeds[:, knee], READ, label="read")
    joint.plot(t, record.v[:, 6 + knee], TRUE, linewidth=1, label="true")
    joint.set_ylabel("left knee [rad/s]")
    load.plot(t, sensed.left_sole[:, 2], READ, label="read")
    load.plot(t, record.left_force[:, 2], TRUE, linewidth=1, label="true")
    load.set_ylabel("left sole [N]")
    com = 1e3 * sensed.com_error(record.q, record.com_ref)
    for axis, colour in enumerate(("#0072B2", "#D55E00", "#009E73")):
        error.plot(t, com[:, axis], colour, label="xyz"[axis])
        bias.plot(t, 1e3 * sensed.gyro_bias[:, axis], colour, label="xyz"[axis])
    error.set_ylabel("true CoM off\nits reference [mm]")
    bias.set(ylabel="gyro's bias as\nestimated [mrad/s]", xlabel="time [s]")
    for axes in (speed, joint, load, error, bias):
        axes.legend(ncols=3, loc="lower right", frameon=False)
    figure.savefig(given.out, dpi=110)
    drift = sensed.drift(record.q)[-1]
    print(f"wandered off by {1e3 * np.hypot(*drift[:2]):.0f} mm and {np.degrees(drift[2]):.2f} deg")
    print(f"wrote {given.out}")


if __name__ == "__main__":
    main()
