"""The whole-body controller: one QP a tick turns tasks and contacts into joint torques."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from time import perf_counter

import numpy as np

from preview_walk.robots.posture import leg_joints
from preview_walk.robots.robot import Robot
from preview_walk.tracking.dynamics import Dynamics
from preview_walk.tracking.gains import TrackingGains
from preview_walk.tracking.osqp_workspace import OsqpWorkspace, Solution
from preview_walk.tracking.problem import TickProblem
from preview_walk.tracking.tasks import CoMTask, FootTask, PostureTask, Task, TorsoTask
from preview_walk.types import FEET, Array, Foot, other


@dataclass
class TickTimes:
    """Seconds spent in the parts of one tick."""

    terms: float = 0.0
    assembly: float = 0.0
    solve: float = 0.0


class WholeBodyController:
    """Tasks and contacts in, torques out.

    `com`, `feet`, `torso`, `posture` are the tasks: set their references, then call `torques`.
    A foot that is not in contact follows its foot task.
    """

    def __init__(
        self, robot: Robot, gains: TrackingGains, friction: float, solver: str = "osqp"
    ) -> None:
        self.robot = robot
        self.gains = gains
        self.friction = friction
        self.dynamics = Dynamics(robot)
        self.com = CoMTask(gains.com_weight)
        self.feet = {foot: FootTask(foot, gains.foot_weight, gains.foot) for foot in FEET}
        self.torso = TorsoTask(gains.torso_weight, gains.torso)
        legs = [
            int(robot.pin.joints[joint].idx_v) - 6
            for foot in FEET
            for joint in leg_joints(robot.pin, robot.soles[foot].frame)
        ]
        weight = np.full(robot.pin.nv - 6, gains.posture_weight)
        # The trunk is one body: its joints keep the pelvis with the torso, whose task is upright.
        trunk = [int(j) for j in robot.pin.supports[robot.pin.frames[robot.torso].parentJoint]]
        weight[[robot.pin.joints[j].idx_v - 6 for j in trunk if j > 1]] = gains.trunk_weight
        self.posture = PostureTask(robot.posture[7:], weight, gains.posture, legs)
        self.times = TickTimes()
        self.solution: Solution | None = None
        self._solver = solver
        self._workspaces: dict[tuple[Foot, ...], OsqpWorkspace] = {}
        self._contacts: tuple[Foot, ...] = ()

    def _workspace(self, contacts: tuple[Foot, ...]) -> OsqpWorkspace:
        """Return the workspace of a set of contacts; made when first met."""
        if contacts not in self._workspaces:
            tasks: list[Task] = [self.com, self.torso]
            tasks += [self.feet[foot] for foot in FEET if foot not in contacts]
            problem = TickProblem(
                self.robot,
                contacts,
                tasks,
                self.posture,
                self.gains.wrench_weight,
                self.friction,
            )
            self._workspaces[contacts] = OsqpWorkspace(problem)
        return self._workspaces[contacts]

    def update(self, q: Array, v: Array) -> None:
        """Compute the dynamics at the measured state (Pinocchio's q and v)."""
        start = perf_counter()
        self.dynamics.update(q, v)
        self.times.terms = perf_counter() - start

    def torques(self, normal_limit: Mapping[Foot, float]) -> Array:
        """Return the joint torques (n,) in N·m.

        `normal_limit` names the feet in contact and the normal force (N) each may carry.
        """
        start = perf_counter()
        contacts = tuple(foot for foot in FEET if foot in normal_limit)
        workspace = self._workspace(contacts)
        if contacts != self._contacts:
            self._contacts = contacts
            workspace.reset()
        workspace.problem.fill(self.dynamics, normal_limit)
        filled = perf_counter()
        self.solution = workspace.solve()
        solved = perf_counter()
        self.times.assembly, self.times.solve = filled - start, solved - filled
        torques = workspace.problem.torques(self.solution.z, self.dynamics)
        return np.clip(torques, -self.robot.effort, self.robot.effort)
