"""TALOS speeds up, walks backwards, stops and goes on, by commands at any moment.

python examples/stop_and_go.py --out stop_and_go.png
"""

import argparse

import numpy as np
from matplotlib.figure import Figure

import preview_walk as pw

# Forward speeds (m/s), and for how long (s) each is commanded; chosen without a look at the steps.
SPEEDS = [(0.0, 0.9), (0.5, 5.4), (0.0, 3.4), (-0.2, 4.5), (0.5, 3.85), (0.8, 5.25), (0.0, 5.0)]


def main() -> None:
    """Obey the commands, print where the robot ended and draw its speed."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", default="stop_and_go.png", help="the picture to write")
    out = parser.parse_args().out

    robot = pw.load_robot("talos")
    record = pw.simulate_commands(robot, [((v, 0.0, 0.0), seconds) for v, seconds in SPEEDS])

    print(record.summary())
    print(f"the plan changed {len(record.plans) - 1} times under way")

    figure = Figure(figsize=(11, 7), layout="constrained")
    above, below = figure.subplots(2, 1, sharex=True)
    t, x = record.time, record.com[:, 0]
    edges = np.cumsum([0.0, *(seconds for _, seconds in SPEEDS)])
    above.stairs([v for v, _ in SPEEDS], edges, color="k", linestyle="--", label="commanded")
    above.plot(t, record.com_velocity[:, 0], color="tab:blue", linewidth=0.8, label="CoM")
    above.set(ylabel="forward speed [m/s]")
    above.legend(loc="upper left")
    below.plot(t, x, color="tab:blue", label="CoM")
    for name, foot in (("left foot", record.left_foot), ("right foot", record.right_foot)):
        below.plot(t, foot[:, 0, 3], linewidth=0.9, label=name)
    below.set(xlabel="time [s]", ylabel="x [m]")
    below.legend(loc="upper left")
    figure.savefig(out, dpi=120)
    print(f"wrote {out}")


if __name__ == "__main__":
    main()
