"""Standing balance, the lab before walking: stand, sway, squat, lift a foot, with real torques.

No gait here: the whole-body controller is told where the CoM and the right sole shall be, and
which soles stand. Every tick it turns that into joint torques, which MuJoCo applies.

python examples/standing_balance.py --robot humanoid-walker --out standing_balance.png
"""

import argparse

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

import preview_walk as pw
from preview_walk import Array, Quintic, TrackingGains, WholeBodyController, World

TICK, FRICTION, RATE = 0.002, 0.8, 6.0  # s; -; 1/s, at which CoM errors decay

# What to do, how long it takes (s) and where that leads: the CoM's x, y, z in step widths, step
# widths and leg lengths from where it stands; the right sole's height in leg lengths.
MOVES = (
    ("stand", 1.0, (0.0, 0.0, 0.0), 0.0),
    ("sway left", 1.0, (0.0, 0.3, 0.0), 0.0),
    ("sway right", 1.5, (0.0, -0.3, 0.0), 0.0),
    ("sway forward", 1.5, (0.2, 0.0, 0.0), 0.0),
    ("sway back", 1.0, (0.0, 0.0, 0.0), 0.0),
    ("squat", 1.5, (0.0, 0.0, -0.15), 0.0),
    ("rise", 1.5, (0.0, 0.0, 0.0), 0.0),
    ("lean left", 1.5, (0.0, 0.5, 0.0), 0.0),
    ("lift a foot", 1.0, (0.0, 0.5, 0.0), 0.12),
    ("balance", 2.0, (0.0, 0.5, 0.0), 0.12),
    ("put down", 1.0, (0.0, 0.5, 0.0), 0.0),
    ("stand again", 2.0, (0.0, 0.0, 0.0), 0.0),
)
MARKS = np.cumsum([0.0, *(duration for _, duration, *_ in MOVES)])  # s, when each begins


def moved(start: Array, end: Array, share: float, duration: float) -> Array:
    """Return position, velocity and acceleration (3, n) on a way that starts and ends at rest."""
    way, speed, pull = Quintic.between(0.0, duration, (0, 0, 0), (1, 0, 0)).at(share * duration)
    return np.array([start + way * (end - start), speed * (end - start), pull * (end - start)])


def balance(robot: pw.Robot) -> Array:
    """Do the moves in the simulated world; return a row per tick.

    CoM and where it should be (3 + 3), the right sole's height and where it should be, the normal
    force under the left and the right sole, the largest torque over its limit.
    """
    world = World(robot, friction=FRICTION)
    world.place(robot.posture, 0.0)
    body = WholeBodyController(robot, TrackingGains(), FRICTION)
    home = np.array((0.0, 0.0, robot.com_height))
    right = body.foot_tasks["right"]
    ground = body.dynamics.soles["right"].position.copy()
    scale = np.array((robot.step_width, robot.step_width, robot.leg_length, robot.leg_length))

    rows, before = [], np.zeros(4)
    for _, duration, com, lift in MOVES:
        target = scale * (*com, lift)
        for k in range(round(duration / TICK)):
            goal, speed, pull = moved(before, target, k * TICK / duration, duration)
            world.sense()
            body.update(world.q, world.v)
            dynamics = body.dynamics
            error = home + goal[:3] - dynamics.com
            rate = speed[:3] - dynamics.com_velocity
            body.com.acceleration = pull[:3] + 2.0 * RATE * rate + RATE**2 * error
            right.pose = np.eye(4)
            right.pose[:3, 3] = ground + np.array((0.0, 0.0, goal[3]))
            right.velocity[2], right.acceleration[2] = speed[3], pull[3]
            standing = ("left",) if lift or before[3] else ("left", "right")
            torques = body.torques({foot: 2.0 * robot.mass * robot.gravity for foot in standing})
            felt = [world.wrench[foot][2] for foot in ("left", "right")]
            load = np.abs(torques / np.maximum(robot.effort, 1e-9)).max()
            sole = dynamics.soles["right"].position
            rows.append((*dynamics.com, *(home + goal[:3]), sole[2], goal[3], *felt, load))
            world.step(torques, round(1000 * TICK))
        before = target
    return np.array(rows)


def report(table: Array, time: Array) -> None:
    """Print how well each move went."""
    print("move           CoM error, at most (mm)   right sole's load   torque / limit")
    for (name, *_), begin, end in zip(MOVES, MARKS, MARKS[1:], strict=False):
        part = table[(time >= begin) & (time < end)]
        worst = 1e3 * np.abs(part[:, :3] - part[:, 3:6]).max(axis=0)
        share = abs(part[-1, 9]) / part[-1, 8:10].sum()
        errors = "".join(f"{value:7.1f}" for value in worst)
        print(f"{name:14s} {errors}   {100 * share:16.0f} % {part[:, 10].max():16.2f}")


def draw(table: Array, time: Array, robot: pw.Robot, path: str) -> None:
    """Draw CoM, right sole and loads over time."""
    home = (0.0, 0.0, robot.com_height)
    figure, axes = plt.subplots(3, 1, figsize=(11, 9), layout="constrained", sharex=True)
    for k, colour in enumerate(("tab:blue", "tab:orange", "tab:green")):
        axes[0].plot(time, 1e3 * (table[:, k] - home[k]), color=colour, label="xyz"[k])
        axes[0].plot(time, 1e3 * (table[:, 3 + k] - home[k]), "k--", linewidth=0.8)
    axes[1].plot(time, 1e3 * table[:, 6], color="tab:orange", label="measured")
    axes[1].plot(time, 1e3 * table[:, 7], "k--", linewidth=0.8, label="asked")
    axes[2].plot(time, table[:, 8:10], label=("left", "right"))
    axes[0].set(ylabel="CoM from its place (mm)", title=f"{robot.title}: dashed is what was asked")
    axes[1].set(ylabel="right sole's height (mm)")
    axes[2].set(ylabel="normal force (N)", xlabel="time (s)")
    for ax in axes:
        ax.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
        for begin, (name, *_) in zip(MARKS, MOVES, strict=False):
            ax.axvline(begin, color="grey", linewidth=0.5)
            if ax is axes[0]:
                place = (begin + 0.05, 1.0)
                ax.annotate(name, place, xycoords=("data", "axes fraction"), fontsize=8, va="top")
    figure.savefig(path, dpi=120)


def main() -> None:
    """Do the moves, print how well, draw the picture."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--robot", default="humanoid-walker", help="name or path of the robot")
    parser.add_argument("--out", default="standing_balance.png", help="the picture to write")
    options = parser.parse_args()
    robot = pw.load_robot(options.robot)
    table = balance(robot)
    time = TICK * np.arange(len(table))
    report(table, time)
    draw(table, time, robot, options.out)
    print(f"wrote {options.out}")


if __name__ == "__main__":
    main()
