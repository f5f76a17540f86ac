"""Types shared by every room."""

from __future__ import annotations

from typing import Literal, get_args

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
"""A float64 array; shapes and units stand in the docstring that names it."""

Foot = Literal["left", "right"]
"""Which foot."""

FEET: tuple[Foot, Foot] = get_args(Foot)
"""Both feet, in the order used by every array that has one row per foot."""

DOUBLE_SUPPORT, LEFT_SUPPORT, RIGHT_SUPPORT = 0, 1, 2
"""Support phase codes, as `phase` and `phase_ref` of a record hold them."""


def other(foot: Foot) -> Foot:
    """Return the opposite foot."""
    return "right" if foot == "left" else "left"
