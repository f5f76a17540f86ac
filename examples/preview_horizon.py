"""What preview time buys a walker: the ZMP error of a cart-table against the horizon.

python examples/preview_horizon.py --out preview_horizon.png
"""

import argparse
import warnings

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

import preview_walk as pw

Z_C, DT, LONGEST = 0.814, 0.005, 400
SHOWN = ((60, "#E69F00"), (160, "#009E73"), (320, "#0072B2"))


def main() -> None:
    """Walk four steps with several horizons, draw them and the error against the horizon."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", default="preview_horizon.png", help="the PNG to write")
    out = parser.parse_args().out
    warnings.simplefilter("ignore", pw.ShortHorizonWarning)  # short ones are the point here

    t = np.arange(1200) * DT
    corners = [2.5, 2.6, 3.1, 3.2, 3.7, 3.8, 4.3, 4.4]
    zmp = np.interp(t, corners, [0.0, 0.1, 0.1, -0.1, -0.1, 0.1, 0.1, 0.0])
    design = pw.preview_gains(pw.cart_table(Z_C, DT), Q_e=1.0, Q_x=0.0, R=1e-6, N=LONGEST)

    figure, (motion, error) = plt.subplots(2, 1, figsize=(9, 7), layout="constrained")
    motion.plot(t, zmp, color="0.2", linestyle="--", label="ZMP reference")
    for samples, colour in SHOWN:
        short = pw.preview_gains(pw.cart_table(Z_C, DT), 1.0, 0.0, 1e-6, samples)
        motion.plot(
            t, pw.track(short, zmp).y, colour, label=f"ZMP, {samples * DT:.1f} s of preview"
        )
    motion.set(xlabel="time [s]", ylabel="ZMP [m]", xlim=(1.8, 5.5), ylim=(-0.32, 0.32))
    motion.legend(ncols=2, frameon=False, loc="upper right")

    horizons = np.arange(0, LONGEST + 1, 5)
    largest = pw.preview_effect(design, zmp, horizons)[:, 0]
    error.semilogy(horizons * DT, 1e3 * largest, color="#0072B2")
    constant = -DT / np.log(design.slow_mode)
    for count in range(1, 6):
        error.axvline(count * constant, color="0.7", linestyle=":")
    error.set(
        xlabel=f"preview horizon [s]; dotted: time constants of the slow mode, {constant:.3f} s",
        ylabel="largest ZMP error [mm]",
    )
    error.grid(which="both", color="0.92")

    print("preview (s)   largest ZMP error (mm)")
    for samples in (0, 60, 160, 240, 320, 400):
        print(f"{samples * DT:11.1f}   {1e3 * largest[horizons == samples].item():.1f}")
    figure.savefig(out, dpi=120)
    print(f"wrote {out}")


if __name__ == "__main__":
    main()
