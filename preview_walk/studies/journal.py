"""The folder of a study: what it is, and a row a case, on disk as soon as it ends.

`rows.jsonl` is only ever appended to, a line a row: whatever stops the process, at most the line
being written is lost, and reading leaves out what is no whole line. `study.json` says what the rows
are of.
"""

from __future__ import annotations

import json
import os
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from errno import ENOSPC
from pathlib import Path
from typing import Any

from preview_walk.errors import InvalidInput
from preview_walk.files import OutputError, claimed, make_folder, short, whole_file
from preview_walk.studies.figures import storable
from preview_walk.studies.work import Row

STUDY, ROWS, TABLE, RECORDS = "study.json", "rows.jsonl", "results.parquet", "records"
"""The names in the folder."""


class Journal:
    """The rows of a study in its folder.

    Attributes:
        folder: where they are.
        versions: of the packages that the cases run with, as one text.
    """

    def __init__(self, folder: Path, versions: str) -> None:
        """Make the folder, unless there is one.

        Raises:
            OutputError: it cannot be made or written to.
        """
        self.folder, self.versions = folder, versions
        self._file: Any = None
        make_folder(folder, (STUDY, ROWS, TABLE))

    @contextmanager
    def open(self) -> Iterator[None]:
        """Keep the folder for this process, and its rows' file open, until the end of the block.

        Raises:
            OutputError: another process has it, or it cannot be written to.
        """
        path = self.folder / ROWS
        with claimed(self.folder):
            try:
                # Without a buffer: what a full disk did not take is not tried again at the end.
                self._file = path.open("ab+", buffering=0)
                _cut_torn_line(self._file)
            except OSError as error:
                raise OutputError(f"cannot write {short(path)}: {error.strerror}.") from error
            try:
                yield
            finally:
                self._file.close()

    def write(self, row: Row) -> None:
        """Append a row.

        Raises:
            OutputError: it cannot be written.
        """
        case = row.case
        line = {
            "key": case.key,
            "index": case.index,
            "values": {name: storable(value) for name, value in case.values.items()},
            "repeat": case.repeat,
            "seed": case.seed,
            "outcome": row.outcome,
            "success": row.success,
            "reason": row.reason,
            "figures": dict(row.figures),
            "seconds": round(row.seconds, 6),
            "started": row.started,
            "host": row.host,
            "versions": self.versions,
        }
        try:
            data = json.dumps(line).encode() + b"\n"
            if self._file.write(data) < len(data):
                raise OSError(ENOSPC, os.strerror(ENOSPC))
            os.fsync(self._file.fileno())
        except OSError as error:
            path = self.folder / ROWS
            raise OutputError(f"cannot write {short(path)}: {error.strerror}.") from error

    def describe(self, facts: Mapping[str, Any]) -> None:
        """Write what the rows are of.

        Raises:
            OutputError: it cannot be written.
        """
        with whole_file(self.folder / STUDY) as part:
            part.write_text(json.dumps(facts, indent=2) + "\n", encoding="utf-8")


def read_rows(folder: Path) -> list[dict[str, Any]]:
    """Return the rows in a folder, the last one of each key, in the order in which they ended.

    Raises:
        InvalidInput: a line that is whole is no row.
    """
    path, rows = folder / ROWS, {}
    if path.exists():
        for number, line in enumerate(path.read_bytes().split(b"\n")[:-1], 1):
            try:
                row = json.loads(line)
                rows[row["key"]] = row
            except (ValueError, TypeError, KeyError):
                raise InvalidInput(
                    f"line {number} of {short(path)} is no row of a study; remove it to go on."
                ) from None
    return list(rows.values())


def read_facts(folder: Path) -> dict[str, Any] | None:
    """Return what the rows in a folder are of, or None where it holds no study.

    Raises:
        InvalidInput: the file is no study's.
    """
    path = folder / STUDY
    if not path.exists():
        return None
    try:
        facts = json.loads(path.read_text(encoding="utf-8"))
        return dict(facts)
    except (ValueError, TypeError):
        raise InvalidInput(f"{short(path)} does not say what a study is.") from None


def _cut_torn_line(file: Any) -> None:
    """Cut off what a process that was killed had written of its last line."""
    file.seek(0)
    whole = 0
    for block in iter(lambda: file.read(1 << 20), b""):
        end = block.rfind(b"\n")
        if end >= 0:
            whole = file.tell() - len(block) + end + 1
    file.truncate(whole)
