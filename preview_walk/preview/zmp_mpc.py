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
from preview_walk.preview.cart_table import ComTrajectory, sampled_cart_table
from preview_walk.preview.checks import finite_vector, positive
from preview_walk.preview.half_planes import of_polygons
from preview_walk.preview.least_distance import least_distance
from preview_walk.preview.least_input import MAX_HORIZON, conditions, outputs_ahead


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
    dt = positive("dt", dt, "s")
    horizon = _horizon(positive("preview_time", preview_time, "s"), dt)
    planes = of_polygons("supports", supports)
    plant = sampled_cart_table(z_c, dt)
    # np.kron loses the type of its parts.
    a, b, c, d = (
        np.asarray(np.kron(np.eye(2), part), dtype=np.float64)
        for part in (plant.A, plant.B, plant.C, plant.D)
    )
    ahead = outputs_ahead(a, b, c, d, horizon)
    middle = np.asarray(supports[0], dtype=float).mean(axis=0)
    state = np.zeros(6)
    state[::3] = finite_vector("com", com, middle)
    rows = np.empty((len(planes.offsets), 5, 2))
    jerk = np.zeros(2)
    for k, row in enumerate(rows):
        row[:3], row[3], row[4] = state.reshape(2, 3).T, jerk, c @ state
        window = planes.window(k + 1, horizon)
        found = least_distance(*conditions(ahead.free @ state, ahead.forced, window))
        if found is None:
            raise InvalidInput(
                f"expected supports in which a jerk can keep the ZMP, got none at {k * dt:.4g} s.",
                argument="supports",
            )
        jerk = found[:2]
        state = a @ state + b @ jerk
    return ComTrajectory(dt, *(np.ascontiguousarray(rows[:, i]) for i in range(5)))


def _horizon(preview_time: float, dt: float) -> int:
    if not preview_time / dt <= MAX_HORIZON:
        raise InvalidInput(
            f"expected preview_time to be at most {MAX_HORIZON} samples of dt = {dt:g} s, got "
            f"{preview_time:g} s.",
            argument="preview_time",
        )
    return max(1, round(preview_time / dt))
