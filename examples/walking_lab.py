"""The walking lab: from footsteps to a humanoid that walks in MuJoCo, with its plots and rubric.

python examples/walking_lab.py --out walking_lab.png
"""

import argparse
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import mujoco
import numpy as np

from preview_walk import (
    FootstepPlanner,
    PreviewController,
    SwingLegTrajectory,
    WalkingController,
    ZMPTrajectoryGenerator,
)

XML = Path(__file__).parent.parent / "models" / "humanoid-walker.xml"
COLOURS = {"left": "tab:blue", "right": "tab:orange"}
PHASES = ("double", "left_support", "right_support")

parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument("--out", default="walking_lab.png", help="the picture to write")
out = parser.parse_args().out

# --- The lab's script -----------------------------------------------------------------------------
# Where and when the feet land.
planner = FootstepPlanner(0.15, 0.1, 0.6)
footsteps = planner.generate_footsteps(n_steps=6)
# The ZMP that the footsteps ask for.
t, zmp_ref = ZMPTrajectoryGenerator(planner).generate_zmp_trajectory(footsteps, dt=0.01)
# The CoM that makes this ZMP.
preview = PreviewController(z_c=0.8, dt=0.01)
com_x, vel_x = preview.generate_com_trajectory(zmp_ref[:, 0])
com_y, vel_y = preview.generate_com_trajectory(zmp_ref[:, 1])
# A swing of a foot.
swing = SwingLegTrajectory(0.08)
swing_t, swing_pos, swing_vel = swing.generate_trajectory((0, 0, 0), (0.3, 0, 0), 0.48, 0.01)
# All of it on the robot.
model = mujoco.MjModel.from_xml_path(str(XML))
data = mujoco.MjData(model)
controller = WalkingController(model, data)
history = controller.run_walking(n_steps=6)

# --- Its plots ------------------------------------------------------------------------------------
time, com, zmp, planned_zmp = (history[name] for name in ("time", "com", "zmp", "zmp_ref"))
sole = controller.robot.soles["left"]
x, y = sole.half_length, sole.half_width
steps = controller.plan.steps
figure = plt.figure(figsize=(14, 13), layout="constrained")
top, rest = figure.subfigures(2, 1, height_ratios=(1, 3))

seen = top.subplots()
for step in controller.plan:
    corners = step.pos[:2] + np.array([(-x, -y), (x, -y), (x, y), (-x, y), (-x, -y)])
    seen.plot(*corners.T, color=COLOURS[step.foot], linewidth=1)
seen.plot(*planned_zmp.T, "k--", linewidth=1, label="ZMP planned")
seen.plot(*zmp.T, color="tab:red", linewidth=1, label="ZMP measured")
seen.plot(com[:, 0], com[:, 1], color="tab:green", linewidth=2, label="CoM measured")
seen.set(title="Trajectories from above", xlabel="x (m)", ylabel="y (m)", aspect="equal")
seen.legend(loc="center left", bbox_to_anchor=(1.01, 0.5))

(zmp_x, zmp_y), (arcs, arc), (phases, height) = rest.subplots(3, 2)
# The robot starts where it stands in its model, the lab's plan at the origin.
for axes, k, lab_com in ((zmp_x, 0, com_x), (zmp_y, 1, com_y)):
    axes.plot(time, zmp[:, k], color="tab:red", linewidth=1, label="ZMP measured")
    axes.plot(time, planned_zmp[:, k], "k--", linewidth=1, label="ZMP planned")
    axes.plot(time, com[:, k], color="tab:green", label="CoM measured")
    axes.plot(t, planned_zmp[0, k] + lab_com, "k:", label="CoM of PreviewController")
    axes.set(title=f"ZMP tracking, {'xy'[k]}", xlabel="time (s)", ylabel=f"{'xy'[k]} (m)")
for foot, colour in COLOURS.items():
    arcs.plot(*history[f"{foot}_foot"][:, [0, 2], 3].T, color=colour, label=f"{foot} measured")
    arcs.plot(*history[f"{foot}_foot_ref"][:, [0, 2], 3].T, "k--", linewidth=0.8)
arcs.axhline(0.02, color="grey", linestyle=":", label="clearance")
arcs.set(title="Soles from the side (planned: dashed)", xlabel="x (m)", ylabel="z (m)")
arc.plot(swing_pos[:, 0], swing_pos[:, 2], color="tab:purple", label="SwingLegTrajectory(0.08)")
arc.set(title="One swing", xlabel="x (m)", ylabel="z (m)")

left, right = (history[f"{foot}_force"][:, 2] > 20.0 for foot in COLOURS)
felt = np.select([left & right, left, right], [0.0, 1.0, 2.0], np.nan)
asked = [PHASES.index(planner.get_support_phase(s, footsteps)[0]) for s in time]
phases.step(time, felt, color="tab:red", where="post", label="felt by the soles")
phases.step(time, asked, "k--", where="post", linewidth=1, label="planned")
phases.set(title="Phase timing", xlabel="time (s)", yticks=range(3), yticklabels=PHASES)
height.plot(time, 1e3 * (com - history["com_ref"]), label=("x", "y", "z"))
height.set(title="CoM, measured minus reference", xlabel="time (s)", ylabel="mm")
for axes in rest.axes:
    axes.grid(alpha=0.3)
    axes.legend(fontsize=8)
figure.savefig(out, dpi=120)

# --- Its rubric, in numbers -----------------------------------------------------------------------
soles = [history[f"{step.foot}_foot"][:, :3, 3] for step in steps]
landing = [np.searchsorted(time, step.land) for step in steps]
middle = [np.searchsorted(time, 0.5 * (step.lift + step.land)) for step in steps]
missed = [np.linalg.norm(s[i + 10] - p.pos) for s, i, p in zip(soles, landing, steps, strict=True)]
touchdown = [(s[i - 1, 2] - s[i, 2]) / 0.01 for s, i in zip(soles, landing, strict=True)]
clearance = [s[i, 2] for s, i in zip(soles, middle, strict=True)]
zmp_error = 1e3 * np.sqrt(np.nanmean((zmp - planned_zmp) ** 2, axis=0))
com_error = 1e3 * np.abs(com - history["com_ref"]).max(axis=0)
pace = np.abs(np.diff(planned_zmp, axis=0)).max() / 0.01
alone = 0.01 * np.sum(felt > 0) / len(steps)
print(f"""\
alternating steps: {", ".join(step.foot for step in steps)};
    each sole came to stand within {1e3 * max(missed):.1f} mm of its footstep, and the other foot
    stood alone for {alone:.2f} s a step (planned: {planner.single_support_time:.2f} s)
smooth ZMP: the planned one never jumps (at most {pace:.1f} m/s); the one measured in MuJoCo keeps
    within {zmp_error[0]:.1f} mm (x) and {zmp_error[1]:.1f} mm (y) rms of it
stable CoM: at most {com_error[0]:.1f}, {com_error[1]:.1f}, {com_error[2]:.1f} mm (x, y, z) from \
its reference; it sways by {100 * np.ptp(com[:, 1]):.1f} cm,
    and its height stays within {1e3 * np.ptp(com[:, 2]):.1f} mm
smooth arcs with clearance: midway the soles are {100 * min(clearance):.1f} cm above the ground;
    they touch down at {100 * max(touchdown):.1f} cm/s at most
complete sequence: stood, made {len(steps)} steps and {com[-1, 0] - com[0, 0]:.2f} m, \
and {"fell" if controller.fall else "stands"} with the feet side by side
wrote {out}""")
