"""What a robot with real sensors measured and estimated, beside the truth, at every tick."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Any

import numpy as np
from numpy.typing import NDArray

from preview_walk.geometry.planar import turn, wrap
from preview_walk.record.columns import Columns
from preview_walk.record.fields import FieldInfo, field_info
from preview_walk.record.read_only import ReadOnlyArrays, own_array
from preview_walk.types import Array

_SOLE = "force sensor of the {} sole: [force; moment about its centre], the sole's axes"


@dataclass(frozen=True, eq=False, kw_only=True)
class Sensed(ReadOnlyArrays):
    """The sensors' readings, the estimate that the controller walked by, and the truth beside it.

    Row i is the same tick as row i of the record, whose `q`, `v` and forces are the truth.
    """

    estimate_q: Array = field_info("nq", unit="m, 1, rad", doc="estimated configuration, xyzw")
    estimate_v: Array = field_info("nv", unit="m/s, rad/s", doc="estimated velocity, base axes")
    angles: Array = field_info("nu", unit="rad", doc="encoders' readings")
    speeds: Array = field_info("nu", unit="rad/s", doc="joint speeds as the drives give them")
    gyro: Array = field_info(
        3, unit="rad/s", doc="mean turning rate since the last tick, base axes"
    )
    accelerometer: Array = field_info(3, unit="m/s²", doc="mean specific force likewise")
    gyro_bias: Array = field_info(3, unit="rad/s", doc="estimated bias of the gyro")
    accelerometer_bias: Array = field_info(3, unit="m/s²", doc="and of the accelerometer")
    spread: Array = field_info(
        9, unit="rad, m/s, m", doc="standard deviations of base rotation, velocity and position"
    )
    left_sole: Array = field_info(6, unit="N, N·m", doc=_SOLE.format("left"))
    right_sole: Array = field_info(6, unit="N, N·m", doc=_SOLE.format("right"))
    motor_torque: Array = field_info("nu", unit="N·m", doc="torques that the motors made")
    true_com: Array = field_info(3, unit="m", doc="centre of mass of the bodies in the physics")
    refused: NDArray[np.int32] = field_info(
        unit="1", dtype=np.int32, doc="readings that could not be, up to this tick"
    )

    def __post_init__(self) -> None:
        """Make the arrays read-only."""
        for name, info in SENSED.items():
            object.__setattr__(self, name, own_array(getattr(self, name), info.dtype, name))

    def arrays(self) -> dict[str, NDArray[Any]]:
        """Return the arrays by name."""
        return {name: getattr(self, name) for name in SENSED}

    def drift(self, q: Array) -> Array:
        """Return by how much (N, 3) the estimate has wandered off: x, y (m) and yaw (rad).

        Where nothing but sensors of its own tells a robot where it is, these three cannot be known:
        the true place is the estimated one, turned by this yaw about the origin and moved by x, y.

        Args:
            q: (N, nq) true configurations, as a record has them.
        """
        angle = wrap(_yaw(q[:, 3:7]) - _yaw(self.estimate_q[:, 3:7]))
        moved = q[:, :2] - turn(self.estimate_q[:, :2], angle)
        return np.column_stack((moved, angle))

    def com_error(self, q: Array, com_ref: Array) -> Array:
        """Return the true CoM minus its reference (N, 3), m, the reference moved by the drift."""
        drift = self.drift(q)
        there = turn(com_ref[:, :2], drift[:, 2]) + drift[:, :2]
        return np.column_stack((self.true_com[:, :2] - there, self.true_com[:, 2] - com_ref[:, 2]))

    def velocity_error(self, v: Array) -> Array:
        """Return the estimated minus the true velocity (N, 3) of the base, base axes, m/s.

        The estimate is of the time at which the tick's torques act, some milliseconds later than
        the truth beside it: that is part of this error.
        """
        error: Array = self.estimate_v[:, :3] - v[:, :3]
        return error


SENSED: dict[str, FieldInfo] = {f.name: f.metadata["info"] for f in fields(Sensed)}
"""Every array by name, in the order in which `record.npz` holds them, as `sensed_<name>`."""


def sensed_columns(sizes: dict[str, int]) -> Columns:
    """Return empty columns for what is sensed by a robot of these sizes (nq, nv, nu)."""
    return Columns(SENSED, sizes)


def _yaw(quaternion: Array) -> Array:
    """Return the yaw (N,), rad, of unit quaternions (N, 4) xyzw."""
    x, y, z, w = quaternion.T
    angle: Array = np.arctan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z))
    return angle
