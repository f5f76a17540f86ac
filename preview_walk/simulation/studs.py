"""Soles on a height field: small spheres, each on the plane of the ground that is under it.

MuJoCo's own contacts with height fields will not do under a sole. A box gets one for each prism of
the field that it meets, and at most fifty in all; a sphere meets the walls between the prisms too,
is pushed aside by them, and held down once it is below them. So the spheres along a sole touch a
plane each, and the planes follow the spheres over the ground: what a sphere feels is the height and
the normal of the triangle below its centre.
"""

from __future__ import annotations

from math import ceil

import mujoco
import numpy as np

from preview_walk.robots.building.assemble import sole_name
from preview_walk.terrain.height_field import HeightField
from preview_walk.types import FEET, Array

RADIUS = 0.005
"""Of a sphere, m; its lowest point is on the sole plane."""

APART = 0.04
"""The spheres are at most so far from each other, m, and at least three along each edge."""

STUD, PLANE = "stud", "ground_under"
"""How the names of the spheres and of their planes begin."""

UNSEEN = 5
"""Group of geoms that no viewer shows."""


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
        for number, place in enumerate(_places(*box.size.tolist())):
            stud, plane = f"{STUD}_{foot}_{number}", f"{PLANE}_{foot}_{number}"
            body.add_geom(
                name=stud,
                type=mujoco.mjtGeom.mjGEOM_SPHERE,
                size=(RADIUS, 0.0, 0.0),
                pos=np.array(box.pos) + turn.reshape(3, 3) @ place,
                mass=0.0,
                contype=0,
                conaffinity=0,
                group=4,
            )
            spec.worldbody.add_geom(
                name=plane,
                type=mujoco.mjtGeom.mjGEOM_PLANE,
                size=(0.01, 0.01, 0.01),
                rgba=(0.0, 0.0, 0.0, 0.0),
                contype=0,
                conaffinity=0,
                group=UNSEEN,
            )
            spec.add_pair(name=stud, geomname1=stud, geomname2=plane, condim=3)


class Studs:
    """The planes under the spheres of a model, laid on the ground step by step."""

    def __init__(self, model: mujoco.MjModel, ground: HeightField) -> None:
        """Look for the spheres of a model that `add_studs` made; it is changed at every step."""
        names = [model.geom(geom).name for geom in range(model.ngeom)]
        self._studs = [geom for geom, name in enumerate(names) if name.startswith(STUD)]
        self._planes = [geom for geom, name in enumerate(names) if name.startswith(PLANE)]
        self._model, self._ground = model, ground
        # They are where the model says, not where the world's frame is.
        model.geom_sameframe[self._planes] = 0
        # A pair has numbers of its own in place of its geoms'.
        model.pair_friction[:, :2] = model.geom_friction[self._studs, :1]
        model.pair_solref[:] = model.geom_solref[self._studs]
        model.pair_solimp[:] = model.geom_solimp[self._studs]
        self._quaternion = np.zeros((len(self._planes), 4))

    def follow(self, data: mujoco.MjData) -> None:
        """Lay each plane on the ground under its sphere, where that is now."""
        model, places = self._model, data.geom_xpos[self._studs]
        height, ahead, left = self._ground.planes(places[:, 0], places[:, 1])
        places[:, 2] = height
        model.geom_pos[self._planes] = places
        # The shortest turn of (0, 0, 1) to the normal, (-ahead, -left, 1) over its length.
        turn = self._quaternion
        turn[:, 0] = 1.0 + np.sqrt(1.0 + ahead**2 + left**2)
        turn[:, 1], turn[:, 2] = left, -ahead
        turn /= np.sqrt((turn**2).sum(axis=1, keepdims=True))
        model.geom_quat[self._planes] = turn


def _places(length: float, width: float, height: float) -> list[Array]:
    """Return the centres of the spheres from that of the sole's box, by its half sizes (m)."""
    along, across = (
        np.linspace(-half, half, max(3, ceil(2.0 * half / APART) + 1)) for half in (length, width)
    )
    return [np.array((x, y, RADIUS - height)) for x in along for y in across]
