"""The recorder: takes a row per tick inside the loop and gives the record at the end."""

from __future__ import annotations

import os
from collections.abc import Mapping
from importlib.metadata import PackageNotFoundError, version
from platform import python_version
from typing import Any

from preview_walk.footsteps.plan import FootstepPlan
from preview_walk.record.blocks import EVERY, BlockWriter
from preview_walk.record.columns import ROOM, Columns
from preview_walk.record.fields import FIELDS
from preview_walk.record.plan_writer import PlanWriter
from preview_walk.record.record import Record
from preview_walk.record.run_facts import RunFacts
from preview_walk.record.sensed import Sensed, sensed_columns
from preview_walk.record.table import PREFIX


class Recorder:
    """Growing arrays for the fields of a record.

    Args:
        run: the facts that are known before the run.
        sizes: nq, nv and nu of the robot.
        room: number of ticks to make room for at a time.
        blocks: folder that the rows are written to as they come, a block every so often.

    Raises:
        OutputError: the folder cannot be made or written to.
    """

    def __init__(
        self,
        run: RunFacts,
        sizes: Mapping[str, int],
        room: int = ROOM,
        *,
        blocks: str | os.PathLike[str] | None = None,
    ) -> None:
        self._run = run
        self._plans = PlanWriter()
        self._plan: FootstepPlan | None = None
        self._sizes = dict(sizes)
        self._ticks = Columns(FIELDS, sizes, room)
        self._sensed: Columns | None = None
        self._blocks = None if blocks is None else BlockWriter(blocks)
        self._per_block = max(1, round(EVERY / run.dt))
        self._written = (0, 0)

    def __getstate__(self) -> dict[str, Any]:
        """Leave out the blocks: two runs cannot write to one folder."""
        return {**vars(self), "_blocks": None}

    def __len__(self) -> int:
        return len(self._ticks)

    def write(self, **values: Any) -> None:
        """Store the values of one tick by field name (6 to 10 microseconds for all of them).

        Values are copied. A tick interrupted half way is not counted: a record has whole rows.
        """
        if self._blocks is not None and len(self) - self._written[0] >= self._per_block:
            self._flush()
        self._ticks.write(values)

    def _flush(self) -> None:
        """Write the rows and plans since the last block as the next one."""
        assert self._blocks is not None
        row, revision = self._written
        arrays = self._ticks.rows(row)
        if self._sensed is not None:
            rows = self._sensed.rows(row).items()
            arrays |= {PREFIX + name: array for name, array in rows}
        arrays |= self._plans.arrays(revision)
        # A run that is killed does not come to say how it ended.
        self._blocks.write(self._run.replaced(interrupted=True).as_dict(), arrays)
        self._written = len(self._ticks), len(self._plans)

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
