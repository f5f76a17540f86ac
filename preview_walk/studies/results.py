"""What came out of a study: a table with one row a case, and what it comes to."""

from __future__ import annotations

import os
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from preview_walk.errors import InvalidInput
from preview_walk.extras import require
from preview_walk.files import as_path, short, whole_file
from preview_walk.studies.factors import plain
from preview_walk.studies.figures import storable
from preview_walk.studies.journal import TABLE, read_facts, read_rows
from preview_walk.studies.survival import margins_by, survival_by
from preview_walk.studies.work import Campaign

if TYPE_CHECKING:
    import pandas as pd

_ABOUT = ("outcome", "success", "reason", "seconds", "started", "host", "versions", "key")
"""What a row says about its case, beside factors and figures."""


@dataclass(frozen=True, eq=False)
class Results:
    """The rows of a study.

    Attributes:
        table: one row a case, in the study's order: its factors, `repeat` and `seed`, the figures
            (with `_found` behind the name where a factor has it too), then `outcome` ("done",
            "error", "timeout", "killed"), `success`, `reason`, `seconds`, `started`, `host`,
            `versions` and `key`.
        factors: names of the factors that are not random.
        folder: where the rows are.
        missing: how many cases of the study have no row yet.
        interrupted: whether Ctrl-C stopped the run.
    """

    table: pd.DataFrame
    factors: tuple[str, ...]
    folder: Path
    missing: int = 0
    interrupted: bool = False

    @staticmethod
    def of(study: Campaign, folder: Path, *, interrupted: bool = False) -> Results:
        """Return the rows in a folder that are of a study, in its order."""
        rows = {row["key"]: row for row in read_rows(folder)}
        mine = [rows[case.key] for case in study.cases() if case.key in rows]
        names = tuple(study.facts()["names"])
        fixed = tuple(name for name in names if name not in study.draws)
        return Results(
            _table(mine, names), fixed, folder, len(study) - len(mine), interrupted=interrupted
        )

    def __len__(self) -> int:
        """Return the number of rows."""
        return len(self.table)

    def __str__(self) -> str:
        """Return the table that the command prints: survival or margins by the factors."""
        by = self.varied
        found = self.margins(by) if "margin" in self.table else self.survival(by)
        lines = [found.to_string(index=bool(by), float_format=lambda x: f"{x:.4g}")]
        ends = self.table["outcome"].value_counts()
        odd = [f"{count} {name}" for name, count in ends.items() if name != "done"]
        lines.append(f"{len(self)} cases" + (f", of these {', '.join(odd)}" if odd else ""))
        if self.missing:
            lines[-1] += f"; {self.missing} are left"
        return "\n".join(lines)

    def __repr__(self) -> str:
        """Return one line: cases, those that succeeded, the folder."""
        return f"Results({len(self)} cases, {int(self.table['success'].sum())} succeeded)"

    def _repr_html_(self) -> str:
        """Return the table as a notebook shows it."""
        by = self.varied
        found = self.margins(by) if "margin" in self.table else self.survival(by)
        html: str = found.to_html(float_format=lambda x: f"{x:.4g}")
        return html

    @property
    def varied(self) -> tuple[str, ...]:
        """Names of the factors that have more than one value."""
        return tuple(name for name in self.factors if self.table[name].nunique(dropna=False) > 1)

    def survival(self, by: str | Iterable[str] = ()) -> pd.DataFrame:
        """Return cases, successes, their share and its interval of 95 % (Wilson) by factors.

        A case that did not end by itself counts as none that succeeded.

        Args:
            by: names of columns; none: all rows together.

        Raises:
            InvalidInput: there is no such column.
        """
        return survival_by(self.table, self._columns(by))

    def margins(self, by: str | Iterable[str] = ()) -> pd.DataFrame:
        """Return count, smallest, median and largest margin by factors.

        Args:
            by: names of columns; none: all rows together.

        Raises:
            InvalidInput: there is no such column, or the study looked for no margin.
        """
        self._columns(["margin"])
        return margins_by(self.table, self._columns(by))

    def write(self) -> Path:
        """Write the table as Parquet into the folder; return its path.

        Raises:
            OutputError: the file cannot be written.
        """
        target = self.folder / TABLE
        with whole_file(target) as part:
            self.table.to_parquet(part, index=False)
        return target

    def _columns(self, by: str | Iterable[str]) -> list[str]:
        names = [by] if isinstance(by, str) else list(by)
        for name in names:
            if name not in self.table:
                known = ", ".join(column for column in self.table if column not in _ABOUT)
                raise InvalidInput(f"by must be columns of {known}; got {name}.", argument="by")
        return names


def read_results(folder: str | os.PathLike[str]) -> Results:
    """Return what is in the folder of a study, also of one that is running or was stopped.

    Args:
        folder: of the study.

    Raises:
        InvalidInput: it holds none.
    """
    require("a study", "studies", "pandas")
    place = as_path(folder)
    facts = read_facts(place)
    if facts is None:
        raise InvalidInput(f"folder must be one of a study, got {short(place)}.", argument="folder")
    names, draws = tuple(facts["names"]), set(facts["draws"])
    rows = sorted(read_rows(place), key=lambda row: row.get("index", 0))
    return Results(_table(rows, names), tuple(n for n in names if n not in draws), place)


def _table(rows: Sequence[dict[str, Any]], names: Sequence[str]) -> pd.DataFrame:
    """Return rows as a table: factors, figures, and what became of each case."""
    import pandas as pd

    flat = []
    for row in rows:
        figures = {
            f"{name}_found" if name in row["values"] or name in _ABOUT else name: value
            for name, value in row["figures"].items()
            if name != "success"
        }
        # A factor of the name `seed` is the seed that the function was given.
        head = {**row["values"], "repeat": row["repeat"], "seed": row["seed"], **row["values"]}
        flat.append({**head, **figures, **{name: row.get(name) for name in _ABOUT}})
    table = pd.DataFrame(flat, columns=None if flat else [*names, "repeat", "seed", *_ABOUT])
    last = [name for name in table.columns if name in _ABOUT]
    table = table[[name for name in table.columns if name not in _ABOUT] + last]
    # Parquet has one type a column: what is mixed becomes text.
    for name in table.columns:
        kinds = {type(value) for value in table[name] if value is not None}
        if len(kinds - {float, int}) > 1 or (kinds & {float, int} and kinds - {float, int}):
            table[name] = [None if v is None else str(storable(plain(v))) for v in table[name]]
    return table
