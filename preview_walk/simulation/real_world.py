"""The real world: the project's world with a robot as it is, read through sensors."""

from __future__ import annotations

from typing import Any

import numpy as np

from preview_walk.arguments import instance_of
from preview_walk.estimation.measurement import Measurement
from preview_walk.reality.drives import Drives, with_rotors
from preview_walk.reality.instruments import Instruments
from preview_walk.reality.mismatch import misfit
from preview_walk.reality.realism import Realism
from preview_walk.robots.robot import Robot
from preview_walk.simulation.world import World
from preview_walk.types import Array


class RealWorld(World):
    """A robot that is not quite its model, with sensors that are not exact; a `Plant`.

    `q`, `v` and `wrench` are the truth, for the record; the controller gets `measure`.

    Attributes:
        realism: what is not perfect.
        friction: that the controller counts on: the least that the floor may have.
    """

    def __init__(self, robot: Robot, realism: Realism, seed: int = 0, **settings: Any) -> None:
        """Put the robot into its world.

        Args:
            robot: from `load_robot`; the controller's model.
            realism: what is not perfect about it.
            seed: of all errors; the same seed gives the same robot and the same noise.
            settings: keyword arguments of `World`.
        """
        instance_of(robot, Robot, "robot")
        self.realism = instance_of(realism, Realism, "realism")
        super().__init__(with_rotors(robot, realism.motors.rotor_inertia), **settings)
        mismatch = realism.mismatch
        masses, floor, motors, sensors = (
            np.random.default_rng(part) for part in np.random.SeedSequence(seed).spawn(4)
        )
        # A model with ground was made anew from the robot's sources, which know of no rotors.
        self.model.dof_armature[6:] = self.robot.mj.dof_armature[6:]
        misfit(self.model, mismatch, masses)
        if mismatch.friction is not None:
            self.model.geom_friction[:, 0] = floor.uniform(*mismatch.friction)
            self.friction = mismatch.friction[0]
        self._drives = Drives(self.robot, self.model, realism, motors)
        self._instruments = Instruments(self.robot, self.model, realism, sensors)

    def place(self, q: Array, t: float) -> None:
        """Stand the robot still in configuration q (nq,) at time t (s): only before the run."""
        super().place(q, t)
        self._instruments.start(self.data)

    def measure(self, elapsed: float) -> Measurement:
        """Return what the sensors read now; `elapsed` (s) since they were read last."""
        return self._instruments.read(elapsed)

    @property
    def torques(self) -> Array:
        """(n,) that the motors made in the last step of the physics, N·m."""
        return self._drives.torques

    @property
    def com(self) -> Array:
        """(3,) centre of mass of the robot in the physics, world, m."""
        return np.array(self.data.subtree_com[1])

    def step(self, torques: Array, steps: int) -> None:
        """Ask the motors for torques (n,) in N·m during a number of physics steps."""
        data = self.data
        for _ in range(steps):
            data.ctrl[:] = self._drives.act(torques, data)[self._motor_joint]
            self._advance()
            self._instruments.sample(data)
