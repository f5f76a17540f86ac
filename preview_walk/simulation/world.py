"""The project's own world: a robot on the floor in MuJoCo, its sensors and its motors."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import mujoco
import numpy as np

from preview_walk.arguments import instance_of, number_within
from preview_walk.robots.building.assemble import sole_name
from preview_walk.robots.building.contact_sensor import WrenchSensor
from preview_walk.robots.robot import Robot
from preview_walk.robots.state import to_mujoco, to_pinocchio
from preview_walk.simulation.ground_geoms import model_on
from preview_walk.simulation.pushes import Push, Pusher
from preview_walk.simulation.studs import Studs
from preview_walk.terrain.ground import FlatGround, Ground
from preview_walk.terrain.height_field import HeightField
from preview_walk.types import FEET, Array, Foot

FRICTION = 0.8
"""Default Coulomb friction between sole and floor: rubber on dry floor."""

PHYSICS_HZ = 1000
"""Default steps of the physics per second."""

MAX_PHYSICS_HZ = 1e5
"""Most steps of the physics per second: beyond it a second of walking takes minutes."""

MAX_FRICTION = 10.0
"""Largest Coulomb friction: racing tyres have 2; far beyond it the friction cone is no cone."""

SLIP_RATIO = 10.0
"""MuJoCo's `impratio`: with its default of 1 a loaded sole creeps 5 mm a step over dry floor."""


class World:
    """A robot on the ground in MuJoCo; a `Plant`.

    Attributes:
        robot, ground, friction, timestep, q, v, wrench, pushes, push: see `Plant`.
        model, data: MuJoCo's.
    """

    def __init__(
        self,
        robot: Robot,
        *,
        physics_hz: int = PHYSICS_HZ,
        friction: float = FRICTION,
        pushes: Sequence[Push] = (),
        visuals: bool = False,
        ground: Ground | None = None,
    ) -> None:
        """Put the robot into its world.

        Args:
            robot: from `load_robot`.
            physics_hz: steps of the physics per second.
            friction: Coulomb friction between soles and floor.
            pushes: forces on the robot's bodies.
            visuals: use the model with visual meshes, for a live viewer.
            ground: what it stands on; None is level, at height 0.

        Raises:
            InvalidInput: a rate or friction that is not finite and > 0, or a push on an unknown
                body.
        """
        instance_of(robot, Robot, "robot")
        rate = number_within(physics_hz, "physics_hz", 1, MAX_PHYSICS_HZ, "per second")
        self.robot = robot
        self.friction = number_within(friction, "friction", 1e-3, MAX_FRICTION)
        self.ground: Ground = FlatGround() if ground is None else ground
        self.timestep = 1.0 / rate
        self.model = model_on(robot, ground, visuals is True)
        self.model.opt.timestep = self.timestep
        self.model.opt.cone = mujoco.mjtCone.mjCONE_ELLIPTIC
        self.model.opt.impratio = SLIP_RATIO
        self.model.geom_friction[:, 0] = self.friction
        self.data = mujoco.MjData(self.model)
        self.q: Array = np.array(robot.posture)
        self.v: Array = np.zeros(robot.pin.nv)
        self.wrench: dict[Foot, Array] = {foot: np.zeros(6) for foot in FEET}
        self.push: Array = np.zeros(3)
        self._pusher = Pusher(self.model, pushes)
        self._sensors = {foot: WrenchSensor(self.model, sole_name(foot)) for foot in FEET}
        joints = self.model.actuator_trnid[:, 0]
        self._motor_joint = self.model.jnt_dofadr[joints] - 6
        self._studs: Studs | None = None
        self._look_at_soles()

    def _look_at_soles(self) -> None:
        # Views of MuJoCo's own memory: they follow every step.
        self._soles = {foot: self.data.site(sole_name(foot)).xpos for foot in FEET}

    def __repr__(self) -> str:
        return f"World({self.robot.name}, {1.0 / self.timestep:g} Hz, friction {self.friction:g})"

    def __getstate__(self) -> dict[str, Any]:
        """Leave out the views, which belong to this state's memory."""
        return {name: value for name, value in vars(self).items() if name != "_soles"}

    def __setstate__(self, state: dict[str, Any]) -> None:
        """Take the state and look at it anew."""
        vars(self).update(state)
        self._look_at_soles()

    @property
    def pushes(self) -> tuple[Push, ...]:
        """The forces on the robot's bodies, those added under way among them."""
        return self._pusher.pushes

    def add_push(self, push: Push) -> None:
        """Push a body beside what was known beforehand; `InvalidInput` for an unknown one."""
        self._pusher.add(push)

    def place(self, q: Array, t: float) -> None:
        """Stand the robot still in configuration q (nq,) at time t (s): only before the run."""
        to_mujoco(q, np.zeros(self.model.nv), self.data.qpos, self.data.qvel)
        if isinstance(self.ground, HeightField):
            # Made here, for friction and softness of the soles are settled now.
            self._studs = Studs(self.model, self.ground)
            mujoco.mj_kinematics(self.model, self.data)
            self._studs.follow(self.data)
        mujoco.mj_forward(self.model, self.data)
        self.data.time = t

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
            self._advance()

    def _advance(self) -> None:
        """Go on by one step of the physics."""
        self.push = self._pusher.apply(self.data.time, self.data)
        if self._studs is not None:
            self._studs.follow(self.data)
        mujoco.mj_step(self.model, self.data)
