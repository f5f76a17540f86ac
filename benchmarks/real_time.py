"""How much faster than real time a walk runs with a control tick at every millisecond.

The walk is run once with its controller, and once more with the torques it recorded: the same
motion, MuJoCo alone. Both times are this thread's processor time, which other programs on the
machine hardly move.

    python benchmarks/real_time.py [--robot talos] [--steps 20]
"""

from __future__ import annotations

import argparse
from time import thread_time

import numpy as np

from preview_walk import FootstepPlanner, Record, Robot, Walk, World, load_robot

HZ = 1000


def with_controller(robot: Robot, steps: int) -> tuple[Record, float]:
    """Return the record of a walk at 1 kHz and its processor time (s)."""
    planner = FootstepPlanner(0.25 * robot.leg_length / 0.81, robot.step_width, 0.9)
    walk = Walk(robot, planner.generate_footsteps(steps), physics_hz=HZ, control_hz=HZ)
    start = thread_time()
    walk.run()
    return walk.record(), thread_time() - start


def bare(robot: Robot, record: Record) -> float:
    """Return the processor time (s) of the same motion by MuJoCo alone, from recorded torques."""
    world = World(robot, physics_hz=HZ)
    world.place(record.q[0], 0.0)
    start = thread_time()
    for torques in record.tau:
        world.step(torques, 1)
    spent = thread_time() - start
    world.sense()
    assert np.abs(world.q - record.q[-1]).max() < 1e-2, "the replay went another way"
    return spent


def main() -> None:
    """Print the two ratios."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--robot", default="talos")
    parser.add_argument("--steps", type=int, default=20)
    options = parser.parse_args()
    robot = load_robot(options.robot)
    record, controlled = with_controller(robot, options.steps)
    alone = bare(robot, record)
    simulated = len(record) / HZ
    print(f"{options.robot}, {options.steps} steps, physics and control at {HZ} Hz")
    for name, spent in (("with control", controlled), ("MuJoCo alone", alone)):
        ratio = simulated / spent
        print(f"{name:14}{spent:8.2f} s for {simulated:.1f} s: {ratio:6.2f} x real time")


if __name__ == "__main__":
    main()
