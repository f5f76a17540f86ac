"""All that is not perfect about a robot, in one value, with presets."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import asdict, dataclass, field, replace
from math import hypot, pi, sqrt
from typing import Any

from preview_walk.arguments import instance_of, items_of, shown
from preview_walk.errors import InvalidInput
from preview_walk.estimation.base_filter import FilterNoise
from preview_walk.estimation.estimator import SensorNoise
from preview_walk.estimation.sole_forces import ForceNoise
from preview_walk.reality.faults import Fault
from preview_walk.reality.mismatch import Mismatch
from preview_walk.reality.motors import Motors, lag_of
from preview_walk.reality.sensors import Encoders, Imu, SoleSensors


@dataclass(frozen=True)
class Realism:
    """What is not perfect about a robot; each number can be set alone, by `replace` of a part.

    Attributes:
        encoders: of the joints.
        imu: in the base.
        soles: force sensors under the feet.
        motors: of the joints.
        mismatch: of the physics and the controller's model.
        faults: what fails, and when.
    """

    encoders: Encoders = field(default_factory=Encoders)
    imu: Imu = field(default_factory=Imu)
    soles: SoleSensors = field(default_factory=SoleSensors)
    motors: Motors = field(default_factory=Motors)
    mismatch: Mismatch = field(default_factory=Mismatch)
    faults: tuple[Fault, ...] = ()

    def __post_init__(self) -> None:
        """Check the parts."""
        kinds = {
            "encoders": Encoders,
            "imu": Imu,
            "soles": SoleSensors,
            "motors": Motors,
            "mismatch": Mismatch,
        }
        for name, kind in kinds.items():
            instance_of(getattr(self, name), kind, name)
        object.__setattr__(self, "faults", tuple(items_of(self.faults, Fault, "faults")))

    @classmethod
    def lab(cls) -> Realism:
        """Return a good robot in a laboratory; docs/realism.md has each number's source."""
        return cls(
            Encoders(bits=16, bias=5e-4, bandwidth=80.0, delay=0.002),
            Imu(
                gyro_noise=0.005,
                gyro_bias=0.01,
                gyro_walk=2e-4,
                accelerometer_noise=0.05,
                accelerometer_bias=0.03,
                accelerometer_walk=1e-3,
                delay=0.002,
            ),
            SoleSensors(noise=0.01, bias=0.01, drift=1e-3, delay=0.002),
            Motors(
                delay=0.0,
                bandwidth=50.0,
                dry_friction=0.02,
                viscous_friction=0.0,
                error=0.02,
                ripple=0.002,
                rotor_inertia=1.5e-4,
            ),
            Mismatch(mass=0.05, inertia=0.05, com=0.01, friction=(0.5, 0.9)),
        )

    @classmethod
    def field(cls) -> Realism:
        """Return a robot in the field: twice as bad as `lab`."""
        return cls(
            Encoders(bits=15, bias=1e-3, bandwidth=40.0, delay=0.004),
            Imu(
                gyro_noise=0.01,
                gyro_bias=0.02,
                gyro_walk=4e-4,
                accelerometer_noise=0.1,
                accelerometer_bias=0.06,
                accelerometer_walk=2e-3,
                delay=0.004,
            ),
            SoleSensors(noise=0.02, bias=0.02, drift=2e-3, delay=0.004),
            Motors(
                delay=0.0,
                bandwidth=25.0,
                dry_friction=0.04,
                viscous_friction=0.0,
                error=0.04,
                ripple=0.004,
                rotor_inertia=1.5e-4,
            ),
            Mismatch(mass=0.1, inertia=0.1, com=0.02, friction=(0.4, 1.0), softness=0.03),
        )

    def with_fault(self, *faults: Fault) -> Realism:
        """Return the same robot with these faults besides."""
        return replace(self, faults=(*self.faults, *faults))

    @property
    def delay(self) -> float:
        """Time (s) from a state to the torques that answer it: of the slowest sensor and motor."""
        return max(self.encoders.delay, self.imu.delay) + self.motors.lag

    @property
    def speed_lag(self) -> float:
        """Time (s) by which the joint speeds' smoothing comes late."""
        return lag_of(self.encoders.bandwidth) if self.encoders.bandwidth else 0.0


PRESETS: dict[str, Callable[[], Realism] | None] = {
    "none": None,
    "lab": Realism.lab,
    "field": Realism.field,
}
"""What `--realism` and `read_realism` know."""


def read_realism(name: str) -> Realism | None:
    """Return the realism of that name; None for "none".

    Raises:
        InvalidInput: there is none.
    """
    if name not in PRESETS:
        raise InvalidInput(
            f"realism must be one of {', '.join(PRESETS)}, got {shown(name)}.", "realism"
        )
    preset = PRESETS[name]
    return None if preset is None else preset()


def plain_values(realism: Realism) -> dict[str, Any]:
    """Return a realism as JSON values, as a record keeps it."""
    return asdict(realism)


def sensor_noise(realism: Realism, leg: float, samples: int, dt: float) -> SensorNoise:
    """Return what an estimator takes the sensors for: a data sheet's numbers.

    Args:
        realism: the robot's.
        leg: length of its legs, m: an encoder's error moves a sole by as much times the leg.
        samples: of the IMU in a tick, over which noise is averaged out.
        dt: time of a tick, s.
    """
    imu, encoders = realism.imu, realism.encoders
    step = 2.0 * pi / 2**encoders.bits / sqrt(12.0) if encoders.bits else 0.0
    error = hypot(encoders.noise, step)
    base = FilterNoise(
        gyro=max(imu.gyro_noise / sqrt(samples), LEAST_GYRO),
        accelerometer=max(imu.accelerometer_noise / sqrt(samples), LEAST_FORCE),
        gyro_walk=max(imu.gyro_walk, 1e-5),
        accelerometer_walk=max(imu.accelerometer_walk, 1e-4),
        gyro_bias=max(imu.gyro_bias, 1e-4),
        accelerometer_bias=max(imu.accelerometer_bias, 1e-3),
        contact=CONTACT_WANDER,
        turn=SOLE_TURN,
        leg=hypot(LEG_PLACE, 2.0 * leg * error),
        ground=hypot(GROUND_HEIGHT, 2.0 * leg * encoders.bias) * sqrt(SAME_GROUND / dt),
    )
    return SensorNoise(base, ForceNoise(realism.soles.noise, realism.soles.bias))


LEAST_GYRO, LEAST_FORCE = 1e-3, 2e-2
"""Even a perfect IMU is not exact over a tick, in which its turn and force change."""

CONTACT_WANDER = 0.003
"""A sole that stands creeps and rocks by so much (m) in a second, on any ground."""

SOLE_TURN = 0.15
"""A standing sole rocks by so much (rad/s) from tick to tick, if by little altogether."""

LEG_PLACE = 0.001
"""A sole's centre is not known better (m): soles sink in and roll."""

GROUND_HEIGHT = 0.003
"""Nor is the ground's height."""

SAME_GROUND = 0.3
"""An error of a height or of an encoder's zero is the same for a whole stance (s), however often it
is read."""
