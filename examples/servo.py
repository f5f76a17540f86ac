"""A motor that knows where it will be sent: LQR, LQI, preview and MPC on the same servo.

python examples/servo.py --out servo.png
"""

import argparse

import control
import numpy as np

import preview_walk as pw

DT = 0.01


def main() -> None:
    """Compare four laws within a voltage limit, print the table and draw them."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", default="servo.png", help="the picture to write")
    out = parser.parse_args().out

    motor = control.tf([20.0], [1.0, 8.0, 0.0], inputs=["voltage [V]"], outputs=["angle [rad]"])
    design = pw.preview_gains(motor, Q_e=1.0, Q_x=0.0, R=1e-3, N=60, dt=DT)
    t = np.arange(500) * DT
    angle = np.interp(t, [0.8, 1.4, 2.0, 2.2, 3.2, 3.8], [0.0, 1.5, 1.5, 0.5, 0.5, 0.0])
    comparison = pw.compare(design, angle, limits=pw.Limits(u_min=-2.0, u_max=2.0))
    print(comparison)
    pw.plot_comparison(comparison, out)

    print("preview (s)   largest error (rad), without the limit")
    horizons = [0, 5, 10, 20, 40, 60]
    for n, error in zip(horizons, pw.preview_effect(design, angle, horizons), strict=True):
        print(f"{n * DT:11.2f}   {error[0]:.4f}")

    # The same online, with the angle alone measured, with noise, and a torque nobody foresaw.
    plant = design.plant
    observer = pw.kalman_gain(design, 1e-3, 1e-5)
    servo = pw.PreviewServo(design, u_min=-2.0, u_max=2.0, observer_gain=observer)
    state, x, rng = servo.start(), np.zeros(2), np.random.default_rng(0)
    held, error = np.pad(angle, (0, design.horizon), "edge"), []
    for k in range(len(t)):
        state = servo.step(state, held[k : k + design.horizon + 1])
        error.append((plant.C @ x).item() - angle[k])
        x = plant.A @ x + plant.B @ (state.u + 0.2)
        state = servo.observed(state, plant.C @ x + 1e-3 * rng.normal(size=1))
    print(
        f"with an observer, noise and load: rms error {np.sqrt(np.mean(np.square(error))):.4f} rad"
    )
    print(f"wrote {out}")


if __name__ == "__main__":
    main()
