"""Sensors as values: what each does to the quantity that it reads."""

from __future__ import annotations

from dataclasses import dataclass

from preview_walk.reality.checking import Checked


@dataclass(frozen=True)
class Encoders(Checked):
    """Joint encoders, and the joint speeds that the drives make of them.

    A drive differences its encoder at every step of the physics and smooths by a first-order lag.

    Attributes:
        bits: of a whole turn; 0 for an encoder that is exact.
        noise: standard deviation of a reading, rad.
        bias: standard deviation of what a joint is off by for the whole run, rad.
        bandwidth: of the speeds' lag, Hz; 0 for speeds that are read as they are.
        delay: age of a reading when the controller has it, s.
        rate: readings per second; 0: at every step of the physics.
    """

    bits: int = 0
    noise: float = 0.0
    bias: float = 0.0
    bandwidth: float = 0.0
    delay: float = 0.0
    rate: float = 0.0


@dataclass(frozen=True)
class Imu(Checked):
    """Gyro and accelerometer at the base's origin; what they give is the mean since the last tick.

    Attributes:
        gyro_noise: standard deviation of a reading at every step of the physics, rad/s.
        gyro_bias: standard deviation of each axis' bias at first, rad/s.
        gyro_walk: by which it wanders, rad/s per square root of a second.
        accelerometer_noise: of a reading, m/s^2.
        accelerometer_bias: of each axis' bias at first, m/s^2.
        accelerometer_walk: by which it wanders, m/s^2 per square root of a second.
        delay: age of a reading when the controller has it, s.
        rate: readings per second; 0: at every step of the physics.
    """

    gyro_noise: float = 0.0
    gyro_bias: float = 0.0
    gyro_walk: float = 0.0
    accelerometer_noise: float = 0.0
    accelerometer_bias: float = 0.0
    accelerometer_walk: float = 0.0
    delay: float = 0.0
    rate: float = 0.0


@dataclass(frozen=True)
class SoleSensors(Checked):
    """Six-axis force sensors under the soles. Moments are off by as much times half the sole.

    Attributes:
        noise: standard deviation of a reading, share of the robot's weight.
        bias: standard deviation of what an axis is off by at first, share of the weight.
        drift: by which it wanders, share of the weight per square root of a second.
        delay: age of a reading when the controller has it, s.
        rate: readings per second; 0: at every step of the physics.
    """

    noise: float = 0.0
    bias: float = 0.0
    drift: float = 0.0
    delay: float = 0.0
    rate: float = 0.0
