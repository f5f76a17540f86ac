"""What a whole control tick costs by solver, in a gentle, a fast and a pushed walk of TALOS.

Each walk is run with each solver in turn, several rounds; a tick's time is the least of its rounds,
for the same tick does the same work in each. Times are those of the record, `tick_time`: other
programs on the machine add to the longest of them, the more rounds the less. The process pins
itself to one core.
A last round compares the torques with those of an exact solver (the whole QP by daqp, tolerances
1e-10) at every tenth tick.

    python benchmarks/solver_walks.py [--rounds 3] [--solvers osqp,daqp]
"""

from __future__ import annotations

import argparse
import gc
import os

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

from dataclasses import dataclass

import numpy as np
from tick_solvers import exact

import preview_walk as pw
from preview_walk import Backend, Solution

EVERY = 10
"""So many ticks lie between two whose torques are compared."""

WALKS = {
    "default": "20 steps of 0.25 m in 0.9 s",
    "1.0 m/s": "by command, 12 s",
    "pushed": "12 steps of 0.25 m in 0.9 s, pushed forward by 100 N·s at 4.1 s",
}


@dataclass
class Compared:
    """A backend whose torques are compared with exact ones.

    `error`: largest difference so far, N·m.
    """

    backend: Backend
    effort: pw.Array
    count: int = 0
    error: float = 0.0

    def solve(self, problem: pw.TickProblem) -> Solution:
        """Solve, and compare now and then."""
        solution = self.backend.solve(problem)
        self.count += 1
        if self.count % EVERY == 0:
            torques = np.clip(problem.forces(*exact(problem)())[6:], -self.effort, self.effort)
            mine = np.clip(solution.torques, -self.effort, self.effort)
            self.error = max(self.error, float(np.abs(mine - torques).max()))
        return solution


def make(robot: pw.Robot, name: str, solver: str) -> tuple[pw.Walk, float | None]:
    """Return a walk that is about to begin, and when to stop it (s)."""
    planner = pw.FootstepPlanner(0.25, robot.step_width, 0.9)
    if name == "default":
        plan = planner.generate_footsteps(20, ramp=2)
        return pw.Walk(robot, plan, solver=solver), None
    if name == "pushed":
        push = pw.Push(4.1, 0.1, (1000.0, 0.0, 0.0))
        plan = planner.generate_footsteps(12, ramp=2)
        return pw.Walk(robot, plan, pushes=[push], solver=solver), 9.0
    walk = pw.Walk.standing(robot, solver=solver)
    walk.command(1.0, 0.0, 0.0)
    return walk, 12.0


def timed(robot: pw.Robot, name: str, solver: str) -> tuple[pw.Array, pw.Record]:
    """Return the time (s) of each tick of a walk, and its record."""
    walk, until = make(robot, name, solver)
    gc.collect()
    gc.freeze()
    walk.run(until=until)
    if walk.fallen:
        raise SystemExit(f"fell with {solver}: {name}")
    record = walk.record()
    return record.tick_time, record


def torque_error(robot: pw.Robot, name: str, solver: str) -> float:
    """Return the largest difference (N·m) of a walk's torques from exact ones."""
    walk, until = make(robot, name, solver)
    body = walk.walker.body
    body.backend = compared = Compared(body.backend, robot.effort)
    walk.run(until=until)
    return compared.error


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--rounds", type=int, default=3, help="rounds of all walks")
    parser.add_argument("--solvers", default="osqp,daqp", help="names, with commas between them")
    options = parser.parse_args()
    os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})
    robot, solvers = pw.load_robot("talos"), options.solvers.split(",")
    for name, words in WALKS.items():
        print(f"\n{name}: {words}; us")
        print(f"{'':10}{'median':>8}{'p99':>8}{'max':>8}{'> 1 ms':>9}{'itself':>9}{'N·m':>10}")
        times: dict[str, list[pw.Array]] = {solver: [] for solver in solvers}
        records: dict[str, pw.Record] = {}
        for _ in range(options.rounds):
            for solver in solvers:
                spent, records[solver] = timed(robot, name, solver)
                times[solver].append(spent)
        for solver in solvers:
            least = 1e6 * np.min(times[solver], axis=0)
            share = records[solver].summary().qp_own_share or 0.0
            print(
                f"{solver:10}{np.median(least):8.0f}{np.percentile(least, 99):8.0f}"
                f"{least.max():8.0f}{np.mean(least > 1000.0):9.2%}{share:9.2%}"
                f"{torque_error(robot, name, solver):10.1g}",
                flush=True,
            )


if __name__ == "__main__":
    main()
