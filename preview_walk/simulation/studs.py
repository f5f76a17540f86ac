"""Soles on a height field: small spheres that touch it where a box would not.

MuJoCo gives a box one contact for each prism of a height field that it meets, and at most fifty in
all: on a coarse field a sole then stands on a point that jumps about, and on a fine one on a part
of itself. Spheres along the sole meet one or two prisms each, however fine the field is.
"""

from __future__ import annotations

from math import ceil

import mujoco
import numpy as np

from preview_walk.robots.building.assemble import sole_name
from preview_walk.types import FEET, Array

RADIUS = 0.005
"""Of a sphere, m; its lowest point is on the sole plane."""

APART = 0.04
"""The spheres are at most so far from each other, m, and at least three along each edge."""

FIELD = 4
"""Bit of what the spheres touch: height fields, and the boxes do not."""


def add_studs(spec: mujoco.MjSpec) -> None:
    """Give the soles of a robot's spec their spheres, and their sensors the whole foot to feel."""
    sensors = {sensor.name: sensor for sensor in spec.sensors}
    for foot in FEET:
        name = sole_name(foot)
        box = spec.geom(name)
        if box is None:  # a ground without a robot on it
            continue
        body, sensor = box.parent, sensors[f"{name}_wrench"]
        sensor.objtype, sensor.objname = mujoco.mjtObj.mjOBJ_BODY, body.name
        turn = np.zeros(9)
        mujoco.mju_quat2Mat(turn, np.array(box.quat))
        for place in _places(*box.size.tolist()):
            body.add_geom(
                type=mujoco.mjtGeom.mjGEOM_SPHERE,
                size=(RADIUS, 0.0, 0.0),
                pos=np.array(box.pos) + turn.reshape(3, 3) @ place,
                mass=0.0,
                contype=0,
                conaffinity=FIELD,
                condim=3,
                friction=box.friction,
                group=4,
            )


def _places(length: float, width: float, height: float) -> list[Array]:
    """Return the centres of the spheres from that of the sole's box, by its half sizes (m)."""
    along, across = (
        np.linspace(-half, half, max(3, ceil(2.0 * half / APART) + 1)) for half in (length, width)
    )
    return [np.array((x, y, RADIUS - height)) for x in along for y in across]
