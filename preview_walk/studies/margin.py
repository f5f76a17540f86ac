"""The largest value of a factor that a case survives: a bisection for each cell."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import inf

import numpy as np

from preview_walk.arguments import count_of, finite_number, instance_of, positive_number
from preview_walk.errors import InvalidInput

STRIDES = 10
"""The search goes up in so many strides, until one is not survived."""


@dataclass(frozen=True)
class Margin:
    """What is looked for, and how closely.

    Attributes:
        factor: the argument of the study's function that is made larger.
        low: a value that is taken as survived.
        high: the largest value that is tried.
        precision: how close the largest survived value and the smallest fatal one are at the end.
        smaller: how many smaller values are tried then, so that no lucky island counts.

    Raises:
        InvalidInput: a value that cannot be, or `high` is not above `low`.
    """

    factor: str
    low: float
    high: float
    precision: float
    smaller: int = 0

    def __post_init__(self) -> None:
        """Check the values."""
        instance_of(self.factor, str, "factor")
        finite_number(self.low, "low", "")
        count_of(self.smaller, "smaller")
        positive_number(self.precision, "precision")
        if finite_number(self.high, "high", "") <= self.low:
            raise InvalidInput(
                f"high must be above low, {self.low:g}, got {self.high:g}.", argument="high"
            )


@dataclass(frozen=True)
class Found:
    """What a bisection came to.

    Attributes:
        margin: the largest value up to which everything tried was survived; `low` where nothing
            was.
        fatal: the smallest value that was not survived; inf where all were.
        islands: how many values above the smallest fatal one were survived.
        tried: every value tried and whether it was survived, in order.
    """

    margin: float
    fatal: float
    islands: int
    tried: tuple[tuple[float, bool], ...]


def largest(margin: Margin, survives: Callable[[float], bool]) -> Found:
    """Return the largest value that is survived.

    The search goes up from below in strides, for what is survived is known before what is
    not, and halves what is left between.

    Args:
        margin: what is looked for.
        survives: whether a value is survived.
    """
    tried: dict[float, bool] = {}

    def test(value: float) -> bool:
        tried[value] = survives(value)
        return tried[value]

    low, high = margin.low, inf
    stride = max((margin.high - margin.low) / STRIDES, margin.precision)
    while low < margin.high and high == inf:
        value = min(low + stride, margin.high)
        low, high = (value, high) if test(value) else (low, value)
    while high < inf and high - low > margin.precision:
        middle = 0.5 * (low + high)
        low, high = (middle, high) if test(middle) else (low, middle)
    for value in np.linspace(0.4, 0.95, margin.smaller).tolist():
        test(margin.low + value * (low - margin.low))
    fatal = min((value for value, stood in tried.items() if not stood), default=inf)
    below = [value for value, stood in tried.items() if stood and value < fatal]
    islands = sum(stood and value > fatal for value, stood in tried.items())
    return Found(max(below, default=margin.low), fatal, islands, tuple(sorted(tried.items())))
