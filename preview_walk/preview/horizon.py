"""How far a servo has to see: the slow mode of its gains, and what a horizon may be."""

from __future__ import annotations

import math
import warnings

import numpy as np

from preview_walk.arguments import shown
from preview_walk.errors import InvalidInput
from preview_walk.types import Array

MIN_TIME_CONSTANTS = 2.0
"""A horizon that covers fewer time constants of the slow mode of the gains is warned of."""

MAX_HORIZON = 1_000_000
"""Longest horizon in samples: its gains alone fill 8 MB for each pair of input and output."""

_SHARE_TOLERANCE = 1e-8

_NOTHING_LEFT = 1e-18
"""An infinite horizon ends where this share of the slow mode is left, below any rounding."""


class ShortHorizonWarning(UserWarning):
    """A preview horizon that leaves out much of what the gains would still count."""


def check_horizon(value: float) -> float:
    """Return a horizon N in samples: a whole number from 0 on, or infinity.

    Raises:
        InvalidInput: If it is neither, or longer than `MAX_HORIZON`.

    """
    whole = isinstance(value, int | np.integer) and not isinstance(value, bool)
    endless = isinstance(value, float) and value == math.inf
    if not (endless or (whole and value >= 0)):
        raise InvalidInput(
            "expected the horizon N to be a whole number of samples >= 0 or math.inf, got "
            f"{shown(value)}.",
            argument="N",
        )
    if whole and value > MAX_HORIZON:
        raise InvalidInput(
            f"expected the horizon N to be at most {MAX_HORIZON} samples, got {value}.",
            argument="N",
        )
    return value


def slow_mode(closed: Array, left: Array, columns: Array) -> float:
    """Return the largest modulus among the modes in the gains left (A_c')^l columns.

    Args:
        closed: (N, N) A_c.
        left: (m, N) what reads the gains.
        columns: (N, c) what starts them.

    """
    values, vectors = np.linalg.eig(closed.T)
    try:
        shares = np.abs(np.linalg.solve(vectors, columns)).max(axis=1)
    except np.linalg.LinAlgError:  # defective: count every mode
        return float(np.abs(values).max())
    shares *= np.abs(left @ vectors).max(axis=0)
    present = shares > _SHARE_TOLERANCE * np.abs(left @ columns).max()
    return float(np.abs(values[present]).max(initial=0.0))


def samples(horizon: float, slow: float, order: int) -> int:
    """Return the samples of a horizon; an infinite one ends where rounding hides the rest.

    Raises:
        InvalidInput: If that is more than `MAX_HORIZON`.

    """
    if horizon != math.inf:
        return int(horizon)
    if slow <= 0.0:
        return order
    count = math.ceil(math.log(_NOTHING_LEFT) / math.log(slow)) if slow < 1.0 else MAX_HORIZON + 1
    if count > MAX_HORIZON:
        raise InvalidInput(
            f"expected a loop whose gains end within {MAX_HORIZON} samples for an infinite "
            f"horizon, got a slow mode of {slow:.9f}.",
            argument="N",
        )
    return max(count, order)


def warn_if_short(horizon: int, slow: float, dt: float, stacklevel: int) -> None:
    """Warn of a horizon shorter than `MIN_TIME_CONSTANTS`; none at all (0) is meant."""
    constant = -1.0 / math.log(slow) if 0.0 < slow < 1.0 else 0.0
    shortest = math.ceil(MIN_TIME_CONSTANTS * constant)
    if 0 < horizon < shortest:
        warnings.warn(
            f"a preview horizon of {horizon} samples ({horizon * dt:.4g} s) is shorter than "
            f"{shortest} samples ({shortest * dt:.4g} s), {MIN_TIME_CONSTANTS:g} time constants of "
            f"the closed loop's slow mode ({constant * dt:.3g} s).",
            ShortHorizonWarning,
            stacklevel=stacklevel + 1,
        )
