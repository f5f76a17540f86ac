"""The whole-body controller: one QP a tick turns tasks and contacts into joint torques."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from time import perf_counter
from typing import Any

import numpy as np
import qpsolvers

from preview_walk.arguments import instance_of, positive_number, shown
from preview_walk.errors import InvalidInput
from preview_walk.robots.building.leg import leg_joints
from preview_walk.robots.robot import Robot
from preview_walk.tracking.contacts import load_shares
from preview_walk.tracking.dynamics import Dynamics
from preview_walk.tracking.gains import TrackingGains
from preview_walk.tracking.measured import check_state
from preview_walk.tracking.qp.answer import flaw
from preview_walk.tracking.qp.condensed_backend import CondensedBackend
from preview_walk.tracking.qp.problem import TickProblem
from preview_walk.tracking.qp.safety import Fallback, QPFailure
from preview_walk.tracking.qp.solution import Backend, Solution
from preview_walk.tracking.qp.solvers import DEFAULT, make_backend
from preview_walk.tracking.tasks import (
    AngularMomentumTask,
    CoMTask,
    FootTask,
    PostureTask,
    Task,
    TorsoTask,
)
from preview_walk.types import FEET, Array, Foot

POSTURE_MARGIN = 0.02
"""The posture drawn to keeps this distance (rad) from the joints' limits."""


@dataclass
class TickTimes:
    """Seconds spent in the parts of one tick: terms of the dynamics, writing the QP, solving it."""

    terms: float = 0.0
    assembly: float = 0.0
    solve: float = 0.0


