"""The same walks by three CoM generators: preview control, Wieber's ZMP MPC, the plan's DCM.

TALOS walks 12 steps of the default gait, by command with a turn, and through a push of 50 N·s
forward.

python examples/com_generators.py --out com_generators.png
"""

import argparse
from time import perf_counter

import numpy as np
from matplotlib.figure import Figure

import preview_walk as pw

COLOURS = {"preview": "#0072B2", "mpc": "#D55E00", "dcm": "#009E73"}
WIDTHS = {"preview": 3.0, "mpc": 1.5, "dcm": 1.2}  # the last lies on the first
COMMAND = [((0.3, 0.0, 0.2), 3.0)]  # m/s forward, m/s left, rad/s left; s
FORCE, DURATION = 250.0, 0.2  # N, s


def rms(error: np.ndarray) -> str:
    """Return the rms of both horizontal axes in mm."""
    x, y = 1e3 * np.sqrt(np.nanmean(error[:, :2] ** 2, axis=0))
    return f"{x:6.2f},{y:6.2f}"


def planning_ticks(robot: pw.Robot, plan: pw.FootstepPlan, name: str) -> np.ndarray:
    """Return the time (ms) of each planning tick of 5 ms along a plan."""
    pattern = pw.Walk(robot, plan, com_generator=name).walker.pattern
    spent = []
    for t in np.arange(plan.start, plan.end, 0.005):
        begin = perf_counter()
        pattern.at(t)
        spent.append(1e3 * (perf_counter() - begin))
    return np.array(spent)


def main() -> None:
    """Walk, print the table and draw how CoM and ZMP go."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", default="com_generators.png", help="the picture to write")
    parser.add_argument("--steps", type=int, default=12, help="of the walk; half of it is pushed")
    given = parser.parse_args()
    out = given.out

    robot = pw.load_robot("talos")
    planner = pw.FootstepPlanner(step_length=0.25, step_width=robot.step_width, step_time=0.9)
    plan, short = (planner.generate_footsteps(n, ramp=2) for n in (given.steps, given.steps // 2))
    push = pw.Push(short.steps[-3].lift + 0.2, DURATION, (FORCE, 0.0, 0.0))
    figure = Figure(figsize=(11, 9), layout="constrained")
    sideways, forward, pushed = figure.subplots(3, 1)
    title = "walk: CoM     ZMP off plan   off generator  tick ms median, p99"
    print(f"mm rms x, y  {title}   command: CoM   push: CoM     fell")
    for name, colour in COLOURS.items():
        walk = pw.simulate(robot, plan, com_generator=name)
        turn = pw.simulate_commands(robot, COMMAND, com_generator=name)
        shoved = pw.simulate(robot, short, pushes=[push], com_generator=name)
        ticks = planning_ticks(robot, plan, name)
        errors = [walk.com - walk.com_ref, walk.zmp - walk.zmp_ref, walk.zmp - walk.zmp_preview]
        cells = "  ".join(rms(error) for error in errors)
        others = "  ".join(rms(record.com - record.com_ref) for record in (turn, shoved))
        tick = f"{np.median(ticks):11.3f},{np.percentile(ticks, 99):6.2f}"
        fell = sum(record.run.fell for record in (walk, turn, shoved))
        print(f"{name:11}{cells}  {tick}   {others}   {fell} of 3")
        for axes, axis in ((sideways, 1), (forward, 0)):
            axes.plot(walk.time, walk.zmp[:, axis], colour, linewidth=0.8, alpha=0.6)
            label = f"{name}: CoM (ZMP thin)"
            axes.plot(walk.time, walk.com[:, axis], colour, linewidth=WIDTHS[name], label=label)
        pushed.plot(shoved.time, shoved.com_velocity[:, 0], colour, linewidth=WIDTHS[name])
    for axes, axis in ((sideways, 1), (forward, 0)):
        axes.plot(walk.time, walk.zmp_ref[:, axis], "k--", linewidth=0.8, label="ZMP of the plan")
        axes.set(xlim=(7.0, 10.6), ylabel=f"{'xy'[axis]} [m]")
    forward.set(ylim=(1.0, 2.4))
    sideways.legend(ncols=4, loc="lower center", bbox_to_anchor=(0.5, 1.0), frameon=False)
    pushed.axvspan(push.t, push.t + DURATION, color="0.85")
    pushed.set(xlabel="time [s]", ylabel="CoM's speed [m/s]", xlim=(0.0, None))
    figure.savefig(out, dpi=120)
    print(f"wrote {out}")


if __name__ == "__main__":
    main()
