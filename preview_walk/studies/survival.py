"""Shares that survived, with Wilson's interval, and margins, by the columns of a table."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import pandas as pd


def wilson(successes: int, cases: int) -> tuple[float, float]:
    """Return the interval of 95 % for a share, after Wilson (J. Am. Stat. Assoc. 22, 1927).

    Args:
        successes: how many.
        cases: of how many; 0 gives (0, 1).
    """
    if not cases:
        return 0.0, 1.0
    from scipy.stats import binomtest

    interval = binomtest(successes, cases).proportion_ci(0.95, "wilson")
    return float(interval.low), float(interval.high)


def survival_by(table: pd.DataFrame, by: Sequence[str]) -> pd.DataFrame:
    """Return cases, successes, share and its interval by columns; one row for all by none."""
    import pandas as pd

    rows, index = [], []
    for key, group in _groups(table, by):
        succeeded, count = int(group["success"].sum()), len(group)
        low, high = wilson(succeeded, count)
        share = succeeded / count if count else float("nan")
        rows.append((count, succeeded, share, low, high))
        index.append(key)
    names = ["cases", "succeeded", "share", "low", "high"]
    return pd.DataFrame(rows, index=_index(index, by), columns=names)


def margins_by(table: pd.DataFrame, by: Sequence[str]) -> pd.DataFrame:
    """Return count, smallest, median and largest margin, and islands, by columns."""
    import pandas as pd

    rows, index = [], []
    for key, group in _groups(table, by):
        found = group["margin"].dropna()
        islands = int(group["islands"].sum())
        rows.append((len(found), found.min(), found.median(), found.max(), islands))
        index.append(key)
    names = ["cases", "smallest", "median", "largest", "islands"]
    return pd.DataFrame(rows, index=_index(index, by), columns=names)


def _groups(
    table: pd.DataFrame, by: Sequence[str]
) -> list[tuple[tuple[object, ...], pd.DataFrame]]:
    if not by:
        return [(("all",), table)]
    groups = table.groupby(list(by), sort=False, dropna=False)
    return [(key if isinstance(key, tuple) else (key,), group) for key, group in groups]


def _index(keys: Sequence[tuple[object, ...]], by: Sequence[str]) -> pd.Index:
    import pandas as pd

    if len(by) > 1:
        return pd.MultiIndex.from_tuples(keys, names=list(by))
    return pd.Index([key[0] for key in keys], name=by[0] if by else None)
