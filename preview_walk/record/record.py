"""The record of a run: planned beside measured at every tick, in one value and one file."""

from __future__ import annotations

import json
import os
import zipfile
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from preview_walk.errors import InvalidInput
from preview_walk.files import whole_file
from preview_walk.record.fields import FIELDS, Ticks
from preview_walk.record.plan_log import PlanLog
from preview_walk.record.read_only import own_array
from preview_walk.record.run_facts import RunFacts

if TYPE_CHECKING:
    from preview_walk.record.summary import Summary

FORMAT = 1
"""Number of the file format, raised when a reader of the old one would misread the new."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Record(Ticks):
    """A run of N ticks; the arrays (`record.com`, ...) are those of `Ticks`, read-only.

    - `plans`: the footstep plans, one revision per change; `plans[-1]` is the last in force.
    - `run`: what the run was made of and how it ended.

    Raises:
        InvalidInput: an array's shape does not fit its field.
    """

    plans: PlanLog
    run: RunFacts

    def __post_init__(self) -> None:
        """Check the shapes, then make everything read-only."""
        n = len(self.time)
        sizes: dict[str, int] = {}
        for name, info in FIELDS.items():
            array = own_array(getattr(self, name), info.dtype)
            if array.ndim > 1:
                names = [k for k in info.shape if isinstance(k, str)]
                sizes.update({k: array.shape[1] for k in names if k not in sizes})
            expected = (n, *(sizes.get(k, -1) if isinstance(k, str) else k for k in info.shape))
            if array.shape != expected:
                text = ", ".join(map(str, ("N", *info.shape)))
                raise InvalidInput(
                    f"record field '{name}' must have the shape ({text}) with N = {n} ticks, "
                    f"got {array.shape}."
                )
            object.__setattr__(self, name, array)

    def __len__(self) -> int:
        return len(self.time)

    def __repr__(self) -> str:
        """Return one line: robot, ticks and seconds."""
        span = f"{self.time[-1] - self.time[0]:.3f} s" if len(self) else "empty"
        return f"Record({self.run.robot or 'unknown robot'}, {len(self)} ticks, {span})"

    @property
    def dt(self) -> float:
        """Control period in s."""
        return 1.0 / self.run.control_hz

    def arrays(self) -> dict[str, NDArray[Any]]:
        """Return the arrays of the ticks by name."""
        return {name: getattr(self, name) for name in FIELDS}

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
            and (mine[name].shape, mine[name].tobytes())
            != (theirs[name].shape, theirs[name].tobytes())
        ]
        names += [f"run.{name}" for name in self.run.differences(other.run)]
        return tuple(names)

    def physical_equal(self, other: Record) -> bool:
        """Tell whether two runs are the same bit for bit, leaving out their timings."""
        return not self.differences(other)

    def summary(self) -> Summary:
        """Return the figures of the run; it prints as a table."""
        from preview_walk.record.summary import summarize  # the only arrow that points back

        return summarize(self)

    def save(self, path: str | os.PathLike[str]) -> Path:
        """Write the record to one compressed .npz file, whole or not at all; return its path.

        `np.load` reads it too, without pickle: the arrays by name, and the run's facts as a JSON
        string named `settings`.

        Raises:
            OutputError: the file cannot be written.
        """
        settings = np.array(json.dumps({"format": FORMAT, **self.run.as_dict()}))
        arrays = {"settings": settings, **self.arrays(), **self.plans.arrays()}
        target = Path(path)
        with (
            whole_file(target) as part,
            zipfile.ZipFile(part, "w", zipfile.ZIP_DEFLATED, compresslevel=1) as archive,
        ):
            for name, array in arrays.items():
                # ZipInfo's fixed date: the same record makes the same file.
                entry = zipfile.ZipInfo(f"{name}.npy")
                entry.compress_type = zipfile.ZIP_DEFLATED
                with archive.open(entry, "w", force_zip64=True) as file:
                    np.lib.format.write_array(
                        file, np.asarray(array, order="C"), allow_pickle=False
                    )
        return target

    @staticmethod
    def load(path: str | os.PathLike[str]) -> Record:
        """Read a record written by `save`.

        Raises:
            InvalidInput: the file is missing, is not a record, or has a newer format.
        """
        try:
            with np.load(path, allow_pickle=False) as archive:
                arrays = {name: archive[name] for name in archive.files}
            settings = json.loads(str(arrays["settings"][()]))
            if settings.pop("format") > FORMAT:
                raise InvalidInput(
                    f"{os.fspath(path)} was written by a newer preview_walk; "
                    f"this one reads records up to format {FORMAT}."
                )
            run = RunFacts.from_dict(settings)
            ticks = {name: arrays[name] for name in FIELDS}
            return Record(**ticks, plans=PlanLog.from_arrays(arrays), run=run)
        except FileNotFoundError:
            raise InvalidInput(f"record file {os.fspath(path)} does not exist.") from None
        except (OSError, EOFError, ValueError, KeyError, TypeError, zipfile.BadZipFile) as error:
            if isinstance(error, InvalidInput):
                raise
            raise InvalidInput(
                f"{os.fspath(path)} is not a record written by preview_walk ({error})."
            ) from error
