"""A ground as MuJoCo geoms: what the soles touch and what is seen."""

from __future__ import annotations

from math import cos, sqrt

import mujoco
import numpy as np

from preview_walk.errors import InvalidInput
from preview_walk.terrain.ground import FlatGround, Ground
from preview_walk.terrain.slabs import Slab, SlabGround

THICKNESS = 0.5
"""Thickness (m) of the box that stands for a slab, below its face: nothing gets under it."""

COLOUR = (0.76, 0.80, 0.84, 1.0)
"""Of slabs (r, g, b, a)."""


def add_ground(spec: mujoco.MjSpec, ground: Ground) -> None:
    """Add a ground to a robot's spec, whose floor it lowers or leaves.

    Args:
        spec: with a geom named "floor".
        ground: a `FlatGround` or a `SlabGround`.

    Raises:
        InvalidInput: another kind of ground.
    """
    if isinstance(ground, FlatGround):
        spec.geom("floor").pos[2] = ground.z
    elif isinstance(ground, SlabGround):
        spec.geom("floor").pos[2] = ground.floor
        for number, slab in enumerate(ground.slabs):
            _add_slab(spec, f"slab_{number}", slab)
    else:
        raise InvalidInput(
            f"ground must be a FlatGround or a SlabGround, got a {type(ground).__name__}.", "ground"
        )


def _add_slab(spec: mujoco.MjSpec, name: str, slab: Slab) -> None:
    """Add a box whose upper face is the slab."""
    pose = slab.pose
    # The face's own extents: the slab's are those of its picture on the level.
    length = slab.half_length / cos(slab.pitch)
    width = slab.half_width / sqrt(1.0 - float(pose[2, 1]) ** 2)
    quat = np.zeros(4)
    mujoco.mju_mat2Quat(quat, pose[:3, :3].reshape(-1))
    spec.worldbody.add_geom(
        name=name,
        type=mujoco.mjtGeom.mjGEOM_BOX,
        size=(length, width, 0.5 * THICKNESS),
        pos=pose[:3, 3] - 0.5 * THICKNESS * pose[:3, 2],
        quat=quat,
        rgba=COLOUR,
        contype=2,
        conaffinity=1,
        condim=3,
    )
