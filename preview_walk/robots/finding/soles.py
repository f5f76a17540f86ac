"""Find a sole: the flat rectangle under a foot, from the shapes of the foot's body."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

import mujoco
import numpy as np
from scipy.spatial import ConvexHull, QhullError

from preview_walk.errors import RobotError
from preview_walk.geometry.support import Sole
from preview_walk.robots.bounds import SMALLEST_SOLE
from preview_walk.robots.finding.tree import Tree, nearest_axis
from preview_walk.types import Array

LAYER = 0.004
"""Height (m) of the layer above the lowest point whose points count as touching the floor."""

EVEN = 0.0005
"""Unevenness (m) of a sole that its contact with the ground levels out."""

TILTED = np.radians(30.0)
"""Largest angle between the vertical and the normal of a foot's flat in the reference pose."""

_Geom = mujoco.mjtGeom


@dataclass(frozen=True, eq=False)
class SolePatch:
    """A sole on a body.

    Attributes:
        body: name of the body.
        position: of the sole frame's origin in the body (3,), m.
        rotation: of the sole frame in the body (3, 3).
        size: the rectangle, half sizes in m.
    """

    body: str
    position: Array = field(repr=False)
    rotation: Array = field(repr=False)
    size: Sole


def sole_axes(tree: Tree, body: int, up: Array, forward: Array) -> Array:
    """Return the sole frame's rotation (3, 3) in a body: its axes nearest to forward and up.

    Axes of the body within 25 degrees count, else the directions themselves.

    Args:
        tree: the model.
        body: the foot.
        up: unit vector (3,) in the world.
        forward: unit vector (3,) in the world.
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

    A foot that is tilted in the reference pose, so that it would stand on a point or an edge, is
    turned onto its nearest flat. All shapes rigidly fixed to the body count: the corners of boxes,
    the lowest points of round shapes, the vertices of meshes.

    Args:
        tree: the model, with its shapes.
        body: the foot.
        axes: rotation (3, 3) of the sole frame in the body.

    Raises:
        RobotError: the body has no shapes, or no flat to stand on.
    """
    points = np.array(list(_points(tree, body, axes[:, 2])))
    if not len(points):
        raise RobotError(
            f"the foot '{tree.name(body)}' has no shapes to find its sole from; "
            "expected geometry, or a description that gives the sole's size and centre"
        )
    center, half = level = _rectangle(points, axes)
    for _ in range(5):  # where round shapes touch the ground depends on the tilt
        if min(half) >= 0.5 * SMALLEST_SOLE:
            return SolePatch(tree.name(body), center, axes, Sole(*half))
        axes = _turned(axes, _flat(points, axes[:, 2]))
        points = np.array(list(_points(tree, body, axes[:, 2])))
        center, half = _rectangle(points, axes)
    length, width = (2 * side for side in level[1])
    raise RobotError(
        f"the foot '{tree.name(body)}' touches flat ground in {length:.3f} x {width:.3f} m; "
        f"expected a flat sole of at least {SMALLEST_SOLE} x {SMALLEST_SOLE} m"
    )


def rocks(tree: Tree, body: int, patch: SolePatch) -> float:
    """Return how far (m) a foot's lowest point is below the flat that its sole was found on.

    0.0 for a foot that stands on all its sole; a foot with a round shape below its flat rocks.

    Args:
        tree: the model, with its shapes.
        body: the foot.
        patch: its sole.
    """
    points = np.array(list(_points(tree, body, patch.rotation[:, 2])))
    local = points @ patch.rotation
    height = local[:, 2] - local[:, 2].min()
    for layer in np.arange(EVEN, LAYER, EVEN):
        x0, x1, y0, y1 = inscribed_rectangle(local[height < layer + 1e-9, :2])
        if x1 - x0 > patch.size.half_length and y1 - y0 > patch.size.half_width:
            return 0.0 if layer == EVEN else float(layer)
    return LAYER


def _rectangle(points: Array, axes: Array) -> tuple[Array, tuple[float, float]]:
    """Return centre (3,) and half sizes of the largest rectangle among the lowest of points."""
    local = points @ axes
    height = float(local[:, 2].min())
    x0, x1, y0, y1 = inscribed_rectangle(local[local[:, 2] < height + LAYER, :2])
    center = axes @ np.array(((x0 + x1) / 2, (y0 + y1) / 2, height))
    return np.asarray(center), ((x1 - x0) / 2, (y1 - y0) / 2)


def _flat(points: Array, up: Array) -> Array:
    """Return the upward normal (3,) of the largest lower face of points (n, 3), `up` without one.

    Faces count that are tilted by `TILTED` at most; those of nearly one normal are one.
    """
    try:
        hull = ConvexHull(points)
    except (QhullError, ValueError):  # fewer than four points, or all in one plane
        normal = np.linalg.svd(points - points.mean(axis=0))[2][2]
        normal *= np.sign(normal @ up) or 1.0
        return np.asarray(normal if normal @ up > np.cos(TILTED) else up)
    normals = -hull.equations[:, :3]
    corners = points[hull.simplices]
    sides = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    areas = 0.5 * np.linalg.norm(sides, axis=1)
    areas[normals @ up < np.cos(TILTED)] = 0.0
    if not areas.any():
        return up
    alike = normals @ normals.T > np.cos(np.radians(3.0))
    best = int((alike @ areas).argmax())
    normal = (alike[best] * areas) @ normals
    return np.asarray(normal / np.linalg.norm(normal))


def _turned(axes: Array, normal: Array) -> Array:
    """Return axes (3, 3) with z along a normal (3,) and x as near as it can be to what it was."""
    x = axes[:, 0] - normal * (normal @ axes[:, 0])
    x /= np.linalg.norm(x)
    return np.column_stack((x, np.cross(normal, x), normal))


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
    paired = _paired(mj)
    touching = [g for g in geoms if mj.geom_contype[g] or mj.geom_conaffinity[g] or g in paired]
    for geom in touching or geoms:
        turn = rotation.T @ np.array(data.geom_xmat[geom]).reshape(3, 3)
        at = rotation.T @ (np.array(data.geom_xpos[geom]) - position)
        for point in _shape_points(mj, geom, turn.T @ up):
            yield at + turn @ point


def _paired(mj: mujoco.MjModel) -> set[int]:
    """Return the geoms whose contacts with another tree of bodies are declared one by one."""
    ends = np.column_stack((mj.pair_geom1, mj.pair_geom2))
    roots = mj.body_rootid[mj.geom_bodyid[ends]]
    return set(ends[roots[:, 0] != roots[:, 1]].ravel().tolist())


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
