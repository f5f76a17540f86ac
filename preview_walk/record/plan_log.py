"""The plans of a run, one per change of mind: what the footsteps were before and after."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, fields
from typing import TYPE_CHECKING, Any, overload

import numpy as np
from numpy.typing import NDArray

from preview_walk.types import FEET, Array, Foot

if TYPE_CHECKING:
    from preview_walk.footsteps.footstep import Footstep
from preview_walk.footsteps.plan import FootstepPlan


@dataclass(frozen=True, eq=False)
class PlanRevision:
    """A plan as arrays, one row per footstep, the two standing soles first.

    `time`: when it came into force (s); `end`: when its last shift of weight is over (s);
    `foot` (S,): 0 left, 1 right; `pose` (S, 4, 4): sole poses, world, m; `lift`, `land` (S,): s.
    """

    time: float
    end: float
    foot: NDArray[np.int8]
    pose: Array
    lift: Array
    land: Array

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
class PlanLog(Sequence[PlanRevision]):
    """All revisions of a run's plan; a revision is stored as what it changed.

    Revision r keeps the first `plan_kept[r]` footsteps of revision r - 1; its own rows, those with
    `step_revision == r`, follow. So an hour of walking by command stays small.
    """

    plan_time: Array
    plan_end: Array
    plan_kept: NDArray[np.int32]
    step_revision: NDArray[np.int32]
    step_foot: NDArray[np.int8]
    step_pose: Array
    step_lift: Array
    step_land: Array

    def __len__(self) -> int:
        return len(self.plan_time)

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


class PlanWriter:
    """Collects the plans of a run, and only what changed between them."""

    def __init__(self) -> None:
        self._current: tuple[Footstep, ...] = ()
        self._plans: list[tuple[float, float, int]] = []
        self._steps: list[tuple[int, Footstep]] = []

    def write(self, time: float, plan: FootstepPlan) -> None:
        """Note that `plan` is in force from `time` (s) on."""
        steps = tuple(plan)
        kept = 0
        # Footsteps are immutable values that an edited plan shares with the one before it.
        for old, new in zip(self._current, steps, strict=False):
            if old is not new:
                break
            kept += 1
        revision = len(self._plans)
        self._plans.append((time, plan.end, kept))
        self._steps.extend((revision, step) for step in steps[kept:])
        self._current = steps

    def finish(self) -> PlanLog:
        """Return what was written."""
        steps = [step for _, step in self._steps]
        return PlanLog(
            plan_time=np.array([time for time, _, _ in self._plans], dtype=np.float64),
            plan_end=np.array([end for _, end, _ in self._plans], dtype=np.float64),
            plan_kept=np.array([kept for _, _, kept in self._plans], dtype=np.int32),
            step_revision=np.array([r for r, _ in self._steps], dtype=np.int32),
            step_foot=np.array([FEET.index(step.foot) for step in steps], dtype=np.int8),
            step_pose=np.array([step.pose for step in steps], dtype=np.float64).reshape(-1, 4, 4),
            step_lift=np.array([step.lift for step in steps], dtype=np.float64),
            step_land=np.array([step.land for step in steps], dtype=np.float64),
        )
