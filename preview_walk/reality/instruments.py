"""Instruments: the sensors of one robot in one run, which sample the physics."""

from __future__ import annotations

from collections import deque

import mujoco
import numpy as np

from preview_walk.estimation.measurement import Measurement
from preview_walk.reality.faults import Faulty
from preview_walk.reality.motors import lag_of
from preview_walk.reality.realism import Realism
from preview_walk.robots.building.assemble import sole_name
from preview_walk.robots.building.contact_sensor import WrenchSensor
from preview_walk.robots.robot import Robot
from preview_walk.types import FEET, Array

AXES = ("x", "y", "z")

MOST_SPEED = 1e3
"""What a drive takes for the speed of a joint at most, rad/s."""


class Delayed:
    """What was sampled, to be read later: at a rate, after a delay."""

    def __init__(self, first: Array, dt: float, delay: float, rate: float) -> None:
        """Begin with a value that has been there for long.

        Args:
            first: the value.
            dt: time between samples, s.
            delay: age of a sample when it can be read, s.
            rate: samples per second that are passed on; 0: all.
        """
        steps = round(delay / dt)
        self._every = max(1, round(1.0 / (rate * dt))) if rate else 1
        self._queue = deque([np.array(first)] * (steps + 1), steps + 1)
        self._count = 0

    def put(self, sample: Array) -> None:
        """Take the next sample, or hold the last one where none is due."""
        self._count += 1
        self._queue.append(sample if self._count % self._every == 0 else self._queue[-1])

    @property
    def value(self) -> Array:
        """What can be read now."""
        return self._queue[0]


