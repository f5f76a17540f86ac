"""daqp, called directly on the condensed QP."""

from __future__ import annotations

from importlib import import_module

import numpy as np

from preview_walk.errors import InvalidInput
from preview_walk.tracking.qp.condensed_backend import Found
from preview_walk.tracking.qp.condensing import NearestPoint
from preview_walk.types import Array, Foot

TOLERANCE = 1e-9
"""Violation of a constraint of length one that daqp may leave."""


class DirectDaqp:
    """daqp's dual active-set method, from no active constraint: on QPs this small the fastest.

    Raises:
        InvalidInput: the package daqp is not installed.
    """

    every_tick = False

    def __init__(self) -> None:
        require_daqp()

    def solve(
        self, qp: NearestPoint, contacts: tuple[Foot, ...], guess: Array | None
    ) -> Found | None:
        """See `Method.solve`."""
        import daqp

        count, size = qp.rows.shape
        x, _, flag, info = daqp.solve(
            np.eye(size),
            qp.gradient,
            np.ascontiguousarray(qp.rows),
            qp.high,
            qp.low,
            np.zeros(count, dtype=np.int32),
            primal_tol=TOLERANCE,
            dual_tol=TOLERANCE,
        )
        return Found(x, info["lam"], info["iterations"]) if flag == 1 else None


def require_daqp() -> None:
    """Raise `InvalidInput` where the package daqp is missing."""
    try:
        import_module("daqp")
    except ImportError:
        raise InvalidInput(
            "solver 'daqp' needs the package daqp, which is not installed; "
            "pip install 'preview-walk[daqp]' adds it.",
            "solver",
        ) from None
