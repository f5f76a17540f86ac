"""A stride as a value: how one step moves the middle of the stance, and how long it takes."""

from __future__ import annotations

from dataclasses import dataclass

from preview_walk.arguments import count_of, finite_number, positive_number, share_of


@dataclass(frozen=True)
class Stride:
    """How one step moves the middle of the stance; None takes what the planner has.

    Attributes:
        forward: advance (m) in the direction halfway through the turn.
        left: advance (m) to the left of that direction.
        turn: change of heading (rad, left positive).
        width: lateral distance (m) of the landing sole from where the other would stand.
        time: step time (s): swing of this step and the double support after it.
        double_support_ratio: share of `time` in double support, in (0, 1).

    Raises:
        InvalidInput: a value that is not a finite number or not within its range.
    """

    forward: float = 0.0
    left: float = 0.0
    turn: float = 0.0
    width: float | None = None
    time: float | None = None
    double_support_ratio: float | None = None

    def __post_init__(self) -> None:
        """Check the sizes."""
        for name, unit in (("forward", "m"), ("left", "m"), ("turn", "rad")):
            value = getattr(self, name)
            number = finite_number(value, name, unit)
            if number is not value:
                object.__setattr__(self, name, number)
        for name, unit in (("width", "m"), ("time", "s")):
            value = getattr(self, name)
            if value is not None:
                object.__setattr__(self, name, positive_number(value, name, unit))
        name = "double_support_ratio"
        if self.double_support_ratio is not None:
            ratio = share_of(self.double_support_ratio, name, "the step time")
            object.__setattr__(self, name, ratio)


def ramp_shares(count: int, ramp: int) -> list[float]:
    """Return the share of the full size of each of `count` strides, ramped up and down.

    Args:
        count: number of strides.
        ramp: number of shorter strides at either end; stride i of them has i / (ramp + 1).

    Raises:
        InvalidInput: ramp is not an integer >= 0.
    """
    size = count_of(ramp, "ramp") + 1
    return [min(1.0, (i + 1) / size, (count - i) / size) for i in range(count)]
