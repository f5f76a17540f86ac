"""An active suspension that sees the road ahead: a quarter car over a bump.

The road's slope is a previewed disturbance; body acceleration, suspension travel and tyre
deflection are three outputs of one force, weighted, and the first has a direct feedthrough.

python examples/active_suspension.py --out active_suspension.png
"""

import argparse
import warnings

import matplotlib

matplotlib.use("Agg")
import control
import matplotlib.pyplot as plt
import numpy as np

import preview_walk as pw

BODY, WHEEL, SPRING, DAMPER, TYRE = 300.0, 40.0, 18e3, 1e3, 190e3  # kg, kg, N/m, N s/m, N/m
SPEED, DT = 20.0, 0.002  # m/s, s
NAMES = ("body acceleration [m/s²]", "suspension travel [mm]", "tyre deflection [mm]")


def quarter_car() -> tuple[control.StateSpace, np.ndarray]:
    """Return the car in continuous time and the matrix of the road's vertical speed.

    States: suspension travel, body velocity, tyre deflection, wheel velocity.
    """
    a = np.zeros((4, 4))
    a[0, [1, 3]], a[2, 3] = (1.0, -1.0), 1.0
    a[1] = np.array([-SPRING, -DAMPER, 0.0, DAMPER]) / BODY
    a[3] = np.array([SPRING, DAMPER, -TYRE, -DAMPER]) / WHEEL
    b = np.array([[0.0], [1.0 / BODY], [0.0], [-1.0 / WHEEL]])
    c, d = np.vstack([a[1], np.eye(4)[[0, 2]]]), np.array([[1.0 / BODY], [0.0], [0.0]])
    return control.ss(a, b, c, d, 0), np.array([0.0, 0.0, -1.0, 0.0])


def main() -> None:
    """Drive over the bump with and without preview, print and draw what the passenger feels."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", default="active_suspension.png", help="the PNG to write")
    out = parser.parse_args().out
    warnings.simplefilter("ignore", pw.ShortHorizonWarning)

    t = np.arange(1000) * DT
    place = SPEED * (t - 0.6)
    road = np.where((place > 0) & (place < 4), 0.025 * (1 - np.cos(np.pi * place / 2)), 0.0)
    slope = np.gradient(road, DT)
    car, e = quarter_car()
    weights = ([1.0, 1e3, 1e4], 0.0, 1e-7)
    passive = pw.preview_gains(car, *weights[:2], 1e9, 0, E=e, dt=DT, integral=False)
    still = np.zeros((len(t), 3))
    runs = {"passive": pw.track(passive, still, disturbance=slope).y}
    seconds = np.array([0.0, 0.01, 0.02, 0.04, 0.06, 0.08, 0.1, 0.15, 0.2, 0.3, 0.4])
    for ahead in seconds:
        n = round(ahead / DT)
        design = pw.preview_gains(car, *weights, n, E=e, dt=DT, integral=False)
        runs[f"preview {ahead} s"] = pw.track(design, still, disturbance=slope).y
    rms = {label: np.sqrt(np.mean(y**2, axis=0)) for label, y in runs.items()}

    figure, axes = plt.subplots(2, 2, figsize=(11, 7), layout="constrained")
    colours = {"passive": "0.5", "preview 0.0 s": "#E69F00", "preview 0.1 s": "#009E73",
               "preview 0.4 s": "#0072B2"}  # fmt: skip
    print(f"{'rms':16}{'  '.join(NAMES)}")
    for label, colour in colours.items():
        for axis, column, name in zip(axes.flat, runs[label].T, NAMES, strict=False):
            axis.plot(t, column * (1e3 if "mm" in name else 1.0), colour, label=label)
            axis.set(xlabel="time [s]", ylabel=name, xlim=(0.3, 1.6))
        values = rms[label] * (1.0, 1e3, 1e3)
        print(f"{label:16}{values[0]:12.3f}{values[1]:22.2f}{values[2]:22.2f}")
    axes[0, 0].legend(frameon=False)
    share = np.array([rms[f"preview {ahead} s"] for ahead in seconds]) / rms["passive"]
    for column, name, colour in zip(share.T, NAMES, ("#D55E00", "#56B4E9", "#CC79A7"), strict=True):
        axes[1, 1].plot(seconds, column, colour, marker=".", label=name.split(" [")[0])
    axes[1, 1].axhline(1.0, color="0.7", linestyle=":")
    axes[1, 1].set(xlabel="preview of the road [s]", ylabel="rms, share of the passive car's")
    axes[1, 1].legend(frameon=False)
    figure.savefig(out, dpi=120)
    print(f"wrote {out}")


if __name__ == "__main__":
    main()
