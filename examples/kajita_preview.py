"""Redraw the figures of Kajita et al., ICRA 2003, the paper of the preview-controlled walk.

"Biped walking pattern generation by using preview control of zero-moment point": gains against
preview time, CoM and ZMP with a long and a short preview, and the ZMP error against the horizon.

    python examples/kajita_preview.py --out kajita_preview.png
"""

import argparse

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

from preview_walk import Array, PreviewController, cart_table, preview_effect, preview_gains

Z_C, DT = 0.814, 0.005
STAND = 2.2  # longer than every horizon, so that no step comes as a surprise


def walk() -> tuple[Array, Array]:
    """Return t (N,) and the ZMP reference (N, 2): steps of 0.15 m in 0.5 s, ZMP ramps of 0.1 s."""
    t = np.linspace(0.0, 1800 * DT, 1801)
    times, points = [0.0], [(0.0, 0.0)]
    for i in range(11):
        lift, last = STAND + 0.5 * i, i == 10
        times += [lift, lift + 0.1]
        points += [points[-1], (0.15 * (i + 1), 0.0 if last else 0.05 * (-1) ** i)]
    columns = np.array(points)
    zmp: Array = np.stack([np.interp(t, times, columns[:, axis]) for axis in (0, 1)], axis=1)
    return t, zmp


def main() -> None:
    """Draw three figures into one picture and print the table of errors."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", default="kajita_preview.png", help="the PNG to write")
    out = parser.parse_args().out

    t, reference = walk()
    design = preview_gains(cart_table(Z_C, DT), Q_e=1.0, Q_x=0.0, R=1e-6, N=400)
    figure, axes = plt.subplots(2, 2, figsize=(12, 8), layout="constrained")

    gains = axes[0, 0]
    gains.plot(np.arange(1, 401) * DT, -design.preview_gain[:, 0, 0])
    gains.axvline(1.6, color="grey", linestyle=":", label="320 samples")
    gains.set(
        xlabel="preview time (s)",
        ylabel="preview gain, sign reversed (m/s³ per m)",
        title="Preview gains",
    )
    gains.legend()

    for axis, name in enumerate(("x", "y")):
        motion = axes[1, axis]
        motion.plot(t, reference[:, axis], color="black", linewidth=1, label="ZMP reference")
        for seconds, colour in ((1.6, "tab:blue"), (0.8, "tab:red")):
            run = PreviewController(Z_C, DT, seconds).trajectory(reference)
            motion.plot(t, run.zmp[:, axis], colour, linewidth=1, label=f"ZMP, preview {seconds} s")
            motion.plot(t, run.com[:, axis], colour, linestyle="--", label=f"CoM, {seconds} s")
        motion.set(xlabel="time (s)", ylabel=f"{name} (m)", title=f"CoM and ZMP, {name}")

    axes[1, 0].legend(fontsize="small")

    horizons = np.arange(60, 401, 10)
    steady = preview_effect(design, reference[:, 0], horizons)[:, 0]
    error = axes[0, 1]
    error.semilogy(horizons * DT, 1e3 * steady)
    shortest = 2.0 * np.sqrt(Z_C / 9.81)
    error.axvline(shortest, color="grey", linestyle=":", label="two time constants")
    error.set(xlabel="preview horizon (s)", ylabel="mm", title="Largest ZMP error, x")
    error.grid(which="both", alpha=0.3)
    error.legend()

    print("preview samples   largest ZMP error (mm)")
    for horizon in (160, 240, 320, 400):
        print(f"{horizon:15d}   {1e3 * steady[horizons == horizon].item():.1f}")
    figure.savefig(out, dpi=120)
    print(f"wrote {out}")


if __name__ == "__main__":
    main()
