"""The recorder: takes a row per tick inside the loop and gives the record at the end."""

from __future__ import annotations

from collections.abc import Mapping
from importlib.metadata import PackageNotFoundError, version
from platform import python_version
from typing import Any

import numpy as np
from numpy.typing import NDArray

from preview_walk.footsteps.plan import FootstepPlan
from preview_walk.record.fields import FIELDS
from preview_walk.record.plan_writer import PlanWriter
from preview_walk.record.record import Record
from preview_walk.record.run_facts import RunFacts

ROOM = 4096
"""Ticks that a recorder makes room for at first; it doubles when full."""


class Recorder:
    """Growing arrays for the fields of a record.

    Args:
        run: the facts that are known before the run.
        sizes: nq, nv and nu of the robot.
        capacity: number of ticks to make room for at first; it doubles when full.
    """

    def __init__(self, run: RunFacts, sizes: Mapping[str, int], capacity: int = ROOM) -> None:
        self._run = run
        self._plans = PlanWriter()
        self._plan: FootstepPlan | None = None
        self._n = 0
        self._arrays: dict[str, NDArray[Any]] = {}
        for name, info in FIELDS.items():
            shape = (capacity, *(sizes[k] if isinstance(k, str) else k for k in info.shape))
            # What is never written shows: nan, or -1 where there is no nan.
            empty = np.nan if info.dtype is np.float64 else -1
            self._arrays[name] = np.full(shape, empty, dtype=info.dtype)

    def __getstate__(self) -> dict[str, Any]:
        """Leave out the room that nothing is written in yet."""
        return {**vars(self), "_arrays": {n: a[: self._n] for n, a in self._arrays.items()}}

    def __setstate__(self, state: dict[str, Any]) -> None:
        """Take the rows, and make room of its own: what comes to a worker may be read-only."""
        vars(self).update(state)
        self._grow()

    def __len__(self) -> int:
        return self._n

    def write(self, **values: Any) -> None:
        """Store the values of one tick by field name (6 to 10 microseconds for all of them).

        Values are copied. A tick interrupted half way is not counted: a record has whole rows.
        """
        i = self._n
        arrays = self._arrays
        if i == len(arrays["time"]):
            self._grow()
        for name, value in values.items():
            arrays[name][i] = value
        self._n = i + 1

    def plan(self, time: float, plan: FootstepPlan) -> None:
        """Note the plan in force from `time` (s); free when it is the one already noted."""
        if plan is not self._plan:
            self._plan = plan
            self._plans.write(time, plan)

    def finish(self, **outcome: Any) -> Record:
        """Return the record of the ticks so far; `outcome` replaces facts (fell, wall_time, ...).

        Raises:
            InvalidInput: the run has no fact of such a name.
        """
        arrays = {name: array[: self._n] for name, array in self._arrays.items()}
        return Record(**arrays, plans=self._plans.finish(), run=self._run.replaced(**outcome))

    def _grow(self) -> None:
        for name, array in self._arrays.items():
            empty = np.nan if array.dtype == np.float64 else -1
            more = np.full((max(len(array), ROOM), *array.shape[1:]), empty, dtype=array.dtype)
            self._arrays[name] = np.concatenate([array, more])


_PACKAGES = ("preview-walk", "mujoco", "pin", "osqp", "qpsolvers", "control", "numpy", "scipy")


def package_versions() -> dict[str, str]:
    """Return the versions of Python and of the packages that a walk depends on."""
    versions = {"python": python_version()}
    for name in _PACKAGES:
        try:
            versions[name] = version(name)
        except PackageNotFoundError:
            versions[name] = "not installed"
    return versions
