"""Limits of a plant's inputs and outputs."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from preview_walk.errors import InvalidInput
from preview_walk.preview.checks import real_array, shown
from preview_walk.types import Array


@dataclass(frozen=True)
class Limits:
    """Limits of inputs and outputs; None where there are none.

    Attributes:
        u_min: Lower limits of the input, a number or (m,).
        u_max: Upper limits of the input, a number or (m,).
        y_min: Lower limits of the output, a number, (p,), or (M, p) for each sample of a run.
        y_max: Upper limits of the output, a number, (p,), or (M, p) for each sample of a run.

    """

    u_min: ArrayLike | None = None
    u_max: ArrayLike | None = None
    y_min: ArrayLike | None = None
    y_max: ArrayLike | None = None


def input_limits(low: ArrayLike | None, high: ArrayLike | None, size: int) -> tuple[Array, Array]:
    """Return u_min and u_max as (size,); infinite where there are none.

    Raises:
        InvalidInput: If a shape is wrong, a limit is NaN or u_min is above u_max.

    """
    return _pair("u", low, high, (size,))


def output_limits(
    low: ArrayLike | None, high: ArrayLike | None, shape: tuple[int, int]
) -> tuple[Array, Array]:
    """Return y_min and y_max as (M, p) for the samples of a run; infinite where there are none.

    Raises:
        InvalidInput: If a shape is wrong, a limit is NaN or y_min is above y_max.

    """
    return _pair("y", low, high, shape)


def _pair(
    name: str, low: ArrayLike | None, high: ArrayLike | None, shape: tuple[int, ...]
) -> tuple[Array, Array]:
    sides = []
    for side, value, none in (("min", low, -np.inf), ("max", high, np.inf)):
        limit = real_array(f"{name}_{side}", none if value is None else value)
        if limit.shape not in ((), shape[-1:], shape) or np.isnan(limit).any():
            allowed = " or ".join(str(s) for s in dict.fromkeys((shape[-1:], shape)))
            raise InvalidInput(
                f"expected {name}_{side} to be a number or of shape {allowed}, got {shown(value)}.",
                argument=f"{name}_{side}",
            )
        sides.append(np.broadcast_to(limit, shape).copy())
    if (sides[0] > sides[1]).any():
        raise InvalidInput(
            f"expected {name}_min to be at most {name}_max, got {shown(low)} and {shown(high)}.",
            argument=f"{name}_min",
        )
    return sides[0], sides[1]
