"""Heat maps and polar plots of a study's results, by one call each."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from preview_walk.analysis.style import new_figure
from preview_walk.arguments import instance_of
from preview_walk.studies.results import Results

if TYPE_CHECKING:
    import pandas as pd

SHARE = "share"
"""What is drawn where nothing else is asked for: the share of cases that succeeded."""

_COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9")


def heat_map(results: Results, x: str, y: str, value: str = SHARE) -> Figure:
    """Return a map of a figure over two factors.

    Args:
        results: of a study.
        x, y: the factors along and up.
        value: a column, whose median over each cell is drawn; "share": that of successes.

    Raises:
        InvalidInput: there is no such column.
    """
    table = _over(results, [y, x], value).unstack()
    figure = new_figure(2.0 + 0.6 * table.shape[1], 1.6 + 0.42 * table.shape[0])
    axes = figure.subplots()
    numbers = table.to_numpy(float)
    image = axes.imshow(numbers, origin="lower", aspect="auto")
    if value == SHARE:
        image.set_clim(0.0, 1.0)
    _name_ticks(axes, table)
    axes.set(xlabel=x, ylabel=y)
    low, high = image.get_clim()
    for (row, column), number in np.ndenumerate(numbers):
        if np.isfinite(number):
            dark = number < 0.4 * (low or 0.0) + 0.6 * (high or 0.0)
            axes.text(
                column, row, f"{number:.2g}", ha="center", va="center", color="w" if dark else "k"
            )
    figure.colorbar(image, label=_label(value))
    return figure


def polar_plot(
    results: Results, angle: str, value: str = "margin", by: str | None = None
) -> Figure:
    """Return a figure of a study against a direction, straight ahead upwards, left to the left.

    Args:
        results: of a study.
        angle: the factor with the direction, degrees.
        value: a column, whose median at each direction is drawn; "share": that of successes.
        by: a factor; one line for each of its values.

    Raises:
        InvalidInput: there is no such column.
    """
    column = _over(results, [angle] if by is None else [by, angle], value)
    figure = new_figure(5.5, 5.0)
    axes: Any = figure.add_subplot(projection="polar")
    axes.set_theta_zero_location("N")
    groups = [("", column)] if by is None else [(str(key), column[key]) for key in _firsts(column)]
    for (name, values), colour in zip(groups, _COLOURS * len(groups), strict=False):
        ordered = values.sort_index()
        turn = np.radians(ordered.index.to_numpy(float))
        radius = ordered.to_numpy(float)
        axes.plot(
            np.append(turn, turn[:1]),
            np.append(radius, radius[:1]),
            "o-",
            color=colour,
            markersize=3,
            label=f"{by} {name}" if name else None,
        )
    axes.set_title(_label(value))
    axes.set_rmin(0.0)
    if by is not None:
        axes.legend(loc="lower left", bbox_to_anchor=(-0.12, -0.1), fontsize="small")
    return figure


def _over(results: Results, by: list[str], value: str) -> pd.Series:
    """Return a figure by columns: the median of each group, or the share of successes."""
    instance_of(results, Results, "results")
    if value == SHARE:
        return results.survival(by)[SHARE]
    results.survival([*by, value])  # says what columns there are, where one is none
    return results.table.groupby(by, sort=False, dropna=False)[value].median()


def _firsts(column: pd.Series) -> list[object]:
    return list(dict.fromkeys(key[0] for key in column.index))


def _name_ticks(axes: Axes, table: pd.DataFrame) -> None:
    columns, rows = (list(map(_short, index)) for index in (table.columns, table.index))
    axes.set_xticks(
        range(len(columns)), columns, rotation=90 if len(max(columns, key=len)) > 8 else 0
    )
    axes.set_yticks(range(len(rows)), rows)


def _short(level: object) -> str:
    return f"{level:.4g}" if isinstance(level, float) else str(level)


def _label(value: str) -> str:
    return "share that succeeded" if value == SHARE else value
