"""The force sensor under each sole: MuJoCo's net contact wrench, as a six-axis sensor reads it."""

from __future__ import annotations

import mujoco
import numpy as np

from preview_walk.types import Array

_FIELD = mujoco.mjtConDataField
_FIELDS = (_FIELD.mjCONDATA_FORCE, _FIELD.mjCONDATA_TORQUE, _FIELD.mjCONDATA_POS)
_NET_FORCE = 3  # one slot: the sum of all contacts' wrenches, in world axes


def add_wrench_sensor(spec: mujoco.MjSpec, geom: str) -> None:
    """Add to a spec the sensor of the net wrench between a geom and whatever it touches."""
    sensor = spec.add_sensor(
        name=f"{geom}_wrench",
        type=mujoco.mjtSensor.mjSENS_CONTACT,
        objtype=mujoco.mjtObj.mjOBJ_GEOM,
        objname=geom,
    )
    sensor.intprm[:3] = (sum(1 << int(field) for field in _FIELDS), _NET_FORCE, 1)


class WrenchSensor:
    """Reads the wrench on a sole in a running simulation."""

    def __init__(self, model: mujoco.MjModel, geom: str) -> None:
        at = int(model.sensor(f"{geom}_wrench").adr[0])
        self._span = slice(at, at + 9)

    def read(self, data: mujoco.MjData, origin: Array, wrench: Array) -> None:
        """Write [force; moment about `origin`] on the robot, world axes, N and N·m, to `wrench`."""
        fx, fy, fz, mx, my, mz, px, py, pz = data.sensordata[self._span].tolist()
        ox, oy, oz = origin.tolist()
        px, py, pz = px - ox, py - oy, pz - oz
        # MuJoCo reports what the geom does to the ground; the robot feels the opposite.
        wrench[:] = (
            -fx,
            -fy,
            -fz,
            -mx - (py * fz - pz * fy),
            -my - (pz * fx - px * fz),
            -mz - (px * fy - py * fx),
        )


def zmp(wrenches: tuple[Array, Array], origins: tuple[Array, Array], height: float) -> Array:
    """Return the ZMP (2,), world, m, of the wrenches under two soles.

    Vukobratovic's point: where the moment of all contact forces has no horizontal part. NaN where
    nothing pushes up.

    Args:
        wrenches: (6,) each, ground on robot, world axes, N, N·m.
        origins: (3,) each, where the wrenches' moments are taken, m.
        height: of the level on which the point lies, m.
    """
    lift = mx = my = 0.0
    for wrench, origin in zip(wrenches, origins, strict=True):
        fx, fy, fz, tx, ty, _ = wrench.tolist()
        x, y, z = origin.tolist()
        z -= height
        lift += fz
        mx += tx + y * fz - z * fy
        my += ty + z * fx - x * fz
    return np.array((-my / lift, mx / lift)) if lift > 1.0 else np.full(2, np.nan)
