"""OSQP in every tick, and the exact method for what it does not reach in time."""

from __future__ import annotations

from typing import Any

import numpy as np

from preview_walk.tracking.qp.active_set import nearest_point
from preview_walk.tracking.qp.condensed_backend import Found
from preview_walk.tracking.qp.condensing import NearestPoint
from preview_walk.tracking.qp.osqp_workspace import OsqpWorkspace
from preview_walk.types import Array, Foot

MAX_ITERATIONS = 60
"""Iterations of OSQP after which an exact method finishes a tick; nearly all ticks need fewer."""

BURST = 15
"""Iterations of OSQP between two trials of polishing."""

SLOTS = (0, 2, 4, 6, 8, 10, 12, 16, 24, 32)
"""Numbers of joint limits for which OSQP is set up; with more the exact method is left alone."""


class WarmOsqp:
    """OSQP, set up once for each set of contacts.

    Attributes:
        set_ups: how many workspaces were made so far.
    """

    every_tick = True

    def __init__(self, max_iterations: int = MAX_ITERATIONS) -> None:
        self.set_ups = 0
        self._burst = min(BURST, max_iterations)
        self._bursts = max_iterations // self._burst
        self._workspaces: dict[tuple[tuple[Foot, ...], int], OsqpWorkspace] = {}

    def __getstate__(self) -> dict[str, Any]:
        """Leave out the workspaces: a solve starts from the multipliers that it is given."""
        return {**vars(self), "_workspaces": {}}

    def solve(
        self, qp: NearestPoint, contacts: tuple[Foot, ...], guess: Array | None
    ) -> Found | None:
        """See `Method.solve`."""
        count, size = qp.rows.shape
        workspace = self._workspaces.get((contacts, size))
        if workspace is None and size <= 6 * len(contacts) + SLOTS[-1]:
            workspace = self._set_up(contacts, count, size)
        y, iterations = guess, 0
        if workspace is not None:
            x, y, iterations, optimal = workspace.solve(qp, guess, self._bursts)
            if optimal:
                return Found(x, y, iterations)
        if y is None:
            y = np.zeros(count)
        exact = nearest_point(qp.gradient, qp.rows, qp.low, qp.high, y)
        return None if exact is None else Found(*exact, iterations, finished=True)

    def _set_up(self, contacts: tuple[Foot, ...], count: int, size: int) -> OsqpWorkspace:
        """Make all workspaces of a set of contacts that is new; return that of this size."""
        wrenches = 6 * len(contacts)
        rows = count - (size - wrenches)
        least = 0
        for slots in SLOTS:
            if not wrenches + slots:
                continue
            workspace = OsqpWorkspace(rows + slots, wrenches + slots, burst=self._burst)
            self.set_ups += 1
            for limits in range(least, slots + 1):
                self._workspaces[contacts, wrenches + limits] = workspace
            least = slots + 1
        return self._workspaces[contacts, size]
