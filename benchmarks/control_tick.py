"""What a control tick costs, part by part, and what the same tick costs with other solvers.

The ticks of a TALOS walk are recorded, then replayed: terms of the dynamics, assembly of the QP,
its solution, torques. A step of physics goes before each tick, as in a walk, so that no solver
finds its data in the processor's cache. Times are this thread's processor time, which other
programs on the machine hardly move; the process pins itself to one core. What the machine still
adds shows in a tick that is repeated without change.

    python benchmarks/control_tick.py [--steps 6]
"""

from __future__ import annotations

import argparse
import os
from dataclasses import dataclass
from time import thread_time

import mujoco
import numpy as np
import qpsolvers
from tick_solvers import DirectDaqp, Prepare, Solve, by_qpsolvers, exact, fresh_osqp

from preview_walk import (
    Array,
    Foot,
    FootstepPlanner,
    PreviewWalkError,
    Robot,
    TickProblem,
    TrackingGains,
    Walk,
    WholeBodyController,
    load_robot,
    to_mujoco,
)

FRICTION = 0.8
STEP = 0.3
"""Step length over leg length."""
ROBOTS = ("alexander", "icub", "talos", "g1_hands")


@dataclass
class Tick:
    """The measured state and the references of one tick."""

    q: Array
    v: Array
    limit: dict[Foot, float]
    com: Array
    feet: dict[Foot, tuple[Array, Array, Array]]
    torso: tuple[Array, Array]

    def show(self, body: WholeBodyController) -> None:
        """Set the references of a controller."""
        body.com.acceleration = self.com
        for foot, task in body.foot_tasks.items():
            task.pose, task.velocity, task.acceleration = self.feet[foot]
        body.torso.rotation, body.torso.velocity = self.torso


def tick_of(walk: Walk) -> Tick:
    """Return the tick that a walk has just done."""
    walker, body = walk.walker, walk.walker.body
    return Tick(
        body.dynamics.q.copy(),
        body.dynamics.v.copy(),
        walker.feet.normal_limits(walk.time, walk.plan),
        body.com.acceleration.copy(),
        {
            foot: (task.pose.copy(), task.velocity.copy(), task.acceleration.copy())
            for foot, task in body.foot_tasks.items()
        },
        (body.torso.rotation.copy(), body.torso.velocity.copy()),
    )


def record(robot: Robot, steps: int) -> list[Tick]:
    """Walk and return every tick."""
    length = STEP * robot.leg_length
    plan = FootstepPlanner(length, robot.step_width, 0.9).generate_footsteps(steps)
    ticks: list[Tick] = []
    walk = Walk(robot, plan, friction=FRICTION, on_tick=lambda walk: ticks.append(tick_of(walk)))
    walk.run()
    if walk.fallen:
        raise SystemExit(f"{robot.name} fell: nothing to measure")
    return ticks


