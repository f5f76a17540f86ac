"""The plans of a run, one per change of mind: what the footsteps were before and after."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, fields
from typing import Any, overload

import numpy as np
from numpy.typing import NDArray

from preview_walk.errors import InvalidInput
from preview_walk.record.read_only import ReadOnlyArrays, own_array
from preview_walk.types import FEET, Array, Foot

_STEP_FIELDS: dict[str, tuple[tuple[int, ...], type[np.generic]]] = {
    "foot": ((), np.int8),
    "pose": ((4, 4), np.float64),
    "lift": ((), np.float64),
    "land": ((), np.float64),
}
"""Shape and type of what a footstep is made of."""


@dataclass(frozen=True, eq=False)
class PlanRevision(ReadOnlyArrays):
    """A plan as arrays, one row per footstep, the two standing soles first; read-only.

    Attributes:
        time: when it came into force, s.
        end: when its last shift of weight is over, s.
        foot: (S,) 0 left, 1 right.
        pose: (S, 4, 4) sole poses, world, m.
        lift: (S,) lift times, s.
        land: (S,) landing times, s.

    Raises:
        InvalidInput: an array is not of its shape, or the first two rows are not both feet.
    """

    time: float
    end: float
    foot: NDArray[np.int8]
    pose: Array
    lift: Array
    land: Array

    def __post_init__(self) -> None:
        """Check the shapes and make the arrays read-only."""
        for name, (shape, kind) in _STEP_FIELDS.items():
            array = own_array(getattr(self, name), kind, name)
            _require_shape(array, (np.size(self.foot), *shape), name)
            object.__setattr__(self, name, array)
        _require_feet(self.foot, "foot")
        _require_both_feet(self.foot[:2].tolist(), "foot")

    def __len__(self) -> int:
        return len(self.foot)

    def __repr__(self) -> str:
        """Return one line: how many steps, from when to when."""
        return f"PlanRevision({len(self) - 2} steps, {self.time:.3f} s to {self.end:.3f} s)"

    def last_pose(self, foot: Foot) -> Array:
        """Return the sole pose (4, 4) where `foot` ends."""
        pose: Array = self.pose[np.flatnonzero(self.foot == FEET.index(foot))[-1]]
        return pose

    @property
    def landings(self) -> Array:
        """Landing times (s) of the steps, without the two standing soles."""
        return self.land[2:]

    @property
    def lifts(self) -> Array:
        """Lift times (s) of the steps, without the two standing soles."""
        return self.lift[2:]


@dataclass(frozen=True, eq=False)
class PlanLog(ReadOnlyArrays, Sequence[PlanRevision]):
    """All revisions of a run's plan; a revision is stored as what it changed. Read-only.

    Revision r keeps the first `plan_kept[r]` footsteps of revision r - 1; its own rows, those with
    `step_revision == r`, follow. So an hour of walking by command stays small.

    Attributes:
        plan_time: (R,) when each revision came into force, s.
        plan_end: (R,) when its last shift of weight is over, s.
        plan_kept: (R,) how many footsteps it keeps of the one before.
        step_revision: (S,) to which revision a footstep belongs, in order.
        step_foot: (S,) 0 left, 1 right.
        step_pose: (S, 4, 4) sole poses, world, m.
        step_lift: (S,) lift times, s.
        step_land: (S,) landing times, s.

    Raises:
        InvalidInput: the arrays do not fit together.
    """

    plan_time: Array
    plan_end: Array
    plan_kept: NDArray[np.int32]
    step_revision: NDArray[np.int32]
    step_foot: NDArray[np.int8]
    step_pose: Array
    step_lift: Array
    step_land: Array

    def __post_init__(self) -> None:
        """Check that the arrays fit together and make them read-only."""
        for name, (_, kind) in PLAN_ARRAYS.items():
            object.__setattr__(self, name, own_array(getattr(self, name), kind, name))
        plans, steps = self.plan_time.size, self.step_revision.size
        for name, (shape, _) in PLAN_ARRAYS.items():
            rows = plans if name.startswith("plan_") else steps
            _require_shape(getattr(self, name), (rows, *shape), name)
        _require_feet(self.step_foot, "step_foot")
        _require_revisions(self.plan_kept, self.step_revision, self.step_foot)

    def __len__(self) -> int:
        return len(self.plan_time)

    def __iter__(self) -> Iterator[PlanRevision]:
        for index, rows in enumerate(self._rows()):
            yield self._revision(index, rows)

    def __repr__(self) -> str:
        """Return one line: how many revisions and footsteps."""
        return f"PlanLog({len(self)} revisions, {len(self.step_foot)} footsteps)"

    @overload
    def __getitem__(self, index: int) -> PlanRevision: ...
    @overload
    def __getitem__(self, index: slice) -> tuple[PlanRevision, ...]: ...
    def __getitem__(self, index: int | slice) -> PlanRevision | tuple[PlanRevision, ...]:
        """Return a revision, or a tuple of them for a slice."""
        if isinstance(index, slice):
            return tuple(self[i] for i in range(*index.indices(len(self))))
        last = range(len(self))[index]
        rows = next(rows for r, rows in enumerate(self._rows()) if r == last)
        return self._revision(last, rows)

    def walked(self, until: float) -> PlanRevision:
        """Return the standing soles and all steps that were to have landed by time `until` (s).

        A step counts where the plan in force at its landing had it, so the steps of a walk whose
        plan was edited, or forgot its past, are all here.
        """
        rows = [np.flatnonzero(self.step_revision == 0)[:2]]
        ends = [*self.plan_time[1:], np.inf]
        for r, current in enumerate(self._rows()):
            land = self.step_land[current[2:]]
            since = -np.inf if r == 0 else self.plan_time[r]
            rows.append(current[2:][(land > since) & (land <= min(ends[r], until))])
        return self._revision(len(self) - 1, np.concatenate(rows))

    def _rows(self) -> Iterator[NDArray[np.intp]]:
        """Yield the rows of the step arrays that make up each revision, in order."""
        rows = np.zeros(0, dtype=np.intp)
        for r, kept in enumerate(self.plan_kept):
            first, after = np.searchsorted(self.step_revision, [r, r + 1])
            rows = np.concatenate([rows[:kept], np.arange(first, after)])
            yield rows

    def _revision(self, index: int, rows: NDArray[np.intp]) -> PlanRevision:
        return PlanRevision(
            float(self.plan_time[index]),
            float(self.plan_end[index]),
            self.step_foot[rows],
            self.step_pose[rows],
            self.step_lift[rows],
            self.step_land[rows],
        )

    def arrays(self) -> dict[str, NDArray[Any]]:
        """Return the arrays by name, as `record.npz` holds them."""
        return {f.name: getattr(self, f.name) for f in fields(self)}

    @staticmethod
    def from_arrays(arrays: Mapping[str, NDArray[Any]]) -> PlanLog:
        """Build the log from the arrays of `arrays()`; others in the mapping are ignored."""
        return PlanLog(**{f.name: arrays[f.name] for f in fields(PlanLog)})


PLAN_ARRAYS: dict[str, tuple[tuple[int, ...], type[np.generic]]] = {
    "plan_time": ((), np.float64),
    "plan_end": ((), np.float64),
    "plan_kept": ((), np.int32),
    "step_revision": ((), np.int32),
    **{f"step_{name}": form for name, form in _STEP_FIELDS.items()},
}
"""Shape of a row and type of each array of the log, as `record.npz` holds them."""


def _require_shape(array: NDArray[Any], shape: tuple[int, ...], name: str) -> None:
    if array.shape != shape:
        raise InvalidInput(f"{name} must have the shape {shape}, got {array.shape}.", argument=name)


def _require_feet(foot: NDArray[np.int8], name: str) -> None:
    if not np.isin(foot, (0, 1)).all():
        raise InvalidInput(f"{name} must hold 0 (left) and 1 (right) only.", argument=name)


def _require_both_feet(first: list[int], name: str) -> None:
    if sorted(first) != [0, 1]:
        raise InvalidInput(
            f"{name} must begin with one sole of each foot, 0 (left) and 1 (right), got {first}.",
            argument=name,
        )


def _require_revisions(
    kept: NDArray[np.int32], revision: NDArray[np.int32], foot: NDArray[np.int8]
) -> None:
    """Check that every revision keeps what there is, adds rows in order, and has both feet."""
    count = len(kept)
    inside = not len(revision) or (revision[0] >= 0 and revision[-1] < count)
    if not inside or (np.diff(revision) < 0).any():
        raise InvalidInput(
            f"step_revision must go up and stay within 0 and {count - 1}.",
            argument="step_revision",
        )
    length, own, first = 0, 0, list[int]()
    added = np.bincount(revision, minlength=count).tolist()
    for shared, new in zip(kept.tolist(), added, strict=True):
        if not 0 <= shared <= length:
            raise InvalidInput(
                f"plan_kept must be from 0 to the {length} footsteps of the plan before, "
                f"got {shared}.",
                argument="plan_kept",
            )
        first = [*first[:shared], *foot[own : own + min(new, 2)].tolist()][:2]
        _require_both_feet(first, "step_foot")
        length, own = shared + new, own + new
