"""Drives: the motors of one robot in one run, which make torques of those asked for."""

from __future__ import annotations

from collections import deque
from copy import copy
from dataclasses import replace

import mujoco
import numpy as np

from preview_walk.reality.faults import Faulty
from preview_walk.reality.motors import Motors, lag_of
from preview_walk.reality.realism import Realism
from preview_walk.robots.robot import Robot
from preview_walk.types import Array

RIPPLES = 12
"""Waves of the torque over a turn of the joint's motor side: pole pairs as seen through a gear are
many more, but beyond the control's bandwidth they matter less."""


def with_rotors(robot: Robot, inertia: float) -> Robot:
    """Return a robot whose joints have to turn their motors' rotors too, in both engines.

    Args:
        robot: as its model has it.
        inertia: kg·m^2 at the joint for each N·m of its largest torque.
    """
    if inertia == 0.0:
        return robot
    turned = replace(robot, mj=copy(robot.mj), pin=robot.pin.copy())
    armature = np.maximum(robot.mj.dof_armature[6:], inertia * robot.effort)
    turned.mj.dof_armature[6:] = armature
    mujoco.mj_setConst(turned.mj, mujoco.MjData(turned.mj))
    turned.pin.armature[6:] = armature
    return turned


class Drives:
    """Delay, lag, friction and errors of a robot's motors; `act` at every step of the physics."""

    def __init__(
        self,
        robot: Robot,
        model: mujoco.MjModel,
        realism: Realism,
        rng: np.random.Generator,
    ) -> None:
        """Build them into the physics.

        Args:
            robot: whose motors they are.
            model: MuJoCo's, of the world; friction is put into it.
            realism: what they are like.
            rng: draws their errors.
        """
        motors: Motors = realism.motors
        n = robot.pin.nv - 6
        errors, phases = rng.standard_normal(n), rng.uniform(0.0, 2.0 * np.pi, n)
        self._limit = robot.effort
        self._share = motors.strength * (1.0 + motors.error * errors)
        self._wave, self._phases = motors.ripple * robot.effort, phases
        dt = float(model.opt.timestep)
        self._follow = (
            1.0 if motors.bandwidth == 0.0 else 1.0 - np.exp(-dt / lag_of(motors.bandwidth))
        )
        steps = round(motors.delay / dt)
        self._queue = deque([np.zeros(n)] * (steps + 1), steps + 1)
        self._faulty = Faulty(realism.faults, "motor", robot.joint_names)
        self.torques: Array = np.zeros(n)
        self._rest = True
        model.dof_frictionloss[6:] += motors.dry_friction * robot.effort
        model.dof_damping[6:] += motors.viscous_friction * robot.effort

    def act(self, wanted: Array, data: mujoco.MjData) -> Array:
        """Return the torques (n,), N·m, that act in the next step of the physics.

        Args:
            wanted: (n,) asked for now, N·m.
            data: the physics.
        """
        if self._rest:  # the robot has been standing by these torques for long
            self._queue.extend([wanted] * len(self._queue))
            self.torques, self._rest = np.array(wanted), False
        self._queue.append(wanted)
        self.torques = self.torques + self._follow * (self._queue[0] - self.torques)
        given = self._share * self.torques
        if self._wave.any():
            given = given + self._wave * np.sin(RIPPLES * data.qpos[7:] + self._phases)
        if self._faulty:
            given = given * self._faulty.shares(float(data.time))
        made: Array = np.clip(given, -self._limit, self._limit)
        return made
