"""The world: MuJoCo's model and state of one run, its sensors and its motors."""

from __future__ import annotations

import copy
from collections.abc import Sequence

import mujoco
import numpy as np

from preview_walk.errors import InvalidInput
from preview_walk.robots.building.assemble import sole_name
from preview_walk.robots.building.contact_sensor import WrenchSensor
from preview_walk.robots.robot import Robot
from preview_walk.robots.state import to_mujoco, to_pinocchio
from preview_walk.simulation.pushes import Push, Pusher
from preview_walk.types import FEET, Array, Foot

SLIP_RATIO = 10.0
"""MuJoCo's `impratio`: with its default of 1 a loaded sole creeps 5 mm a step over dry floor."""


class World:
    """A robot on the floor in MuJoCo.

    `q` (nq,), `v` (nv,): the measured state in Pinocchio's conventions; `wrench[foot]` (6,): what
    the sole's force sensor reads, at the sole's centre in world axes. `step` moves time on.
    """

    def __init__(
        self,
        robot: Robot,
        model: mujoco.MjModel,
        physics_hz: int,
        friction: float,
        pushes: Sequence[Push] = (),
    ) -> None:
        self.robot = robot
        self.model = copy.copy(model)
        self.model.opt.timestep = 1.0 / physics_hz
        self.model.opt.cone = mujoco.mjtCone.mjCONE_ELLIPTIC
        self.model.opt.impratio = SLIP_RATIO
        self.model.geom_friction[:, 0] = friction
        self.data = mujoco.MjData(self.model)
        self.q: Array = np.array(robot.posture)
        self.v: Array = np.zeros(robot.pin.nv)
        self.wrench: dict[Foot, Array] = {foot: np.zeros(6) for foot in FEET}
        self.push: Array = np.zeros(3)
        self._pusher = Pusher(self.model, pushes)
        self._sensors = {foot: WrenchSensor(self.model, sole_name(foot)) for foot in FEET}
        self._soles = {foot: self.data.site(sole_name(foot)).xpos for foot in FEET}
        joints = self.model.actuator_trnid[:, 0]
        self._motor_joint = self.model.jnt_dofadr[joints] - 6
        self._physics_dt = 1.0 / physics_hz

    def place(self, q: Array) -> None:
        """Stand the robot still in configuration q (nq,): only before the run."""
        to_mujoco(q, np.zeros(self.model.nv), self.data.qpos, self.data.qvel)
        mujoco.mj_forward(self.model, self.data)

    def sense(self) -> None:
        """Read the state and the force sensors into `q`, `v` and `wrench`."""
        to_pinocchio(self.data.qpos, self.data.qvel, self.q, self.v)
        for foot in FEET:
            self._sensors[foot].read(self.data, self._soles[foot], self.wrench[foot])

    def step(self, torques: Array, steps: int) -> None:
        """Hold the joint torques (n,) in N·m for a number of physics steps."""
        data = self.data
        data.ctrl[:] = torques[self._motor_joint]
        for _ in range(steps):
            self.push = self._pusher.apply(data.time, data)
            mujoco.mj_step(self.model, data)


def steps_per_tick(physics_hz: int, control_hz: int) -> int:
    """Return the physics steps of one control tick.

    Raises `InvalidInput` where a rate is not positive or physics_hz is not a multiple.
    """
    if physics_hz <= 0 or control_hz <= 0 or physics_hz % control_hz:
        raise InvalidInput(
            f"physics_hz must be a positive multiple of control_hz, "
            f"got {physics_hz} and {control_hz}.",
            argument="physics_hz",
        )
    return physics_hz // control_hz
