"""The record of a run: planned beside measured at every tick, in one value and one file."""

from __future__ import annotations

import json
import os
import zipfile
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from preview_walk.errors import InvalidInput
from preview_walk.files import whole_file
from preview_walk.record.fields import FIELDS, Ticks
from preview_walk.record.plan_log import PlanLog

if TYPE_CHECKING:
    from preview_walk.record.summary import Summary

FORMAT = 1
"""Number of the file format, raised when a reader of the old one would misread the new."""

RUN_SETTINGS = frozenset({"wall_time", "command", "versions", "interrupted"})
"""Settings that tell how a run was made, not what was simulated."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Record(Ticks):
    """A run of N ticks; the arrays (`record.com`, ...) are those of `Ticks`, read-only.

    - `plans`: the footstep plans, one revision per change; `plans[-1]` is the last in force.
    - `settings`: what the run was made of, as plain JSON values: `robot`, `mass` (kg), `gravity`
      (m/s²), `joint_names`, `tau_max` (N·m, in the order of `tau`; 0: no motor), `control_hz`,
      `physics_hz`, `com_height`, `leg_length`, `step_width` (m), `sole` ([half length, half width],
      m), `friction`, `seed`, `pushes`, `command`, `versions`, `fell`, `fall_time` (s),
      `fall_reason`, `interrupted`, `wall_time` (s spent).

    Raises:
        InvalidInput: an array's shape does not fit its field, or a setting is not plain JSON.
    """

    plans: PlanLog
    settings: Mapping[str, Any]

    def __post_init__(self) -> None:
        """Check the shapes, then make everything read-only."""
        n = len(self.time)
        sizes: dict[str, int] = {}
        for name, info in FIELDS.items():
            array = np.asarray(getattr(self, name), dtype=info.dtype).view()
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
            array.setflags(write=False)
            object.__setattr__(self, name, array)
        try:
            settings = json.loads(json.dumps(dict(self.settings), default=_plain))
        except TypeError as error:
            raise InvalidInput(f"record settings must be plain JSON values: {error}.") from None
        object.__setattr__(self, "settings", MappingProxyType(settings))

    def __len__(self) -> int:
        return len(self.time)

    def __repr__(self) -> str:
        """Return one line: robot, ticks and seconds."""
        span = f"{self.time[-1] - self.time[0]:.3f} s" if len(self) else "empty"
        return f"Record({self.settings.get('robot', 'unknown robot')}, {len(self)} ticks, {span})"

    @property
    def dt(self) -> float:
        """Control period in s."""
        return 1.0 / float(self.settings["control_hz"])

    def arrays(self) -> dict[str, NDArray[Any]]:
        """Return the arrays of the ticks by name."""
        return {name: getattr(self, name) for name in FIELDS}

    def with_settings(self, **settings: Any) -> Record:
        """Return the same record with these settings added or replaced."""
        return replace(self, settings={**self.settings, **settings})

    def differences(self, other: Record) -> tuple[str, ...]:
        """Return the names of all that differs by a bit, leaving out what a stopwatch measured.

        Left out: the fields marked `timing` and the settings in `RUN_SETTINGS`.
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
        keys = sorted({*self.settings, *other.settings} - RUN_SETTINGS)
        unset = object()
        names += [
            f"settings[{key!r}]"
            for key in keys
            if json.dumps(self.settings.get(key, unset), default=str)
            != json.dumps(other.settings.get(key, unset), default=str)
        ]
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

        `np.load` reads it too, without pickle: the arrays by name, and the settings as a JSON
        string named `settings`.

        Raises:
            OutputError: the file cannot be written.
        """
        settings = np.array(json.dumps({"format": FORMAT, **self.settings}))
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
            ticks = {name: arrays[name] for name in FIELDS}
            return Record(**ticks, plans=PlanLog.from_arrays(arrays), settings=settings)
        except FileNotFoundError:
            raise InvalidInput(f"record file {os.fspath(path)} does not exist.") from None
        except (OSError, EOFError, ValueError, KeyError, TypeError, zipfile.BadZipFile) as error:
            if isinstance(error, InvalidInput):
                raise
            raise InvalidInput(
                f"{os.fspath(path)} is not a record written by preview_walk ({error})."
            ) from error


def _plain(value: Any) -> Any:
    """Turn NumPy values into what JSON knows."""
    if isinstance(value, np.ndarray | np.generic):
        return value.tolist()
    raise TypeError(f"{type(value).__name__} is not one")
