"""A crane that knows its course: the load follows, the swing stays within a limit.

One input (the trolley's acceleration), two outputs (the load's place, the rope's angle): more
outputs than inputs, weighted. Only MPC keeps the angle's limit.

python examples/crane.py --out crane.png
"""

import argparse

import control
import numpy as np

import preview_walk as pw

ROPE, GRAVITY, DAMPING, DT = 8.0, 9.81, 0.05, 0.05  # m, m/s², 1/s, s


def crane() -> control.StateSpace:
    """Return the crane for small angles in continuous time.

    States: trolley's place and speed, rope's angle theta and rate,
    theta'' = -(g theta + u) / l - d theta'.
    """
    a = np.zeros((4, 4))
    a[0, 1] = a[2, 3] = 1.0
    a[3, 2:] = -GRAVITY / ROPE, -DAMPING
    b = np.array([[0.0], [1.0], [0.0], [-1.0 / ROPE]])
    c = np.array([[1.0, 0.0, ROPE, 0.0], [0.0, 0.0, 1.0, 0.0]])
    return control.ss(a, b, c, 0, 0, inputs=["trolley [m/s²]"], outputs=["load [m]", "angle [rad]"])


def main() -> None:
    """Move a load 6 m and back by four laws, print the table and draw them."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", default="crane.png", help="the picture to write")
    out = parser.parse_args().out

    design = pw.preview_gains(crane(), Q_e=[1.0, 0.1], Q_x=0.0, R=0.1, N=160, dt=DT)
    t = np.arange(800) * DT
    u = np.clip(np.array([t - 10.0, t - 25.0]) / 4.0, 0.0, 1.0)
    load = 6.0 * np.array([1.0, -1.0]) @ (3.0 * u**2 - 2.0 * u**3)
    course = np.column_stack([load, np.zeros_like(load)])
    angle = 0.12
    limits = pw.Limits(y_min=[-np.inf, -angle], y_max=[np.inf, angle])
    comparison = pw.compare(design, course, limits=limits)
    print(comparison)
    pw.plot_comparison(comparison, out)

    print("preview (s)   largest error of the load (m)")
    horizons = [0, 20, 40, 60, 80, 120, 160]
    for n, error in zip(horizons, pw.preview_effect(design, course, horizons), strict=True):
        print(f"{n * DT:11.1f}   {error[0]:.3f}")
    print(f"wrote {out}")


if __name__ == "__main__":
    main()
