"""A footstep as a value: which foot, where its sole is put down, and when it flies there."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, Literal

from preview_walk.arguments import SMALLEST, finite_number, foot_of, instance_of, shown
from preview_walk.errors import InvalidInput
from preview_walk.footsteps.swing_shape import PLAIN, SwingShape
from preview_walk.geometry.poses import as_pose, yaw_of
from preview_walk.types import Array, Foot

_LAB_KEYS = ("foot", "pos", "time", "type")
"""Keys of the walking lab's dictionary of a footstep."""


@dataclass(frozen=True, eq=False)
class Footstep:
    """One sole on the ground: where it is put down, and when the foot flies there.

    It answers to the walking lab's keys (foot, pos, time, type) as a dictionary does; the lab's pos
    is (x, y).

    Attributes:
        foot: "left" or "right".
        pose: sole frame in the world, (4, 4), read-only (origin at the centre of the sole
            rectangle, x towards the toes, z up; yaw, height and slope included).
        lift: time (s) at which the foot leaves the ground.
        land: time (s) at which the sole is down at `pose`.
        type: "swing_end" for a step; "stance" for the two soles a plan starts on (lift == land).
        again: whether the foot that stepped last may step again at once, as after a push.
        swing: how the foot goes there.

    Raises:
        InvalidInput: unknown foot or type, no pose, or times that are not finite and in order.
    """

    foot: Foot
    pose: Array
    lift: float
    land: float
    type: Literal["stance", "swing_end"] = "swing_end"
    again: bool = False
    swing: SwingShape = PLAIN

    def __post_init__(self) -> None:
        """Check the fields."""
        foot_of(self.foot, "foot")
        if not (isinstance(self.type, str) and self.type in ("stance", "swing_end")):
            came = shown(self.type)
            raise InvalidInput(
                f"type must be 'stance' or 'swing_end', got {came}.", argument="type"
            )
        instance_of(self.swing, SwingShape, "swing")
        object.__setattr__(self, "pose", as_pose(self.pose, "pose"))
        lift, land = finite_number(self.lift, "lift", "s"), finite_number(self.land, "land", "s")
        stands = self.type == "stance"
        if not (lift == land if stands else land - lift >= SMALLEST):
            allowed = "lift == land" if stands else "lift < land"
            raise InvalidInput(
                f"a {self.type} footstep needs times with {allowed}, got {lift} s, {land} s.",
                argument="land",
            )
        object.__setattr__(self, "lift", lift)
        object.__setattr__(self, "land", land)

    def __setstate__(self, state: dict[str, Any]) -> None:
        """Take a copied state; NumPy's copies forget that they are read-only."""
        vars(self).update(state)
        self.pose.setflags(write=False)

    def __repr__(self) -> str:
        x, y, z = self.pos.tolist()
        way = f"{self.lift:.3f} s to {self.land:.3f} s"
        return f"Footstep({self.foot} {self.type} at ({x:.3f}, {y:.3f}, {z:.3f}) m, {way})"

    @property
    def pos(self) -> Array:
        """Position (3,) of the sole centre in the world, m."""
        return self.pose[:3, 3]

    @property
    def yaw(self) -> float:
        """Heading of the sole in the world, rad in [-pi, pi]."""
        return yaw_of(self.pose)

    @property
    def time(self) -> float:
        """Landing time (s); for a stance sole the start of the plan."""
        return self.land

    def keys(self) -> tuple[str, ...]:
        """Return the walking lab's keys, so that `dict(footstep)` is the lab's dictionary."""
        return _LAB_KEYS

    def __iter__(self) -> Iterator[str]:
        return iter(_LAB_KEYS)

    def __contains__(self, key: object) -> bool:
        return isinstance(key, str) and key in _LAB_KEYS

    def __getitem__(self, key: str) -> Any:
        """Return one of the walking lab's keys: foot, pos, time, type."""
        if key not in self:
            raise KeyError(f"a footstep has the keys {', '.join(_LAB_KEYS)}, not {key!r}")
        return self.pos[:2] if key == "pos" else getattr(self, key)

    def get(self, key: str, default: Any = None) -> Any:
        """Return one of the walking lab's keys, or `default` for another one.

        Args:
            key: foot, pos, time or type.
            default: returned for any other key.
        """
        return self[key] if key in _LAB_KEYS else default

    def values(self) -> tuple[Any, ...]:
        """Return what stands under the lab's keys."""
        return tuple(self[key] for key in _LAB_KEYS)

    def items(self) -> tuple[tuple[str, Any], ...]:
        """Return the lab's keys with what stands under them."""
        return tuple(zip(_LAB_KEYS, self.values(), strict=True))