class WholeBodyController:
    """Tasks and contacts in, torques out.

    Set the tasks' references, then call `update` and `torques`. A foot that is not in contact
    follows its foot task.

    Attributes:
        robot, gains, friction: what it was made of.
        dynamics: the robot's terms at the measured state.
        com, torso, posture: tasks; `foot_tasks`: one per foot; `momentum`: in force where the gains
            give it a weight.
        settle: twists (6,), sole axes, m/s and rad/s, with which feet in contact come to lie on
            the ground; a foot that is not in it stays where it is.
        backend: the solver; any object with the `Backend` protocol's `solve`.
        solution: the last tick's accelerations and wrenches; None before it.
        times: what the last tick cost.
        failure: the evidence of the last tick that was not solved; None while all were.
    """

    def __init__(
        self,
        robot: Robot,
        gains: TrackingGains,
        friction: float,
        solver: str = DEFAULT,
        *,
        edge: float = 0.0,
    ) -> None:
        """Make the tasks of a robot.

        Args:
            robot: from `load_robot`.
            gains: weights and gains of the tasks.
            friction: Coulomb friction between soles and ground.
            solver: "osqp", kept warm from tick to tick, "daqp", or a backend of qpsolvers.
            edge: width along the soles' edges where nothing is to be pressed, m.

        Raises:
            InvalidInput: there is no such solver.
        """
        self.robot = instance_of(robot, Robot, "robot")
        self.friction, self._edge = positive_number(friction, "friction"), edge
        if not isinstance(solver, str) or len(solver) > 80:
            raise InvalidInput(f"solver must be a short name, got {shown(solver)}.", "solver")
        self.backend: Backend = make_backend(solver)
        self.dynamics = Dynamics(robot)
        self._make_tasks(instance_of(gains, TrackingGains, "gains"))
        self.settle: dict[Foot, Array] = {}
        self.times = TickTimes()
        self.solution: Solution | None = None
        self.failure: QPFailure | None = None
        self._fallback = Fallback()
        self._gravity = -float(robot.pin.gravity.linear[2])
        self._problems: dict[tuple[Foot, ...], TickProblem] = {}
        self._contacts: tuple[Foot, ...] = ()

    def _make_tasks(self, gains: TrackingGains) -> None:
        """Make the tasks of every walk, with these weights and gains."""
        robot, self.gains = self.robot, gains
        self.com = CoMTask(gains.com_weight)
        self.foot_tasks = {
            foot: FootTask(foot, gains.foot_weight, gains.foot, robot.legs[foot].unplaced)
            for foot in FEET
        }
        self.torso = TorsoTask(gains.torso_weight, gains.torso)
        self.tasks: list[Task] = [self.com, self.torso]
        self.momentum = AngularMomentumTask(gains.momentum_weight, gains.momentum)
        if gains.momentum_weight > 0.0:
            self.tasks.append(self.momentum)
        self.posture = _posture_task(robot, gains)

    def tune(self, gains: TrackingGains) -> None:
        """Take other weights and gains, from the next tick on; tasks of one's own stay.

        The tasks are made anew: their references are to be set before `torques`.
        """
        old = (self.com, self.torso, self.momentum)
        own = [task for task in self.tasks if task not in old]
        self._make_tasks(gains)
        self.tasks += own
        self._problems.clear()

    def __repr__(self) -> str:
        return f"WholeBodyController({self.robot.name}, {len(self.tasks)} tasks, posture, feet)"

    def __getstate__(self) -> dict[str, Any]:
        """Leave out the QPs, which are views into each other and made again when needed."""
        return {**vars(self), "_problems": {}}

    @property
    def status(self) -> int:
        """How the last tick was answered: 0 solved, 1 by the last solution, 2 damped posture."""
        return self._fallback.status

    @property
    def failures(self) -> int:
        """How many ticks were not solved."""
        return self._fallback.count

    def add_task(self, task: Task) -> None:
        """Add a task of one's own, from the next tick on.

        Args:
            task: any object with the `Task` protocol.

        Raises:
            InvalidInput: it has no row, or no positive weight.
        """
        if not (task.rows >= 1 and 0.0 < task.weight < np.inf):
            raise InvalidInput(
                f"a task must have rows >= 1 and a weight > 0, "
                f"got rows = {task.rows} and weight = {task.weight}."
            )
        self.tasks.append(task)
        self._problems.clear()

    def update(self, q: Array, v: Array) -> None:
        """Compute the dynamics at the measured state.

        Args:
            q: (nq,) configuration, Pinocchio's conventions.
            v: (nv,) velocity, Pinocchio's conventions.

        Raises:
            StateError: it cannot be: not finite, no unit quaternion, faster than sound.
        """
        start = perf_counter()
        check_state(q, v, self.robot)
        self.dynamics.update(q, v)
        self.times.terms = perf_counter() - start

    def torques(self, normal_limit: Mapping[Foot, float]) -> Array:
        """Return the joint torques (n,), N·m, within the joints' limits.

        Args:
            normal_limit: the feet in contact, and the normal force that each may carry, N.
        """
        start = perf_counter()
        problem = self.problem(normal_limit)
        filled = perf_counter()
        solution = self._solve(problem)
        torques = np.minimum(solution.torques, self.robot.effort)
        np.maximum(torques, -self.robot.effort, out=torques)
        self.solution, self._contacts = solution, problem.contacts
        self.times.assembly, self.times.solve = filled - start, perf_counter() - filled
        return torques

    def wrench(self, foot: Foot) -> Array:
        """Return the wrench (6,) that the last tick planned under a foot; zero for one in the air.

        [force; moment about the sole's centre], ground on robot, world axes, N, N·m.
        """
        if self.solution is None or foot not in self._contacts:
            return np.zeros(6)
        local = self.solution.wrench[6 * self._contacts.index(foot) :][:6]
        world: Array = (local.reshape(2, 3) @ self.dynamics.soles[foot].rotation.T).reshape(6)
        return world

    def build(self, normal_limit: Mapping[Foot, float]) -> qpsolvers.Problem:
        """Return the QP that `torques` would solve now; see `TickProblem.build`."""
        return self.problem(normal_limit).build()

    def problem(self, normal_limit: Mapping[Foot, float]) -> TickProblem:
        """Return the QP that `torques` would solve now, made when its contacts are first met."""
        contacts = tuple(foot for foot in FEET if foot in normal_limit)
        problem = self._problems.get(contacts)
        if problem is None:
            swing = [self.foot_tasks[foot] for foot in FEET if foot not in contacts]
            problem = TickProblem(
                self.robot,
                contacts,
                [*self.tasks, *swing],
                self.posture,
                wrench_weight=self.gains.wrench_weight,
                friction=self.friction,
                edge=self._edge,
            )
            self._problems[contacts] = problem
        problem.fill(self.dynamics, normal_limit, self._shares(contacts), self.settle)
        return problem

    def _shares(self, contacts: tuple[Foot, ...]) -> tuple[float, ...]:
        """Return the share of the load on each contact, from the ZMP that the CoM task asks for."""
        if len(contacts) < 2:
            return (1.0,) * len(contacts)
        x, y, z = self.dynamics.com.tolist()
        ax, ay, az = self.com.acceleration.tolist()
        left, right = (self.dynamics.soles[foot].position.tolist() for foot in contacts)
        height = z - 0.5 * (left[2] + right[2])
        lever = height / max(self._gravity + az, 0.1 * self._gravity)
        return load_shares((x - lever * ax, y - lever * ay), left, right)

    def _solve(self, problem: TickProblem) -> Solution:
        """Return the backend's solution, or what stands in for it."""
        solution, cause, why = None, None, None
        try:
            solution = self.backend.solve(problem)
            why = flaw(problem, solution, isinstance(self.backend, CondensedBackend))
        # Whatever a solver may raise, even an exit from the program, the robot needs torques now.
        except (Exception, SystemExit) as error:
            cause, why = error, str(error) or type(error).__name__
        if why is None and solution is not None:
            self._fallback.solved(problem, solution)
            return solution
        self.failure = QPFailure(problem.build(), solution, cause, str(why))
        return self._fallback.solution(problem, self.dynamics)


def _posture_task(robot: Robot, gains: TrackingGains) -> PostureTask:
    """Return the task that keeps the walking posture: legs damped, the trunk stiffer than arms."""
    joints = robot.pin.joints
    legs = [
        int(joints[joint].idx_v) - 6
        for foot in FEET
        for joint in leg_joints(robot.pin, robot.soles[foot].frame)
        if joint not in robot.legs[foot].spare
    ]
    weight = np.full(robot.pin.nv - 6, gains.posture_weight)
    # The trunk is one body: its joints keep the pelvis with the torso, whose task is upright.
    trunk = robot.pin.supports[robot.pin.frames[robot.torso].parentJoint]
    weight[[joints[int(j)].idx_v - 6 for j in trunk if int(j) > 1]] = gains.trunk_weight
    margin = np.minimum(POSTURE_MARGIN, 0.5 * (robot.q_upper - robot.q_lower))
    posture = np.clip(robot.posture[7:], robot.q_lower + margin, robot.q_upper - margin)
    return PostureTask(posture, weight, gains.posture, legs)
