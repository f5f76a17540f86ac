"""Wieber's walk without a trajectory: the least jerk that keeps the ZMP within the support.

At each sample the jerks of a horizon are found that minimise

    sum_i |c'''(i)|^2    subject to    ZMP(i) in the support polygon of sample i,

and the first one is used (Wieber, "Trajectory free linear model predictive control for stable
walking in the presence of strong perturbations", Humanoids 2006). No reference is
followed: the polygons alone say where the ZMP may be.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from preview_walk.errors import InvalidInput
from preview_walk.preview.cart_table import ComTrajectory, cart_table
from preview_walk.preview.checks import finite_vector, real_array, require_positive, shown
from preview_walk.preview.least_distance import least_distance
from preview_walk.types import Array


def half_planes(polygon: ArrayLike) -> tuple[Array, Array]:
    """Return (V, 2) outward unit normals and (V,) offsets (m) of a convex polygon's sides.

    Args:
        polygon: (V, 2) vertices (m), V >= 3, in order, either way round.

    Raises:
        InvalidInput: If it is not a convex polygon with an inside.

    """
    vertices = real_array("polygon", polygon)
    flat = vertices.ndim == 2 and vertices.shape[1] == 2 and len(vertices) >= 3
    if not (flat and np.isfinite(vertices).all()):
        raise InvalidInput(
            f"expected a polygon of shape (V, 2) with V >= 3, finite, got shape {vertices.shape}.",
            argument="polygon",
        )
    edges = np.roll(vertices, -1, axis=0) - vertices
    following = np.roll(edges, -1, axis=0)
    turns = edges[:, 0] * following[:, 1] - edges[:, 1] * following[:, 0]
    lengths = np.linalg.norm(edges, axis=1)
    if not (lengths > 0.0).all() or not ((turns > 0.0).all() or (turns < 0.0).all()):
        raise InvalidInput(
            "expected a convex polygon whose vertices are corners in order, got one that is not.",
            argument="polygon",
        )
    return sides(vertices if turns[0] > 0.0 else vertices[::-1])


def sides(polygon: Array) -> tuple[Array, Array]:
    """Return (V, 2) outward unit normals and (V,) offsets (m) of a polygon, counter-clockwise."""
    edges = np.roll(polygon, -1, axis=0) - polygon
    lengths = np.hypot(edges[:, 0], edges[:, 1])
    normals = np.column_stack([edges[:, 1], -edges[:, 0]]) / lengths[:, None]
    return normals, np.einsum("vi,vi->v", normals, polygon)


def zmp_mpc(
    supports: Sequence[ArrayLike],
    z_c: float,
    dt: float,
    preview_time: float = 1.6,
    *,
    com: ArrayLike | None = None,
) -> ComTrajectory:
    """Return the CoM and ZMP of a walk whose ZMP stays within the support polygons.

    Args:
        supports: M polygons (V, 2) of vertices (m): the one of sample k is where the ZMP may be at
            the time k dt; the last one holds past the end.
        z_c: Height of the CoM above the ground (m).
        dt: Sampling time (s); Wieber's is 0.1 s.
        preview_time: Horizon (s), rounded to a whole number of samples.
        com: (2,) where the CoM rests at first (m); the middle of the first polygon when None.

    Returns:
        M samples of both axes.

    Raises:
        InvalidInput: If a number cannot be, a polygon is not convex or no jerk keeps the ZMP in
            the polygons.

    """
    require_positive("dt", dt, "s")
    require_positive("preview_time", preview_time, "s")
    horizon = _horizon(preview_time, dt)
    try:
        polygons = list(supports)
    except TypeError:
        raise InvalidInput(
            f"expected supports to be polygons, one for each sample, got {shown(supports)}.",
            argument="supports",
        ) from None
    planes = [half_planes(polygon) for polygon in polygons]
    if not planes:
        raise InvalidInput("expected at least one support polygon, got none.", argument="supports")
    plant = cart_table(z_c, dt)
    a, b, c = plant.A, plant.B, plant.C
    free, forced = zmp_ahead(a, b, c, horizon)
    state = np.zeros((3, 2))
    state[0] = finite_vector("com", com, np.asarray(polygons[0], dtype=float).mean(axis=0))
    rows = np.empty((len(planes), 5, 2))
    jerk = np.zeros(2)
    for k in range(len(planes)):
        rows[k, :3], rows[k, 3], rows[k, 4] = state, jerk, c[0] @ state
        window = [planes[min(k + i, len(planes) - 1)] for i in range(1, horizon + 1)]
        found = _least_jerk(free @ state, forced, window)
        if found is None:
            raise InvalidInput(
                f"expected supports in which a jerk can keep the ZMP, got none at {k * dt:.4g} s.",
                argument="supports",
            )
        jerk = found
        state = a @ state + b @ jerk[None]
    return ComTrajectory(dt, *(np.ascontiguousarray(rows[:, i]) for i in range(5)))


def _horizon(preview_time: float, dt: float) -> int:
    most = 1000
    if not preview_time / dt <= most:
        raise InvalidInput(
            f"expected preview_time to be at most {most} samples of dt = {dt:g} s, got "
            f"{preview_time:g} s.",
            argument="preview_time",
        )
    return max(1, round(preview_time / dt))


def zmp_ahead(a: Array, b: Array, c: Array, horizon: int) -> tuple[Array, Array]:
    """Return P_x (N, 3) and P_u (N, N) of the ZMP at samples 1 to N, P_x x + P_u jerks."""
    free, forced = np.empty((horizon, 3)), np.zeros((horizon, horizon))
    power = np.eye(3)
    impulse = []
    for i in range(horizon):
        impulse.append((c @ power @ b).item())
        power = a @ power
        free[i] = c @ power
        forced[i, : i + 1] = impulse[::-1]
    return free, forced


def _least_jerk(free: Array, forced: Array, window: list[tuple[Array, Array]]) -> Array | None:
    """Return the first jerk (2,) of the least that keep the ZMP within the window's half-planes."""
    rows, bounds = [], []
    for i, (normals, offsets) in enumerate(window):
        rows.append(np.hstack([normals[:, :1] * forced[i], normals[:, 1:] * forced[i]]))
        bounds.append(offsets - normals @ free[i])
    found = least_distance(np.vstack(rows), np.concatenate(bounds))
    return None if found is None else found.reshape(2, -1)[:, 0]
