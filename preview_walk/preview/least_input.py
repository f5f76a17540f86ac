"""The least inputs of a horizon that keep outputs within limits; no reference is followed.

Wieber's walk ("Trajectory free linear model predictive control for stable walking in the presence
of strong perturbations", Humanoids 2006) for any linear plant: of the inputs of N samples with

    sum_i u(i)' R u(i)    least,    normals(i) y(i) <= offsets(i),    u_min <= u(i) <= u_max

the first one is used, and at the next sample all are found anew. On two cart-tables, with support
polygons as limits, it is his walk.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from preview_walk.errors import InvalidInput
from preview_walk.preview.checks import computable
from preview_walk.preview.design import PreviewDesign
from preview_walk.preview.half_planes import HalfPlanes, of_box
from preview_walk.preview.least_distance import least_distance
from preview_walk.preview.limited import LimitedServo
from preview_walk.preview.limits import Limits
from preview_walk.preview.servo import ServoState
from preview_walk.types import Array

MAX_HORIZON = 1000
"""Longest horizon in samples: its matrices have the square of it as entries."""


class Ahead(NamedTuple):
    """Outputs free x + forced u of a horizon: free (N, p, n), forced (N, p, N, m)."""

    free: Array
    forced: Array


def outputs_ahead(a: Array, b: Array, c: Array, d: Array, horizon: int) -> Ahead:
    """Return what a state and the inputs at the samples 0 to N - 1 do to N outputs of a plant.

    The outputs are those at the samples 1 to N, or, where D is not zero, 0 to N - 1: those that
    can still be changed.
    """
    powers = [np.eye(len(a))]
    for _ in range(horizon):
        powers.append(a @ powers[-1])
    impulse, first = np.array([c @ power @ b for power in powers]), 1
    if np.any(d):
        impulse, first = np.concatenate([d[None], impulse]), 0
    forced = np.zeros((horizon, len(c), horizon, b.shape[1]))
    for i in range(horizon):
        forced[i, :, : i + 1] = impulse[i::-1].transpose(1, 0, 2)
    return Ahead(np.array([c @ power for power in powers[first : first + horizon]]), forced)


def conditions(free: Array, forced: Array, planes: HalfPlanes) -> tuple[Array, Array]:
    """Return rows (R, N m) and bounds (R,) of all inputs that keep outputs within half-planes.

    Args:
        free: (N, p) outputs without any input.
        forced: (N, p, N, m) as `outputs_ahead` has it.
        planes: Of these N samples.

    """
    used = np.isfinite(planes.offsets)
    rows = planes.normals @ forced.reshape(*free.shape, -1)
    return rows[used], (planes.offsets - planes.along(free))[used]


class LeastInputServo(LimitedServo):
    """The least input, as the design's R weighs it, that keeps the limits over N samples.

    Attributes:
        failures: Samples at which the limits contradicted each other; there no input is used.

    """

    def __init__(
        self, design: PreviewDesign, limits: Limits, *, observer_gain: ArrayLike | None = None
    ) -> None:
        """Make plant, weight R and horizon N of a design ready to run within limits.

        Args:
            design: From `preview_gains`, with N >= 1; its gains play no part.
            limits: Limits of input and output.
            observer_gain: (n, p) gain of `observed`.

        Raises:
            InvalidInput: If limits contradict each other or a shape is wrong.

        """
        super().__init__(design, limits, observer_gain=observer_gain)
        if design.horizon > MAX_HORIZON:
            raise InvalidInput(
                f"expected a design of at most {MAX_HORIZON} samples, got {design.horizon}.",
                argument="design",
            )
        plant, horizon = design.plant, design.horizon
        m = plant.B.shape[1]
        through = np.hstack([plant.D, np.zeros((len(plant.C), plant.E.shape[1]))])
        ahead = outputs_ahead(plant.A, np.hstack([plant.B, plant.E]), plant.C, through, horizon)
        self._first = 0 if np.any(plant.D) else 1
        # In u~ = L' u, R = L L', the least input is the least distance.
        with computable("design"):
            self._root = np.linalg.inv(np.linalg.cholesky(design.R)).T
        self._free = ahead.free
        self._known = ahead.forced[..., m:].reshape(horizon, len(plant.C), -1)
        self._forced = ahead.forced[..., :m] @ self._root
        held = np.eye(horizon * m).reshape(horizon, m, horizon, m) @ self._root
        sides = of_box(*(np.tile(side, (horizon, 1)) for side in (self.u_min, self.u_max)))
        self._input_rows, self._input_bounds = conditions(np.zeros((horizon, m)), held, sides)

    def _planned(self, state: ServoState, future: tuple[Array, Array], planes: HalfPlanes) -> Array:
        horizon = self.design.horizon
        free = self._free @ state.x + self._known @ future[1].ravel() + state.offset
        rows, bounds = conditions(free, self._forced, planes.window(self._first, horizon))
        found = least_distance(
            np.vstack([rows, self._input_rows]), np.concatenate([bounds, self._input_bounds])
        )
        if found is None:
            self.failures += 1
            return np.zeros(len(self.u_min))
        return np.asarray(self._root @ found[: len(self.u_min)])
