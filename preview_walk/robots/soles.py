"""Find a sole: the flat rectangle under a foot, from the shapes of the foot's body."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import mujoco
import numpy as np
from scipy.spatial import ConvexHull, QhullError

from preview_walk.errors import RobotError
from preview_walk.robots.tree import Tree, nearest_axis
from preview_walk.types import Array

LAYER = 0.004
"""Height (m) of the layer above the lowest point whose points count as touching the floor."""

SMALLEST = 0.01
"""Smallest length and width (m) that a sole may have."""

_Geom = mujoco.mjtGeom


@dataclass(frozen=True, eq=False)
class SolePatch:
    """A sole on a body: the sole frame's position (3,) and rotation (3, 3) there, half size (m)."""

    body: str
    position: Array
    rotation: Array
    half_length: float
    half_width: float


def sole_axes(tree: Tree, body: int, up: Array, forward: Array) -> Array:
    """Return the sole frame's rotation (3, 3) in a body: its axes nearest to forward and up.

    Axes of the body within 25 degrees count, else the directions themselves; `up` and `forward`
    are in the world.
    """
    rotation = tree.rotation(body)
    z = nearest_axis(up, rotation, np.radians(25))
    x = forward - z * (z @ forward)
    x = nearest_axis(x / np.linalg.norm(x), rotation, np.radians(25))
    x = x - z * (z @ x)
    x /= np.linalg.norm(x)
    return np.asarray(rotation.T @ np.column_stack((x, np.cross(z, x), z)))


def find_sole(tree: Tree, body: int, axes: Array) -> SolePatch:
    """Return the sole under a body: the largest rectangle inside what can touch flat ground.

    `axes` (3, 3) is the sole frame's rotation in the body. All shapes rigidly fixed to the body
    count: the corners of boxes, the lowest points of round shapes, the vertices of meshes.

    Raises `RobotError` where the body has no shapes or stands on a point or an edge.
    """
    points = np.array(list(_points(tree, body, axes[:, 2])))
    if not len(points):
        raise RobotError(
            f"the foot '{tree.name(body)}' has no shapes to find its sole from; "
            "expected geometry, or a description that gives the sole's size and centre"
        )
    local = points @ axes
    height = float(local[:, 2].min())
    low = local[local[:, 2] < height + LAYER, :2]
    x0, x1, y0, y1 = inscribed_rectangle(low)
    if min(x1 - x0, y1 - y0) < SMALLEST:
        raise RobotError(
            f"the foot '{tree.name(body)}' touches flat ground in {x1 - x0:.3f} x "
            f"{y1 - y0:.3f} m; expected a flat sole of at least {SMALLEST} x {SMALLEST} m"
        )
    center = axes @ np.array(((x0 + x1) / 2, (y0 + y1) / 2, height))
    return SolePatch(tree.name(body), center, axes, (x1 - x0) / 2, (y1 - y0) / 2)


def inscribed_rectangle(points: Array) -> tuple[float, float, float, float]:
    """Return x0, x1, y0, y1 of the largest upright rectangle inside the hull of points (n, 2).

    Exact where the rectangle's ends lie at hull vertices, else to a hundredth of the length.
    """
    try:
        hull = points[ConvexHull(points).vertices]
    except (QhullError, ValueError):  # a point or a line
        low, high = points.min(axis=0), points.max(axis=0)
        return float(low[0]), float(high[0]), float(low[1]), float(high[1])
    start, stop = int(hull[:, 0].argmin()), int(hull[:, 0].argmax())
    ring = np.roll(hull, -start, axis=0)
    turn = (stop - start) % len(hull)
    lower, upper = ring[: turn + 1], np.vstack((ring[turn:], ring[:1]))[::-1]
    x = np.unique(np.concatenate((hull[:, 0], np.linspace(hull[start, 0], hull[stop, 0], 101))))
    floor, roof = -_roof(x, lower * (1.0, -1.0)), _roof(x, upper)
    height = np.minimum(roof[:, None], roof) - np.maximum(floor[:, None], floor)
    area = (x - x[:, None]) * np.maximum(height, 0.0)
    i, j = np.unravel_index(int(area.argmax()), area.shape)
    y0, y1 = max(floor[i], floor[j]), min(roof[i], roof[j])
    return float(x[i]), float(x[j]), float(y0), float(y1)


def _roof(x: Array, chain: Array) -> Array:
    """Return the height (n,) at x (n,) of the upper chain (m, 2) of a hull."""
    knots = np.unique(chain[:, 0])
    heights = np.array([chain[chain[:, 0] == knot, 1].max() for knot in knots])
    return np.asarray(np.interp(x, knots, heights))


def _points(tree: Tree, body: int, up: Array) -> Iterator[Array]:
    """Yield the points (3,), in a body's axes, that its shapes can touch flat ground with."""
    mj, data = tree.mj, tree.data
    rotation, position = tree.rotation(body), tree.position(body)
    part = set(tree.rigid_part(body))
    geoms = [g for g in range(mj.ngeom) if int(mj.geom_bodyid[g]) in part]
    touching = [g for g in geoms if mj.geom_contype[g] or mj.geom_conaffinity[g]]
    for geom in touching or geoms:
        turn = rotation.T @ np.array(data.geom_xmat[geom]).reshape(3, 3)
        at = rotation.T @ (np.array(data.geom_xpos[geom]) - position)
        for point in _shape_points(mj, geom, turn.T @ up):
            yield at + turn @ point


def _shape_points(mj: mujoco.MjModel, geom: int, up: Array) -> Array:
    """Return the points (n, 3) of a geom, in its axes, that can touch ground whose normal is up."""
    kind, size = int(mj.geom_type[geom]), np.array(mj.geom_size[geom])
    if kind == _Geom.mjGEOM_MESH:
        mesh = int(mj.geom_dataid[geom])
        first = int(mj.mesh_vertadr[mesh])
        return np.array(mj.mesh_vert[first : first + int(mj.mesh_vertnum[mesh])], np.float64)
    signs = np.array(np.meshgrid((-1, 1), (-1, 1), (-1, 1))).reshape(3, 8).T
    if kind == _Geom.mjGEOM_BOX:
        return np.asarray(signs * size)
    if kind == _Geom.mjGEOM_SPHERE:
        return np.asarray(-size[0] * up[None])
    if kind == _Geom.mjGEOM_ELLIPSOID:
        return np.asarray(-((size**2 * up) / np.linalg.norm(size * up))[None])
    ends = np.array(((0.0, 0.0, -size[1]), (0.0, 0.0, size[1])))
    if kind == _Geom.mjGEOM_CAPSULE:
        return np.asarray(ends - size[0] * up)
    if kind == _Geom.mjGEOM_CYLINDER:
        angle = np.linspace(0.0, 2 * np.pi, 32, endpoint=False)
        rim = size[0] * np.column_stack((np.cos(angle), np.sin(angle), np.zeros(32)))
        return np.vstack((rim + ends[0], rim + ends[1]))
    return np.empty((0, 3))