class Replay:
    """Replays recorded ticks, each after a step of physics."""

    def __init__(self, robot: Robot, ticks: list[Tick], solver: str = "osqp") -> None:
        self.robot, self.ticks = robot, ticks
        self.body = WholeBodyController(robot, TrackingGains(), FRICTION, solver)
        self._physics = mujoco.MjData(robot.mj)

    def _step(self, tick: Tick) -> None:
        to_mujoco(tick.q, tick.v, self._physics.qpos, self._physics.qvel)
        mujoco.mj_step(self.robot.mj, self._physics)
        tick.show(self.body)

    def ours(self, ticks: list[Tick] | None = None) -> tuple[Array, Array, Array]:
        """Return the times (N,) of whole ticks, of their three parts (N, 3), and torques (N, n)."""
        body, times, parts, torques = self.body, [], [], []
        for tick in self.ticks if ticks is None else ticks:
            self._step(tick)
            start = thread_time()
            body.update(tick.q, tick.v)
            torque = body.torques(tick.limit)
            times.append(thread_time() - start)
            parts.append((body.times.terms, body.times.assembly, body.times.solve))
            torques.append(torque)
        return np.array(times), np.array(parts), np.array(torques)

    def other(self, prepare: Prepare, every: int) -> tuple[Array, Array]:
        """Return times and torques of every so many ticks, with another solver.

        `prepare` takes the tick's problem and returns the solve that is timed.
        """
        body, times, torques = self.body, [], []
        effort = self.robot.effort
        for tick in self.ticks[::every]:
            tick.show(body)
            body.update(tick.q, tick.v)
            solve = prepare(body.problem(tick.limit))
            self._step(tick)
            start = thread_time()
            body.update(tick.q, tick.v)
            problem = body.problem(tick.limit)
            acceleration, wrench = solve()
            torque = np.clip(problem.forces(acceleration, wrench)[6:], -effort, effort)
            times.append(thread_time() - start)
            torques.append(torque)
        return np.array(times), np.array(torques)


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--steps", type=int, default=6, help="footsteps of the TALOS walk")
    options = parser.parse_args()
    os.sched_setaffinity(0, {max(os.sched_getaffinity(0))})

    talos = load_robot("talos")
    race(record(talos, options.steps), talos)
    print("\ncost against the number of joints (median of a walk of 2 steps, us)\n")
    for name in ROBOTS:
        try:
            robot = load_robot(name)
            spent = Replay(robot, record(robot, 2)).ours()[0]
        except (PreviewWalkError, SystemExit) as why:
            print(f"{name:12} not measured: {why}")
            continue
        print(f"{name:12}{robot.pin.nv - 6:4} joints {1e6 * np.median(spent):8.0f}")


def race(ticks: list[Tick], talos: Robot) -> None:
    """Print what TALOS's ticks cost, part by part and with each solver."""
    replay = Replay(talos, ticks)
    times, parts, torques = replay.ours()
    times, parts, torques = replay.ours()  # again: workspaces exist, as in steady walking
    median = np.median(times)
    reference = replay.other(exact, 1)[1]
    print(f"TALOS, {talos.pin.nv - 6} joints, {len(ticks)} ticks of a walk; times in us\n")
    print(f"{'':34}{'median':>8}{'p99':>8}{'ratio':>8}{'torque error N·m':>18}")

    def row(name: str, spent: Array, found: Array, every: int) -> None:
        error = np.abs(found - reference[::every]).max(axis=1)
        failed = np.count_nonzero(~np.isfinite(error))
        note = f"{np.nanmax(error):18.2g}" + (f"  ({failed} unsolved)" if failed else "")
        print(
            f"{name:34}{1e6 * np.median(spent):8.0f}{1e6 * np.percentile(spent, 99):8.0f}"
            f"{np.median(spent) / median:8.2f}{note}"
        )

    row("this tick", times, torques, 1)
    for name, part in zip(("terms", "assembly", "solution and torques"), parts.T, strict=True):
        print(f"  {name:32}{1e6 * np.median(part):8.0f}{1e6 * np.percentile(part, 99):8.0f}")
    direct: dict[TickProblem, DirectDaqp] = {}

    def by_daqp(problem: TickProblem) -> Solve:
        if problem not in direct:
            direct[problem] = DirectDaqp(problem)
        return direct[problem].solve

    row("daqp called directly", *replay.other(by_daqp, 1), 1)
    row("OSQP set up afresh", *replay.other(fresh_osqp, 4), 4)
    for name in qpsolvers.available_solvers:
        row(f"qpsolvers: {name}", *replay.other(by_qpsolvers(name), 20), 20)

    steady = slice(len(times) // 4, -len(times) // 4)
    alike = replay.ours([ticks[len(ticks) // 2]] * (len(times) // 2))[0]
    for name, spent in (("steady walking", times[steady]), ("one tick repeated", alike)):
        print(f"p99 / median, {name}: {np.percentile(spent, 99) / np.median(spent):.2f}")


if __name__ == "__main__":
    main()
