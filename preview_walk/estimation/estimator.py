"""The estimator: from the readings of a tick to the state that the controller walks by."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import sqrt

import numpy as np
import pinocchio as pin

from preview_walk.estimation.base_filter import BaseFilter, FilterNoise
from preview_walk.estimation.joints import Joints
from preview_walk.estimation.measurement import Measurement
from preview_walk.estimation.signals import Channel
from preview_walk.estimation.sole_forces import ForceNoise, SoleForces
from preview_walk.robots.robot import Robot
from preview_walk.terrain.ground import Ground
from preview_walk.types import FEET, Array, Foot

TILT = 0.01
"""Standard deviation of roll and pitch (rad), and of the velocity (m/s), of a robot set down."""

STANDS_ALONE = 0.6
"""A sole with this share of the weight on it does not turn."""

STANDS = 0.2
"""A sole with this share of the weight on it lies on the ground, whose height is known."""

CORRECTED = 4
"""The legs are taken in once in so many ticks; the IMU leads the state on at every one."""

LEAST_TIME = 1e-3
"""Time (s) for which the first readings of a run stand."""


@dataclass(frozen=True)
class SensorNoise:
    """What an estimator takes its sensors for.

    Attributes:
        base: of IMU and legs.
        soles: of the force sensors.
    """

    base: FilterNoise
    soles: ForceNoise


@dataclass(frozen=True, eq=False)
class Estimate:
    """The state as the controller has it.

    Attributes:
        q: (nq,) configuration, Pinocchio's conventions.
        v: (nv,) velocity, Pinocchio's conventions.
        wrench: (6,) per foot, ground on robot: [force; moment about the sole's centre], world axes.
        spread: standard deviation of the base's horizontal velocity, m/s.
    """

    q: Array
    v: Array
    wrench: Mapping[Foot, Array]
    spread: float = 0.0


class Estimator:
    """Tells a robot's state from its sensors.

    Attributes:
        base: the filter of the base's pose and velocity, as of the readings' time.
        delay: age of the readings, and of the torques when they act, s: `state` is that much ahead
            of `base`.
        soles: what they feel.
        joints: what they do.
    """

    def __init__(
        self, robot: Robot, q: Array, noise: SensorNoise, delay: float, ground: Ground | None
    ) -> None:
        """Begin with a robot at rest in a configuration that is known.

        Args:
            robot: whose state is wanted.
            q: (nq,) configuration, Pinocchio's conventions.
            noise: of the sensors.
            delay: to be predicted over, s.
            ground: whose height under the soles is known; None where it is not.
        """
        self.robot, self.delay, self._ground = robot, delay, ground
        self._model, self._data = robot.pin, robot.pin.createData()
        self.joints, self._moving = Joints(q[7:]), np.zeros(robot.pin.nv)
        self._frames = [robot.soles[foot].frame for foot in FEET]
        self._own = np.array(q)
        self._own[:3], self._own[3:7] = 0.0, (0.0, 0.0, 0.0, 1.0)
        self._weight = robot.mass * robot.gravity
        rotation = pin.Quaternion(q[3:7]).toRotationMatrix()
        soles = q[:3] + self._legs() @ rotation.T
        self.base = BaseFilter(noise.base, rotation, q[:3], soles, TILT)
        self.soles = SoleForces(self._weight, noise.soles)
        self._gyro = Channel("axis of the gyro", "rad/s", 50.0)
        self._accelerometer = Channel("axis of the accelerometer", "m/s^2", 1000.0)
        self._since, self._steps = 0.0, 0
        self._turns: list[Array] = []
        self._last_gyro, self._last_force = np.zeros(3), np.array((0.0, 0.0, robot.gravity))

    @property
    def refused(self) -> int:
        """How many readings could not be, and were not taken."""
        return self.joints.refused + self._gyro.refused + self._accelerometer.refused

    def update(self, m: Measurement, acceleration: Array, dt: float) -> Estimate:
        """Return the state at the time when this tick's torques act.

        Args:
            m: the readings.
            acceleration: (nv,) that the controller has asked for, Pinocchio's conventions.
            dt: time since the last readings, s.

        Raises:
            SensorError: a sensor has failed for too long.
        """
        self.joints.update(m, acceleration[6:], dt)
        gyro = self._gyro.take(m.gyro, self._last_gyro, dt)
        force = self._accelerometer.take(m.accelerometer, self._last_force, dt)
        self._own[7:] = self.joints.angles
        self._last_gyro, self._last_force = gyro, force
        base = self.base
        if dt > 0.0:
            base.predict(gyro, force, dt)
            self._since, self._steps = self._since + dt, self._steps + 1
        legs = self._legs()
        read = np.array([m.wrench[foot] for foot in FEET])
        carried = self.robot.mass * float(base.rotation[2] @ (force - base.accelerometer_bias))
        self.soles.update(read, carried, legs @ base.rotation[2], max(dt, LEAST_TIME))
        standing = 0 if self.soles.loads[0] > self.soles.loads[1] else 1
        if self.soles.loads[standing] > STANDS_ALONE:
            self._turns.append(gyro - self._turn(standing))
        if self._steps in (0, CORRECTED):
            self._correct(legs)
        wrench = self._wrenches()
        return self._ahead(gyro - base.gyro_bias, acceleration, wrench)

    def _correct(self, legs: Array) -> None:
        """Take in what the legs tell, and how much less is known since they last did."""
        if self._steps:
            self.base.spread(self._since, self._steps, self.soles.loads)
        self.base.correct(legs, self._heights(), self._turns)
        self._since, self._steps, self._turns = 0.0, 0, []

    def _legs(self) -> Array:
        """Return the places (2, 3) of the soles from the base, base axes, m."""
        self._moving[6:] = self.joints.speeds
        pin.forwardKinematics(self._model, self._data, self._own, self._moving)
        return np.array(
            [pin.updateFramePlacement(self._model, self._data, f).translation for f in self._frames]
        )

    def _turn(self, foot: int) -> Array:
        """Return the base's turning rate (3,), base axes, rad/s, if this sole does not turn."""
        sole = self._frames[foot]
        turning = pin.getFrameVelocity(self._model, self._data, sole).angular
        value: Array = -(self._data.oMf[sole].rotation @ turning)
        return value

    def _wrenches(self) -> dict[Foot, Array]:
        """Return the soles' wrenches in world axes."""
        wrench = {}
        for k, (foot, frame) in enumerate(zip(FEET, self._frames, strict=True)):
            turn = self.base.rotation @ self._data.oMf[frame].rotation
            wrench[foot] = (self.soles.wrench[k].reshape(2, 3) @ turn.T).reshape(6)
        return wrench

    def _heights(self) -> list[float | None]:
        """Return the height of known ground under each sole that stands on it, or None."""
        if self._ground is None:
            return [None, None]
        return [
            float(self._ground.height(*self.base.vectors[2 + k, :2])) if load > STANDS else None
            for k, load in enumerate(self.soles.loads)
        ]

    def _ahead(self, spin: Array, acceleration: Array, wrench: dict[Foot, Array]) -> Estimate:
        """Return the state by which the robot has moved on when the torques act."""
        base, angles, speeds = self.base, self.joints.angles, self.joints.speeds
        q = np.empty(len(angles) + 7)
        q[:3], q[7:] = base.position, angles
        q[3:7] = pin.Quaternion(base.rotation).coeffs()
        v = np.concatenate((base.rotation.T @ base.velocity, spin, speeds))
        ahead = self.delay
        if ahead > 0.0:
            q = pin.integrate(self._model, q, ahead * v + (0.5 * ahead * ahead) * acceleration)
            v = v + ahead * acceleration
        x, y = base.covariance[3, 3], base.covariance[4, 4]
        return Estimate(q, v, wrench, sqrt(0.5 * float(x + y)))
