"""TALOS walks a slalom around poles: it is steered by velocity commands while it walks.

python examples/slalom.py --out slalom.png
"""

import argparse
from math import atan2, cos, hypot, pi, sin

import numpy as np

import preview_walk as pw
from preview_walk import midfeet, top_view

SPACING, SWING, POLES = 2.0, 0.5, 4  # m between poles, m to their sides, number of poles
SPEED, AHEAD = 0.35, 0.7  # m/s, and the distance (m) at which the steering looks


def main() -> None:
    """Steer along a wave around the poles, print how far they were and draw the way."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", default="slalom.png", help="the picture to write")
    out = parser.parse_args().out

    robot = pw.load_robot("talos")
    walk = pw.Walk.standing(robot, start=(0.0, SWING))
    while not walk.fallen:
        x, y, yaw = midfeet(*(walk.plan.sole(foot, walk.time) for foot in ("left", "right")))
        if x > SPACING * (POLES + 0.5):
            break
        dx, dy = AHEAD, SWING * cos(pi / SPACING * (x + AHEAD)) - y
        # Pure pursuit: the circle through here, along our heading, that meets the wave ahead.
        curvature = 2.0 * sin(atan2(dy, dx) - yaw) / hypot(dx, dy)
        walk.command(SPEED, 0.0, SPEED * curvature)
        walk.run(until=walk.time + 0.25)
    walk.command(0.0, 0.0, 0.0)
    record = walk.run().record()

    print(record.summary())
    # The picture is seen from the start, which lies SWING to the left of the line of poles.
    poles = np.array([(SPACING * (k + 1), -SWING) for k in range(POLES)])
    for k, pole in enumerate(poles):
        near = np.hypot(*(record.com[:, :2] - (0.0, SWING) - pole).T).min()
        print(f"pole {k + 1}: the CoM passed {near:.2f} m from it")
    figure = top_view(record)
    figure.axes[0].plot(*poles.T, "k^", markersize=9)
    figure.savefig(out, dpi=120)
    print(f"wrote {out}")


if __name__ == "__main__":
    main()
