"""The plan: an immutable sequence of footsteps, of which every reference is a function.

To change a walk, make another plan (`FootstepPlan.replace_after`). All look-ups bisect.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from typing import overload

from preview_walk.arguments import finite_number, foot_of, items_of, positive_number, time_of
from preview_walk.errors import InvalidInput
from preview_walk.footsteps.footstep import Footstep
from preview_walk.footsteps.order import check_order, is_stand
from preview_walk.geometry.poses import as_pose
from preview_walk.html import html_table
from preview_walk.types import (
    DOUBLE_SUPPORT,
    FEET,
    LEFT_SUPPORT,
    RIGHT_SUPPORT,
    Array,
    Foot,
)

WEIGHT_SHIFT_TIME = 0.4
"""Default time (s) in which the ZMP goes from one foot to midfeet, or from midfeet to one foot."""


class FootstepPlan(Sequence[Footstep]):
    """An immutable walk: two standing soles, then swing steps in time order.

    `plan[0]` and `plan[1]` are the left and right soles stood on at `start`, `plan[2:]` (also
    `steps`) the swing steps, numbered from 1 in messages.  A pause of at least `2 * weight_shift`
    between a landing and the next lift is a *stand*: the ZMP comes to rest between the feet, and
    either foot may go first.

    Args:
        steps: the two stance soles (in either order) and then the swing steps.
        weight_shift: time (s) in which the ZMP goes between one foot and midfeet, in stands and
            at the end.

    Raises:
        InvalidInput: the first two are not one stance sole of each foot at one time, feet do not
            alternate, or a step does not lift after the step before it has landed.
    """

    __slots__ = ("_by_foot", "_items", "_lands", "_lifts", "_steps", "_weight_shift")

    def __init__(self, steps: Iterable[Footstep], weight_shift: float = WEIGHT_SHIFT_TIME) -> None:
        items = tuple(items_of(steps, Footstep, "steps"))
        weight_shift = positive_number(weight_shift, "weight_shift", "s")
        stance = items[:2]
        if {s.foot for s in stance if s.type == "stance"} != set(FEET):
            found = ", ".join(f"{s.foot} {s.type}" for s in stance) or "nothing"
            raise InvalidInput(
                f"a plan must begin with one left and one right stance footstep, got {found}.",
                argument="steps",
            )
        if stance[0].land != stance[1].land:
            both = " and ".join(f"{s.land} s" for s in stance)
            raise InvalidInput(
                f"both stance footsteps must have the same time, got {both}.", argument="steps"
            )
        if stance[0].foot == "right":
            items = (items[1], items[0], *items[2:])
        self._fill((), items, weight_shift)

    @classmethod
    def standing(
        cls, left: Array, right: Array, start: float = 0.0, weight_shift: float = WEIGHT_SHIFT_TIME
    ) -> FootstepPlan:
        """Return the plan without steps.

        Args:
            left: pose (4, 4) of the left sole.
            right: pose (4, 4) of the right sole.
            start: time from which they stand, s.
            weight_shift: as of the plan, s.

        Raises:
            InvalidInput: no pose, or no time.
        """
        soles = zip(FEET, (as_pose(left, "left"), as_pose(right, "right")), strict=True)
        start = finite_number(start, "start", "s")
        return cls(
            [Footstep(foot, pose, start, start, "stance") for foot, pose in soles], weight_shift
        )

    def _fill(
        self, kept: tuple[Footstep, ...], new: tuple[Footstep, ...], weight_shift: float
    ) -> None:
        """Set the fields; `kept` was checked before, only `new` is checked here."""
        self._items = kept + new
        self._steps = self._items[2:]
        self._weight_shift = weight_shift
        for index in range(max(2, len(kept)), len(self._items)):
            check_order(self._items[index - 1], self._items[index], index - 1, weight_shift)
        self._lifts = [s.lift for s in self._steps]
        self._lands = [s.land for s in self._steps]
        self._by_foot: dict[str, tuple[list[float], list[Footstep]]] = {}
        for foot in FEET:
            own = [s for s in self._items if s.foot == foot]
            self._by_foot[foot] = ([s.land for s in own], own)

    def __len__(self) -> int:
        return len(self._items)

    @overload
    def __getitem__(self, index: int) -> Footstep: ...
    @overload
    def __getitem__(self, index: slice) -> tuple[Footstep, ...]: ...
    def __getitem__(self, index: int | slice) -> Footstep | tuple[Footstep, ...]:
        return self._items[index]

    def __iter__(self) -> Iterator[Footstep]:
        return iter(self._items)

    def __repr__(self) -> str:
        return f"FootstepPlan({len(self.steps)} steps, {self.start:.3f} s to {self.end:.3f} s)"

    def _repr_html_(self) -> str:
        """Return the steps as a notebook shows them."""
        rows = [(f"{k} {step.foot}", repr(step)) for k, step in enumerate(self.steps)]
        return html_table(repr(self), rows)

    @property
    def steps(self) -> tuple[Footstep, ...]:
        """The swing steps, in time order."""
        return self._steps

    @property
    def weight_shift(self) -> float:
        """Time (s) of a ZMP shift between one foot and midfeet."""
        return self._weight_shift

    @property
    def start(self) -> float:
        """Time (s) from which the two first soles stand."""
        return self._items[0].land

    @property
    def end(self) -> float:
        """Time (s) at which the weight is back between the feet after the last landing."""
        return self._lands[-1] + self._weight_shift if self._lands else self.start

    def support(self, t: float) -> int:
        """Return the phase code at time t (s): 0 double, 1 left, 2 right support."""
        step = self.swing_at(t)
        if step is None:
            return DOUBLE_SUPPORT
        return LEFT_SUPPORT if step.foot == "right" else RIGHT_SUPPORT

    def swing_at(self, t: float) -> Footstep | None:
        """Return the step in the air at time t (s), lift <= t < land, or None."""
        if type(t) is not float or t != t:
            t = time_of(t)
        index = bisect_right(self._lifts, t) - 1
        return self._steps[index] if index >= 0 and t < self._lands[index] else None

    def sole(self, foot: Foot, t: float) -> Array:
        """Return where a foot stands; while it swings, where it lifted.

        Args:
            foot: which.
            t: time, s.

        Returns:
            Sole pose (4, 4) in the world, m.

        Raises:
            InvalidInput: no foot, or no time.
        """
        try:
            lands, own = self._by_foot[foot]
        except (KeyError, TypeError):
            lands, own = self._by_foot[foot_of(foot, "foot")]
        if type(t) is not float or t != t:
            t = time_of(t)
        return own[max(0, bisect_right(lands, t) - 1)].pose

    def start_pose(self, step: Footstep) -> Array:
        """Return the (4, 4) sole pose from which `step` lifts."""
        return self.sole(step.foot, step.lift)

    def next_landing(self, t: float) -> Footstep | None:
        """Return the first step that lands after time t (s), or None."""
        index = _until(self._lands, t)
        return self._steps[index] if index < len(self._steps) else None

    def next_lift(self, t: float) -> Footstep | None:
        """Return the first step that lifts after time t (s), or None."""
        index = _until(self._lifts, t)
        return self._steps[index] if index < len(self._steps) else None

    def lifted(self, t: float) -> tuple[Footstep, ...]:
        """Return the swing steps with lift <= t (s), which can no longer be unmade."""
        return self._steps[: _until(self._lifts, t)]

    def is_stand(self, pause: float) -> bool:
        """Return whether a double support of `pause` seconds is a stand (>= 2 weight_shift)."""
        return is_stand(time_of(pause, "pause"), self._weight_shift)

    def replace_after(self, t: float, steps: Iterable[Footstep]) -> FootstepPlan:
        """Return the plan with the steps lifted by time t (s), followed by `steps`.

        Args:
            t: time, s.
            steps: the swing steps to come, in time order.

        Raises:
            InvalidInput: a new step lifts at or before t, or does not fit to those before it.
        """
        t, new = time_of(t), tuple(items_of(steps, Footstep, "steps"))
        kept = self._items[: 2 + _until(self._lifts, t)]
        if new and new[0].lift <= t:
            lift = new[0].lift
            raise InvalidInput(
                f"a new step must lift after t = {t:.3f} s, got {lift:.3f} s.", argument="steps"
            )
        return self._with(kept, new)

    def retarget(self, t: float, pose: Array, land: float | None = None) -> FootstepPlan:
        """Return the plan in which the foot in the air at time t (s) lands at `pose`.

        Args:
            t: now; some foot must be in the air.
            pose: new sole pose of that step, (4, 4).
            land: new landing time (s, > t), None keeps it; later steps move by the same time.

        Raises:
            InvalidInput: no foot is in the air at t, `land` is not after t, or `pose` is none.
        """
        t = time_of(t)
        step = self.swing_at(t)
        if step is None:
            raise InvalidInput(
                f"no foot is in the air at t = {t:.3f} s, so none can be retargeted.", argument="t"
            )
        land = step.land if land is None else finite_number(land, "land", "s")
        if not land > t:
            raise InvalidInput(f"land must be after t = {t:.3f} s, got {land} s.", argument="land")
        index = 1 + _until(self._lifts, t)
        later = self._items[index + 1 :]
        if land != step.land:
            delay = land - step.land
            later = tuple(replace(s, lift=s.lift + delay, land=s.land + delay) for s in later)
        return self._with(self._items[:index], (replace(step, pose=pose, land=land), *later))

    def since(self, t: float) -> FootstepPlan:
        """Return the plan without its past, the same at all times >= t (s): for endless walks."""
        first = _until(self._lands, t) - 2
        if first <= 0:
            return self
        index = 2 + first
        start = self._items[index - 1].land
        soles = [(foot, self.sole(foot, start)) for foot in FEET]
        stance = tuple(Footstep(foot, pose, start, start, "stance") for foot, pose in soles)
        return self._with(stance, self._items[index:])

    def transformed(self, pose: Array) -> FootstepPlan:
        """Return the same walk elsewhere: every sole pose S becomes pose @ S, times unchanged."""
        by = as_pose(pose, "pose")
        return self._with(tuple(replace(s, pose=by @ s.pose) for s in self._items), ())

    def _with(self, kept: tuple[Footstep, ...], new: tuple[Footstep, ...]) -> FootstepPlan:
        """Return another plan with the same weight shift."""
        plan = object.__new__(FootstepPlan)
        plan._fill(kept, new, self._weight_shift)
        return plan


def _until(times: list[float], t: float) -> int:
    """Return how many of the increasing times (s) are not after t (s)."""
    return bisect_right(times, t if type(t) is float and t == t else time_of(t))