class Instruments:
    """Encoders, IMU and sole sensors of a robot; `sample` at every step of the physics."""

    def __init__(
        self,
        robot: Robot,
        model: mujoco.MjModel,
        realism: Realism,
        rng: np.random.Generator,
    ) -> None:
        """Mount them.

        Args:
            robot: that carries them.
            model: MuJoCo's, of the world.
            realism: what they are like.
            rng: draws their errors.
        """
        self._dt = float(model.opt.timestep)
        self._robot, self._realism, self._rng = robot, realism, rng
        n = robot.pin.nv - 6
        encoders, imu, soles = realism.encoders, realism.imu, realism.soles
        self._offsets = encoders.bias * rng.standard_normal(n)
        self._gyro_bias = imu.gyro_bias * rng.standard_normal(3)
        self._force_bias = imu.accelerometer_bias * rng.standard_normal(3)
        weight = robot.mass * robot.gravity
        # Moments are off by as much at the edge of the sole.
        arm = robot.sole.half_length
        self._load = weight * np.array((1.0, 1.0, 1.0, arm, arm, arm))
        self._sole_bias = soles.bias * rng.standard_normal((2, 6))
        self._sensors = [WrenchSensor(model, sole_name(foot)) for foot in FEET]
        names = robot.joint_names
        faults = realism.faults
        self._faulty = {
            "encoder": Faulty(faults, "encoder", names),
            "speed": Faulty(faults, "speed", names),
            "gyro": Faulty(faults, "gyro", AXES),
            "accelerometer": Faulty(faults, "accelerometer", AXES),
            "sole": Faulty(faults, "sole", FEET),
        }

    def start(self, data: mujoco.MjData) -> None:
        """Read the robot at rest, as it has stood for long."""
        realism, dt = self._realism, self._dt
        angles = self._before = self._angles(data)
        n = len(angles)
        encoders, imu, soles = realism.encoders, realism.imu, realism.soles
        self._last = {
            "encoder": angles,
            "speed": np.zeros(n),
            "gyro": np.zeros(3),
            "accelerometer": np.zeros(3),
            "sole": np.zeros((2, 6)),
        }
        self._speed, self._velocity = np.zeros(n), np.zeros(3)
        turn = np.zeros(9)
        mujoco.mju_quat2Mat(turn, data.qpos[3:7])
        rest = np.zeros((2, 2, 3))
        rest[0, 1] = self._robot.gravity * turn.reshape(3, 3)[2]
        age = Delayed(0.0 * rest, dt, imu.delay, imu.rate)
        self._now = {
            "joints": Delayed(np.array((angles, np.zeros(n))), dt, encoders.delay, encoders.rate),
            "imu": age,
            "soles": Delayed(self._wrenches(data), dt, soles.delay, soles.rate),
        }
        # The sums of what the IMU reads begin as if the robot had stood for long.
        self._sums = rest * 0.0
        for _ in range(round(imu.delay / dt)):
            self._sums = self._sums + dt * rest
            age.put(self._sums)
        self._read = age.value

    def sample(self, data: mujoco.MjData) -> None:
        """Sample the physics after one step of it."""
        t, dt, realism = float(data.time), self._dt, self._realism
        rng, imu = self._rng, realism.imu
        angles = self._spoilt("encoder", self._angles(data), t)
        raw = (angles - self._before) / dt
        # A drive takes no difference that cannot be, or its filter would keep it for ever.
        can_be = np.abs(raw) < MOST_SPEED
        raw = np.where(can_be, raw, self._speed)
        self._before = np.where(can_be | ~np.isfinite(self._before), angles, self._before)
        band = realism.encoders.bandwidth
        exact = band == 0.0
        target = np.array(data.qvel[6:]) if exact else raw
        self._speed = (
            target
            if exact
            else self._speed + (target - self._speed) * (1.0 - np.exp(-dt / lag_of(band)))
        )
        speeds = self._spoilt("speed", self._speed, t)
        self._now["joints"].put(np.array((angles, speeds)))

        velocity = np.array(data.qvel[:3])
        force = (velocity - self._velocity) / dt
        self._velocity = velocity
        force[2] += self._robot.gravity
        turn = np.zeros(9)
        mujoco.mju_quat2Mat(turn, data.qpos[3:7])
        wander = np.sqrt(dt) * rng.standard_normal((2, 3))
        self._gyro_bias = self._gyro_bias + imu.gyro_walk * wander[0]
        self._force_bias = self._force_bias + imu.accelerometer_walk * wander[1]
        noise = rng.standard_normal((2, 3))
        gyro = data.qvel[3:6] + self._gyro_bias + imu.gyro_noise * noise[0]
        felt = force @ turn.reshape(3, 3) + self._force_bias + imu.accelerometer_noise * noise[1]
        gyro = self._spoilt("gyro", gyro, t)
        felt = self._spoilt("accelerometer", felt, t)
        felt = np.array((gyro, felt))
        # A sum would keep a reading that is no number for ever: those are counted instead.
        good = np.isfinite(felt)
        self._sums = self._sums + np.array((dt * np.where(good, felt, 0.0), ~good))
        self._now["imu"].put(self._sums)
        self._now["soles"].put(self._spoilt("sole", self._wrenches(data), t))

    def read(self, elapsed: float) -> Measurement:
        """Return what the sensors give now; `elapsed` (s) since they were read last."""
        joints, wrench = self._now["joints"].value, self._now["soles"].value
        sums = self._now["imu"].value
        means, bad = sums - self._read
        gyro, force = np.where(bad > 0.0, np.nan, means / (elapsed or self._dt))
        self._read = sums
        return Measurement(joints[0], joints[1], gyro, force, dict(zip(FEET, wrench, strict=True)))

    def _spoilt(self, part: str, reading: Array, t: float) -> Array:
        """Return a reading with the part's faults at time t (s)."""
        faulty = self._faulty[part]
        if faulty:
            reading = self._last[part] = faulty.spoil(reading, self._last[part], t)
        return reading

    def _angles(self, data: mujoco.MjData) -> Array:
        """Return the joints' angles as the encoders have them."""
        encoders = self._realism.encoders
        angles: Array = data.qpos[7:] + self._offsets
        if encoders.noise:
            angles += encoders.noise * self._rng.standard_normal(len(angles))
        if encoders.bits:
            step = 2.0 * np.pi / 2**encoders.bits
            angles = step * np.round(angles / step)
        return angles

    def _wrenches(self, data: mujoco.MjData) -> Array:
        """Return the wrenches (2, 6) in the soles' axes as their sensors have them."""
        soles = self._realism.soles
        rng, read = self._rng, np.zeros((2, 6))
        for k, foot in enumerate(FEET):
            site = data.site(sole_name(foot))
            self._sensors[k].read(data, site.xpos, read[k])
            turn = site.xmat.reshape(3, 3)
            read[k] = (read[k].reshape(2, 3) @ turn).reshape(6)
        self._sole_bias = self._sole_bias + soles.drift * np.sqrt(self._dt) * rng.standard_normal(
            (2, 6)
        )
        error = self._sole_bias + soles.noise * rng.standard_normal((2, 6))
        return read + error * self._load
