"""What is wrong with a step, as a value: its sentence, and which argument of a planner to blame."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

from preview_walk.arguments import angle
from preview_walk.geometry.poses import Heading
from preview_walk.types import Foot, other

ROUNDING = 1e-6
"""A bound may be passed by this much (m, rad): rounding."""


class StepBounds(Protocol):
    """The bounds that a landing is held to; `GaitLimits` says what each means."""

    @property
    def forward(self) -> float:
        """See `GaitLimits`."""

    @property
    def backward(self) -> float:
        """See `GaitLimits`."""

    @property
    def min_width(self) -> float:
        """See `GaitLimits`."""

    @property
    def max_width(self) -> float:
        """See `GaitLimits`."""

    @property
    def turn_out(self) -> float:
        """See `GaitLimits`."""

    @property
    def turn_in(self) -> float:
        """See `GaitLimits`."""

    @property
    def rise(self) -> float:
        """See `GaitLimits`."""

    @property
    def clearance(self) -> float:
        """See `GaitLimits`."""

    @property
    def min_swing_time(self) -> float:
        """See `GaitLimits`."""


@dataclass(frozen=True)
class StepProblem:
    """A limit that a step breaks.

    Attributes:
        text: what is wrong, a sentence without its subject and full stop: "lands 0.600 m ahead of
            the right sole, at most 0.500 m is allowed".
        argument: the argument of a planner that is at fault: "step_length", "step_width",
            "step_time", "turn", or "footholds" for heights, which only given footholds have.
    """

    text: str
    argument: str

    def __str__(self) -> str:
        return self.text


def landing_problem(
    limits: StepBounds, foot: Foot, place: Heading, rise: float, gap: float
) -> StepProblem | None:
    """Return what is wrong with a landing beside the standing sole, or None.

    Args:
        limits: bounds of a step.
        foot: the landing foot.
        place: of its sole in the frame of the standing one, m and rad.
        rise: height difference of the soles, m.
        gap: between the soles; negative where they overlap, m.
    """
    x, y, turn = place
    side = 1.0 if foot == "left" else -1.0
    beside = f"the {other(foot)} sole"
    for excess, bound, text, argument in (
        (x, limits.forward, "lands {} ahead of {}", "step_length"),
        (-x, limits.backward, "lands {} behind {}", "step_length"),
        (side * y, limits.max_width, "lands {} beside {}", _aside(turn)),
        (side * turn, limits.turn_out, "turns {} out from {}", "turn"),
        (-side * turn, limits.turn_in, "turns {} in to {}", "turn"),
        (rise, limits.rise, "lands {} higher or lower than {}", "footholds"),
    ):
        if excess > bound + ROUNDING:
            size = angle if text.startswith("turns") else _metres
            reached = text.format(size(excess), beside)
            return StepProblem(f"{reached}, at most {size(bound)} is allowed", argument)
    if side * y < limits.min_width - ROUNDING:
        reached = f"lands {_metres(side * y)} beside {beside}"
        least = f"at least {_metres(limits.min_width)} is allowed"
        return StepProblem(f"{reached}, {least}", _aside(turn))
    if gap < limits.clearance - ROUNDING:
        state = f"passes {_metres(gap)} from {beside}"
        if gap < 0.0:
            state = f"collides with {beside} (overlap {_metres(-gap)})"
        least = f"at least {_metres(limits.clearance)} must stay free"
        return StepProblem(f"{state}, {least}", _aside(turn))
    return None


def haste_problem(limits: StepBounds, air: float) -> StepProblem | None:
    """Return what is wrong with how long a foot is in the air, or None.

    Args:
        limits: bounds of a step.
        air: time from lift to landing, s.
    """
    if air >= limits.min_swing_time - 1e-9:
        return None
    need = f"at least {limits.min_swing_time:.3f} s is needed"
    return StepProblem(f"is {air:.3f} s in the air, {need}", "step_time")


def crossing_problem(foot: Foot, overlap: float, turn: float) -> StepProblem:
    """Return the problem of a foot whose swing overlaps the standing sole.

    Args:
        foot: the swinging foot.
        overlap: of the soles on the way, m.
        turn: of the landing sole against the standing one, rad.
    """
    text = f"swings across the {other(foot)} sole (overlap {_metres(overlap)})"
    return StepProblem(text, _aside(turn))


def _aside(turn: float) -> str:
    """Return the argument that puts a sole too far to its side: turned ones are so by their turn.

    `turn` of the landing sole against the standing one, rad.
    """
    return "turn" if abs(turn) > ROUNDING else "step_width"


def _metres(size: float) -> str:
    """Return how a sentence gives a length (m)."""
    return f"{size:.3f} m"
