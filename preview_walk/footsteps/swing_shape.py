"""The shape of a swing as a value: how high it goes, and when it travels."""

from __future__ import annotations

from dataclasses import dataclass
from math import inf

from preview_walk.arguments import SMALLEST, finite_number, number_from_zero
from preview_walk.errors import InvalidInput

LONGEST_WAIT = 0.8
"""A swing may stand above its ends for this share of its time, both together."""


@dataclass(frozen=True)
class SwingShape:
    """How a swing goes from its lift to its landing, beside where it begins and ends.

    Attributes:
        height: of the apex above the higher of its two soles, at least, m.
        before: share of the swing's time in which it only rises, before the way to its landing.
        after: share of the swing's time in which it only comes down, after that way.
        apex: share of the swing's time at which it is at its apex.

    Raises:
        InvalidInput: a height below 0, or shares that leave no time for the way.
    """

    height: float = 0.0
    before: float = 0.0
    after: float = 0.0
    apex: float = 0.5

    def __post_init__(self) -> None:
        """Check the numbers."""
        number_from_zero(self.height, "height", "m")
        for name in ("before", "after", "apex"):
            finite_number(getattr(self, name), name, "of the swing's time")
        if not (min(self.before, self.after) >= 0.0 and self.before + self.after <= LONGEST_WAIT):
            raise InvalidInput(
                f"before and after must be from 0 to {LONGEST_WAIT} together, "
                f"got {self.before} and {self.after}.",
                "before",
            )
        if not 0.1 <= self.apex <= 0.9:
            raise InvalidInput(f"apex must be from 0.1 to 0.9, got {self.apex}.", "apex")

    def way(self, lift: float, land: float, t: float = -inf) -> tuple[float, float]:
        """Return when the way to the landing begins and ends, s; seen from t, no earlier than t."""
        swing = land - lift
        go, arrive = max(t, lift + self.before * swing), land - self.after * swing
        # What is late travels until it lands.
        return go, (arrive if arrive > go + SMALLEST else land)

    def top(self, lift: float, land: float) -> float:
        """Return when the swing is at its apex, s."""
        return lift + self.apex * (land - lift)


PLAIN = SwingShape()
"""The swing over level ground: its way takes all its time, its apex is halfway."""
