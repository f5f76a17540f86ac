"""Five laws over the same footsteps: LQR, LQI, preview, MPC and Wieber's, on two cart-tables.

The ZMP is to follow its reference from foot to foot and to stay within the support polygons; only
MPC and Wieber's walk know them. No robot and no simulator.

python examples/walking_laws.py --out walking_laws.png
"""

import argparse

import control
import numpy as np

import preview_walk as pw

Z_C, DT = 0.814, 0.02  # m, s


def supports(plan: pw.FootstepPlan, sole: pw.Sole, times: np.ndarray) -> list[np.ndarray]:
    """Return the support polygon (V, 2) in m at each time: the hull of the soles that stand."""
    polygons = []
    for t in times:
        swing = plan.swing_at(float(t))
        standing = [foot for foot in ("left", "right") if swing is None or foot != swing.foot]
        polygons.append(pw.support_polygon([plan.sole(foot, t) for foot in standing], sole))
    return polygons


def main() -> None:
    """Walk six steps by five laws, print the table and draw them."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", default="walking_laws.png", help="the picture to write")
    out = parser.parse_args().out

    sole = pw.Sole(half_length=0.085, half_width=0.045)  # m, 2 cm within those of TALOS
    stride = {"step_length": 0.3, "step_width": 0.2, "step_time": 0.6}
    plan = pw.FootstepPlanner(**stride, double_support_ratio=0.05).generate_footsteps(6)
    times = np.arange(plan.start, plan.end + 1.0, DT)
    table = pw.cart_table(Z_C, DT)
    axes = control.append(table, table)
    axes.update_names(inputs=["jerk x [m/s³]", "jerk y [m/s³]"], outputs=["ZMP x [m]", "ZMP y [m]"])
    design = pw.preview_gains(axes, Q_e=1.0, Q_x=0.0, R=1e-6, N=80)
    reference = pw.zmp_reference(plan, sole, margin=0.0).at(times)
    x0 = np.zeros(6)
    x0[[0, 3]] = reference[0]
    limits = pw.Limits(polygons=supports(plan, sole, times))
    comparison = pw.compare(design, reference, x0=x0, limits=limits)
    print(comparison)
    pw.plot_comparison(comparison, out)
    print(f"wrote {out}")


if __name__ == "__main__":
    main()
