"""A ground as MuJoCo geoms: what the soles touch and what is seen."""

from __future__ import annotations

import copy
from math import cos, sqrt

import mujoco
import numpy as np

from preview_walk.errors import InvalidInput
from preview_walk.robots.load import spec_of
from preview_walk.robots.robot import Robot
from preview_walk.simulation.studs import add_studs
from preview_walk.terrain.ground import FlatGround, Ground
from preview_walk.terrain.height_field import HeightField
from preview_walk.terrain.slabs import Slab, SlabGround

THICKNESS = 0.5
"""Thickness (m) of the box that stands for a slab, below its face: nothing gets under it."""

COLOUR, SHADE = (0.80, 0.82, 0.84, 1.0), (0.55, 0.60, 0.66, 1.0)
"""Of slabs (r, g, b, a), in turn, so that one tread is told from the next."""


def model_on(robot: Robot, ground: Ground | None, visuals: bool) -> mujoco.MjModel:
    """Return a model of a robot on its ground, one's own to change.

    Args:
        robot: the robot, or a copy of one.
        ground: what it stands on; None is level.
        visuals: with its visual shapes.
    """
    if ground is None and not visuals:
        return copy.copy(robot.mj)
    spec = spec_of(robot, visuals)
    if ground is not None:
        add_ground(spec, ground)
    return spec.compile()


def add_ground(spec: mujoco.MjSpec, ground: Ground) -> None:
    """Add a ground to a robot's spec, whose floor it lowers or leaves.

    Args:
        spec: with a geom named "floor".
        ground: a `FlatGround`, a `SlabGround` or a `HeightField`.

    Raises:
        InvalidInput: another kind of ground.
    """
    if isinstance(ground, FlatGround):
        spec.geom("floor").pos[2] = ground.z
    elif isinstance(ground, SlabGround):
        spec.geom("floor").pos[2] = ground.floor
        for number, slab in enumerate(ground.slabs):
            _add_slab(spec, f"slab_{number}", slab, SHADE if number % 2 else COLOUR)
    elif isinstance(ground, HeightField):
        spec.geom("floor").pos[2] = ground.floor
        _add_field(spec, ground)
    else:
        raise InvalidInput(
            "ground must be a FlatGround, a SlabGround or a HeightField, as HeightField.of makes "
            f"of a function, got a {type(ground).__name__}.",
            "ground",
        )


def _add_field(spec: mujoco.MjSpec, field: HeightField) -> None:
    """Add a height field; MuJoCo's rows go along y, its columns along x."""
    heights = field.heights.T
    low, high = float(heights.min()), float(heights.max())
    half = 0.5 * field.spacing * (np.array(field.heights.shape) - 1)
    tall = max(high - low, 1e-6)
    spec.add_hfield(
        name="ground",
        nrow=heights.shape[0],
        ncol=heights.shape[1],
        size=(*half, tall, THICKNESS),
        userdata=((heights - low) / tall).astype(np.float32).ravel(),
    )
    spec.worldbody.add_geom(
        name="ground",
        type=mujoco.mjtGeom.mjGEOM_HFIELD,
        hfieldname="ground",
        pos=(field.x + half[0], field.y + half[1], low),
        rgba=COLOUR,
        contype=0,
        conaffinity=0,
    )
    add_studs(spec)


def _add_slab(
    spec: mujoco.MjSpec, name: str, slab: Slab, colour: tuple[float, float, float, float]
) -> None:
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
        rgba=colour,
        contype=2,
        conaffinity=1,
        condim=3,
    )
