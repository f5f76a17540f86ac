"""The ground of a scene that somebody else made: its fixed shapes that the feet can touch."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass

import mujoco
import numpy as np
from numpy.typing import ArrayLike

from preview_walk.errors import InvalidInput, RobotError
from preview_walk.geometry.poses import rpy_of
from preview_walk.robots.finding.tree import Tree
from preview_walk.terrain.ground import FlatGround, Ground
from preview_walk.terrain.height_field import HeightField
from preview_walk.terrain.slabs import DEPTH, STEEPEST, Slab, SlabGround
from preview_walk.types import FEET, Array, Foot

SAMPLED = 0.02
"""Meshes and round shapes are looked at by rays so far (m) apart."""

MOST_RAYS = 1000
"""But by at most so many along an axis."""

BESIDE = 10.0
"""Where no ray meets a shape it is taken to be so far (m) below its lowest point: another is up."""

LEVEL = 1e-4
"""A plane tilted by less (rad) is level."""

ENDLESS = 1e3
"""A plane without end is taken to reach so far (m)."""

_PLANE, _BOX = int(mujoco.mjtGeom.mjGEOM_PLANE), int(mujoco.mjtGeom.mjGEOM_BOX)
_MESH, _HFIELD = int(mujoco.mjtGeom.mjGEOM_MESH), int(mujoco.mjtGeom.mjGEOM_HFIELD)
_DOWN = np.array((0.0, 0.0, -1.0))


@dataclass(frozen=True, eq=False)
class SceneGround:
    """The highest of planes, boxes and other shapes at every place.

    Attributes:
        slabs: planes, and the upper faces of boxes.
        fields: meshes, height fields and round shapes as rays found them.
    """

    slabs: SlabGround
    fields: tuple[HeightField, ...]

    def __repr__(self) -> str:
        return f"SceneGround({self.slabs!r}, {len(self.fields)} fields)"

    def height(self, x: ArrayLike, y: ArrayLike) -> Array:
        """Return the height (m) at x and y (world, m); see `Ground`."""
        heights = self.slabs.height(x, y)
        for field in self.fields:
            heights = np.maximum(heights, field.height(x, y))
        return heights

    def normal(self, x: float, y: float) -> Array:
        """Return the unit normal (3,) at x, y (world, m)."""
        parts: list[SlabGround | HeightField] = [self.slabs, *self.fields]
        return max(parts, key=lambda part: float(part.height(x, y))).normal(x, y)


def scene_ground(tree: Tree, feet: dict[int, Foot]) -> tuple[Ground, float]:
    """Return the ground of a scene and the least friction between it and the feet.

    Args:
        tree: the scene.
        feet: which foot each geom (id) of the feet belongs to.

    Raises:
        RobotError: no fixed shape can be touched by both feet.
    """
    found = {}
    for geom in range(tree.mj.ngeom):
        if tree.mj.body_weldid[tree.mj.geom_bodyid[geom]] == 0 and _faces_up(tree, geom):
            friction = _touching(tree.mj, geom, feet)
            if {feet[touched] for touched in friction} == set(FEET):
                found[geom] = min(friction.values())
    if not found:
        raise RobotError("the model has no floor: expected a fixed shape that both feet can touch")
    slabs = {geom: _slab(tree, geom) for geom in found}
    flat = [slab for slab in slabs.values() if slab is not None]
    least = min(found.values())
    alone = int(tree.mj.geom_type[next(iter(found))]) if len(found) == 1 else -1
    if alone == _PLANE and max(abs(flat[0].pitch), abs(flat[0].roll)) < LEVEL:
        return FlatGround(flat[0].z), least
    fields = tuple(_field(tree, geom) for geom, slab in slabs.items() if slab is None)
    lows = [slab.z for slab in flat] + [float(field.heights.max()) for field in fields]
    return SceneGround(SlabGround(tuple(flat), min(lows) - DEPTH), fields), least


def _faces_up(tree: Tree, geom: int) -> bool:
    """Return whether a shape can be stood on: not a plane that is a wall or a ceiling."""
    return int(tree.mj.geom_type[geom]) != _PLANE or _slab(tree, geom) is not None


def _touching(mj: mujoco.MjModel, ground: int, feet: Collection[int]) -> dict[int, float]:
    """Return the friction between a geom and those geoms of the feet that can touch it."""
    kinds, answers = mj.geom_contype, mj.geom_conaffinity
    slide = mj.geom_friction[:, 0]
    friction = {
        geom: float(max(slide[ground], slide[geom]))
        for geom in feet
        if kinds[ground] & answers[geom] or kinds[geom] & answers[ground]
    }
    for pair in range(mj.npair):  # contacts declared one by one
        ends = {int(mj.pair_geom1[pair]), int(mj.pair_geom2[pair])}
        for geom in ends & set(feet):
            if ground in ends:
                friction[geom] = float(mj.pair_friction[pair, 0])
    return friction


def _slab(tree: Tree, geom: int) -> Slab | None:
    """Return a plane or the upper face of a box as a slab; None for other shapes and steep ones."""
    kind, size = int(tree.mj.geom_type[geom]), tree.mj.geom_size[geom]
    if kind not in (_PLANE, _BOX):
        return None
    pose = np.eye(4)
    pose[:3, :3] = tree.data.geom_xmat[geom].reshape(3, 3)
    pose[:3, 3] = tree.data.geom_xpos[geom]
    half = [float(s) if s > 0.0 else ENDLESS for s in size[:2]]
    if kind == _BOX:
        up = int(np.abs(pose[2, :3]).argmax())
        sign = 1.0 if pose[2, up] > 0.0 else -1.0
        pose[:3, 3] += sign * size[up] * pose[:3, up]
        ahead = (up + 1) % 3
        half = [float(size[ahead]), float(size[(up + 2) % 3])]
        axes = pose[:3, :3].copy()
        # Ahead, its left and up, turned about by a half where the face that is up is the under one.
        pose[:3, 0] = axes[:, ahead]
        pose[:3, 1] = sign * axes[:, (up + 2) % 3]
        pose[:3, 2] = sign * axes[:, up]
    roll, pitch, yaw = rpy_of(pose)
    if max(abs(roll), abs(pitch)) > STEEPEST or pose[2, 2] <= 0.0:
        return None
    # A slab's extents are those of its picture on the level, along its heading and beside it.
    length = half[0] * float(np.hypot(*pose[:2, 0]))
    width = half[1] * float(np.hypot(*pose[:2, 1]))
    x, y, z = pose[:3, 3].tolist()
    return Slab(x, y, z, length, width, yaw, pitch, roll)


def _field(tree: Tree, geom: int) -> HeightField:
    """Return the upper side of a shape, as rays from above find it."""
    mj, data = tree.mj, tree.data
    centre, turn = data.geom_xpos[geom], data.geom_xmat[geom].reshape(3, 3)
    middle, half = mj.geom_aabb[geom].reshape(2, 3)
    centre = centre + turn @ middle
    half = np.minimum(np.abs(turn) @ half, ENDLESS)
    low, high = float(centre[2] - half[2]), float(centre[2] + half[2])
    spacing = max(SAMPLED, float(2.0 * half[:2].max()) / MOST_RAYS)
    if int(mj.geom_type[geom]) == _HFIELD:
        field = int(mj.geom_dataid[geom])
        cells = np.array((mj.hfield_ncol[field], mj.hfield_nrow[field])) - 1
        spacing = float((2.0 * half[:2] / cells).min())
    counts = [max(2, round(2.0 * side / spacing) + 1) for side in half[:2].tolist()]
    x = centre[0] - half[0] + spacing * np.arange(counts[0])
    y = centre[1] - half[1] + spacing * np.arange(counts[1])
    heights = np.full((len(x), len(y)), low - BESIDE)
    inset = 1e-6
    for i, px in enumerate(x.clip(centre[0] - half[0] + inset, centre[0] + half[0] - inset)):
        for j, py in enumerate(y.clip(centre[1] - half[1] + inset, centre[1] + half[1] - inset)):
            distance = _ray(tree, geom, np.array((px, py, high + 1.0)))
            if distance >= 0.0:
                heights[i, j] = high + 1.0 - distance
    try:
        return HeightField(heights, spacing, float(x[0]), float(y[0]))
    except InvalidInput as error:
        raise RobotError(f"the ground '{mj.geom(geom).name}' cannot be used: {error}") from None


def _ray(tree: Tree, geom: int, above: Array) -> float:
    """Return how far (m) below a point a shape is; -1 where it is not."""
    mj, data, kind = tree.mj, tree.data, int(tree.mj.geom_type[geom])
    if kind == _MESH:
        return float(mujoco.mj_rayMesh(mj, data, geom, above, _DOWN))
    if kind == _HFIELD:
        return float(mujoco.mj_rayHfield(mj, data, geom, above, _DOWN))
    where, turn = data.geom_xpos[geom], data.geom_xmat[geom]
    return float(mujoco.mju_rayGeom(where, turn, mj.geom_size[geom], above, _DOWN, kind))
