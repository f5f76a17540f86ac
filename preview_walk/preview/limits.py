"""Limits of a plant's inputs and outputs."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from preview_walk.arguments import shown
from preview_walk.errors import InvalidInput
from preview_walk.preview.checks import real_array
from preview_walk.preview.half_planes import HalfPlanes, both, of_box, of_polygons
from preview_walk.types import Array


@dataclass(frozen=True)
class Limits:
    """Limits of inputs and outputs; None where there are none.

    Attributes:
        u_min: Lower limits of the input, a number or (m,).
        u_max: Upper limits of the input, a number or (m,).
        y_min: Lower limits of the output, a number, (p,), or (M, p) for each sample of a run.
        y_max: Upper limits of the output, a number, (p,), or (M, p) for each sample of a run.
        polygons: Convex polygons (V, 2) that a plant's two outputs stay in, as a ZMP does in the
            support, one for each sample of a run; past their end the last one holds.

    """

    u_min: ArrayLike | None = None
    u_max: ArrayLike | None = None
    y_min: ArrayLike | None = None
    y_max: ArrayLike | None = None
    polygons: Sequence[ArrayLike] | None = None

    def of_outputs(self, length: int, outputs: int) -> HalfPlanes:
        """Return the limits of the outputs at each sample of a run or of a window.

        Args:
            length: M, the number of samples.
            outputs: p.

        Raises:
            InvalidInput: If a limit cannot be, y_min is above y_max, or there are polygons for a
                plant that has not two outputs.

        """
        box = of_box(*output_limits(self.y_min, self.y_max, (length, outputs)))
        if self.polygons is None:
            return box
        if outputs != 2:
            raise InvalidInput(
                f"expected polygons for a plant with two outputs only, got {outputs}.",
                argument="polygons",
            )
        return both(box, of_polygons("polygons", self.polygons).window(0, length))

    def extent(self, length: int, outputs: int) -> tuple[Array, Array]:
        """Return the least and the largest value of each output within its limits, (M, p) both.

        Args:
            length: M, the number of samples.
            outputs: p.

        """
        low, high = output_limits(self.y_min, self.y_max, (length, outputs))
        if self.polygons is not None:
            corners = [np.asarray(polygon, dtype=float) for polygon in self.polygons]
            held = np.minimum(np.arange(length), len(corners) - 1)
            low = np.maximum(low, np.array([c.min(axis=0) for c in corners])[held])
            high = np.minimum(high, np.array([c.max(axis=0) for c in corners])[held])
        return low, high


def input_limits(low: ArrayLike | None, high: ArrayLike | None, size: int) -> tuple[Array, Array]:
    """Return u_min and u_max as (size,); infinite where there are none.

    Raises:
        InvalidInput: If a shape is wrong, a limit is one that nothing meets or u_min above u_max.

    """
    return _pair("u", low, high, (size,))


def output_limits(
    low: ArrayLike | None, high: ArrayLike | None, shape: tuple[int, int]
) -> tuple[Array, Array]:
    """Return y_min and y_max as (M, p) for the samples of a run; infinite where there are none.

    Raises:
        InvalidInput: If a shape is wrong, a limit is one that nothing meets or y_min above y_max.

    """
    return _pair("y", low, high, shape)


def _pair(
    name: str, low: ArrayLike | None, high: ArrayLike | None, shape: tuple[int, ...]
) -> tuple[Array, Array]:
    sides = []
    for side, value, none in (("min", low, -np.inf), ("max", high, np.inf)):
        limit = real_array(f"{name}_{side}", none if value is None else value)
        kept = (limit != -none) & ~np.isnan(limit)  # no number is below -inf or above inf
        if limit.shape not in ((), shape[-1:], shape) or not kept.all():
            allowed = " or ".join(str(s) for s in dict.fromkeys((shape[-1:], shape)))
            raise InvalidInput(
                f"expected {name}_{side} to be a number or of shape {allowed}, each a limit that "
                f"something meets, got {shown(value)}.",
                argument=f"{name}_{side}",
            )
        sides.append(np.broadcast_to(limit, shape).copy())
    if (sides[0] > sides[1]).any():
        raise InvalidInput(
            f"expected {name}_min to be at most {name}_max, got {shown(low)} and {shown(high)}.",
            argument=f"{name}_min",
        )
    return sides[0], sides[1]
