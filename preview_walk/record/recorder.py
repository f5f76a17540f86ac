"""The recorder: takes a row per tick inside the loop and gives the record at the end."""

from __future__ import annotations

from collections.abc import Mapping
from importlib.metadata import PackageNotFoundError, version
from platform import python_version
from typing import Any

from preview_walk.footsteps.plan import FootstepPlan
from preview_walk.record.columns import ROOM, Columns
from preview_walk.record.fields import FIELDS
from preview_walk.record.plan_writer import PlanWriter
from preview_walk.record.record import Record
from preview_walk.record.run_facts import RunFacts
from preview_walk.record.sensed import Sensed, sensed_columns


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
        self._sizes = dict(sizes)
        self._ticks = Columns(FIELDS, sizes, capacity)
        self._sensed: Columns | None = None

    def __len__(self) -> int:
        return len(self._ticks)

    def write(self, **values: Any) -> None:
        """Store the values of one tick by field name (6 to 10 microseconds for all of them).

        Values are copied. A tick interrupted half way is not counted: a record has whole rows.
        """
        self._ticks.write(values)

    def sensed(self, **values: Any) -> None:
        """Store what a robot with real sensors measured and estimated at the tick written last."""
        if self._sensed is None:
            self._sensed = sensed_columns(self._sizes)
        self._sensed.write(values)

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
        sensed = None if self._sensed is None else Sensed(**self._sensed.rows())
        run = self._run.replaced(**outcome)
        return Record(**self._ticks.rows(), plans=self._plans.finish(), run=run, sensed=sensed)


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
