"""The record of a run: planned beside measured at every tick, in one value and one file."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from numpy.typing import NDArray

from preview_walk.errors import InvalidInput
from preview_walk.files import is_folder, whole_file
from preview_walk.html import html_table
from preview_walk.record.blocks import read_blocks
from preview_walk.record.fields import FIELDS, Ticks
from preview_walk.record.file import read_file, write_file
from preview_walk.record.mujoco_state import mujoco_qpos, mujoco_qvel
from preview_walk.record.plan_log import PLAN_ARRAYS, PlanLog
from preview_walk.record.read_only import ReadOnlyArrays, own_array
from preview_walk.record.run_facts import RunFacts
from preview_walk.record.sensed import SENSED, Sensed
from preview_walk.record.summarize import summarize
from preview_walk.record.summary import Summary, rows_of
from preview_walk.record.table import PREFIX, dataset_of, frame_of
from preview_walk.terrain.facts import ground_of
from preview_walk.terrain.ground import FlatGround, Ground
from preview_walk.types import Array

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr


@dataclass(frozen=True, eq=False, kw_only=True)
class Record(ReadOnlyArrays, Ticks):
    """A run of N ticks; the arrays (`record.com`, ...) are those of `Ticks`, read-only.

    Attributes:
        plans: the footstep plans, one revision per change; `plans[-1]` is the last in force.
        run: what the run was made of and how it ended.
        sensed: readings and estimates of a robot with real sensors; None for perfect ones.

    Raises:
        InvalidInput: an array's shape does not fit its field.
    """

    plans: PlanLog
    run: RunFacts
    sensed: Sensed | None = None

    def __post_init__(self) -> None:
        """Check the shapes, then make everything read-only."""
        for name, info in FIELDS.items():
            array = own_array(getattr(self, name), info.dtype, name)
            object.__setattr__(self, name, array)
        n = self.time.size
        sizes: dict[str, int] = {}
        for name, info in FIELDS.items():
            array = getattr(self, name)
            if array.ndim > 1:
                names = [k for k in info.shape if isinstance(k, str)]
                sizes.update({k: array.shape[1] for k in names if k not in sizes})
            expected = (n, *(sizes.get(k, -1) if isinstance(k, str) else k for k in info.shape))
            if array.shape != expected:
                text = ", ".join(map(str, ("N", *info.shape)))
                raise InvalidInput(
                    f"record field '{name}' must have the shape ({text}) with N = {n} ticks, "
                    f"got {array.shape}.",
                    argument=name,
                )

    def __len__(self) -> int:
        return len(self.time)

    def __repr__(self) -> str:
        """Return one line: robot, ticks and seconds."""
        span = f"{self.time[-1] - self.time[0]:.3f} s" if len(self) else "empty"
        return f"Record({self.run.robot or 'unknown robot'}, {len(self)} ticks, {span})"

    @property
    def dt(self) -> float:
        """Time between two rows, s: the control period, unless a rate was chosen."""
        return self.run.dt

    @property
    def ground(self) -> Ground:
        """What was walked on; level at height 0 where the record does not know."""
        return ground_of(self.run.ground) or FlatGround()

    @property
    def qpos(self) -> Array:
        """MuJoCo's configurations (N, nq): base position (m), quaternion wxyz, joints (rad)."""
        return mujoco_qpos(self.q)

    @property
    def qvel(self) -> Array:
        """MuJoCo's velocities (N, nv), m/s and rad/s.

        Base linear velocity in world axes, angular in base axes, then joint rates.
        """
        return mujoco_qvel(self.q, self.v)

    def arrays(self) -> dict[str, NDArray[Any]]:
        """Return the arrays of the ticks by name; those of `sensed` begin with `sensed_`."""
        more = {} if self.sensed is None else self.sensed.arrays()
        ticks = {name: getattr(self, name) for name in FIELDS}
        return {**ticks, **{PREFIX + name: array for name, array in more.items()}}

    def with_run(self, **facts: Any) -> Record:
        """Return the same record with these facts of its run replaced.

        Raises:
            InvalidInput: there is no fact of that name, or it is not of its type.
        """
        return replace(self, run=self.run.replaced(**facts))

    def differences(self, other: Record) -> tuple[str, ...]:
        """Return the names of all that differs by a bit, leaving out what a stopwatch measured.

        Left out: the fields marked `timing` and the facts in `run_facts.CIRCUMSTANCES`.
        """
        mine, theirs = {**self.arrays(), **self.plans.arrays()}, other.arrays()
        theirs.update(other.plans.arrays())
        names = [
            name
            for name in mine
            if not (name in FIELDS and FIELDS[name].timing)
            and (
                name not in theirs
                or (mine[name].shape, mine[name].tobytes())
                != (theirs[name].shape, theirs[name].tobytes())
            )
        ]
        names += [name for name in theirs if name not in mine]
        names += [f"run.{name}" for name in self.run.differences(other.run)]
        return tuple(names)

    def physical_equal(self, other: Record) -> bool:
        """Tell whether two runs are the same bit for bit, leaving out their timings."""
        return not self.differences(other)

    def summary(self) -> Summary:
        """Return the figures of the run; it prints as a table."""
        return summarize(self, self.plans, self.run, self.sensed)

    def to_dataframe(self, fields: Sequence[str] | None = None) -> pd.DataFrame:
        """Return a pandas table: one row a tick over `time` (s), one column a number.

        Columns are named by field and axis (`com_x`, `left_force_fz`, `tau_leg_left_4_joint`,
        `q_base_qw`); poses become place and quaternion (`left_foot_x`, ..., `left_foot_qw`). The
        units are in `attrs["units"]`.

        Args:
            fields: names of arrays; None: all.

        Raises:
            InvalidInput: there is no such array, or pandas is not installed.
        """
        return frame_of(self.arrays(), self.run.joint_names, fields)

    def to_csv(self, path: str | os.PathLike[str], fields: Sequence[str] | None = None) -> Path:
        """Write the table of `to_dataframe` as CSV, whole or not at all; return its path.

        `fields=["q"]` are joint trajectories, angles in rad over time in s.

        Raises:
            InvalidInput: as `to_dataframe` does.
            OutputError: the file cannot be written.
        """
        table = self.to_dataframe(fields)
        with whole_file(path) as part:
            table.to_csv(part)
        return Path(path)

    def to_xarray(self) -> xr.Dataset:
        """Return the arrays as an xarray dataset with named axes, units and the run's facts.

        Raises:
            InvalidInput: xarray is not installed.
        """
        return dataset_of(self.arrays(), self.run.joint_names, self.run.as_dict())

    def _repr_html_(self) -> str:
        """Return the figures of the run as a notebook shows them."""
        return html_table(repr(self), rows_of(self.summary()))

    def save(self, path: str | os.PathLike[str]) -> Path:
        """Write the record to one compressed .npz file, whole or not at all; return its path.

        `np.load` reads it too, without pickle: the arrays by name, and the run's facts as a JSON
        string named `settings`.

        Raises:
            OutputError: the file cannot be written.
        """
        return write_file(path, self.run.as_dict(), {**self.arrays(), **self.plans.arrays()})

    @staticmethod
    def load(path: str | os.PathLike[str]) -> Record:
        """Read a record written by `save`, or the folder of blocks that a killed run left.

        Raises:
            InvalidInput: the file is missing, is no record, is damaged, has a newer format, or
                would take memory out of proportion to its size.
        """
        more = [PREFIX + name for name in SENSED]
        read = read_blocks if is_folder(path) else read_file
        facts, arrays = read(path, [*FIELDS, *PLAN_ARRAYS], more)
        try:
            ticks = {name: arrays[name] for name in FIELDS}
            run, plans = RunFacts.from_dict(facts), PlanLog.from_arrays(arrays)
            sensed = {name: arrays[PREFIX + name] for name in SENSED if PREFIX + name in arrays}
            return Record(
                **ticks, plans=plans, run=run, sensed=Sensed(**sensed) if sensed else None
            )
        except (InvalidInput, TypeError) as error:
            reason = str(error).rstrip(".")
            raise InvalidInput(
                f"{os.fsdecode(path)} is not a record written by preview_walk ({reason}).",
                argument="path",
            ) from error
