"""What all plots share: colours safe for colour-blind readers, phase shading, saving."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from numpy.typing import NDArray

from preview_walk.errors import InvalidInput
from preview_walk.files import as_path, short, whole_file
from preview_walk.record.record import Record
from preview_walk.types import FEET, LEFT_SUPPORT, RIGHT_SUPPORT, Array, Foot

# Okabe and Ito's palette: told apart with any common colour vision, and in grey.
COM, DCM, ZMP = "#0072B2", "#CC79A7", "#D55E00"
FOOT_COLOURS: dict[Foot, str] = {"left": "#56B4E9", "right": "#E69F00"}
_LEGEND_COLUMN = 1.6
"""Width in inches of a legend's entry."""

PLANNED: dict[str, Any] = {"linestyle": (0, (4, 2)), "linewidth": 1.0}
MEASURED: dict[str, Any] = {"linestyle": "-", "linewidth": 1.6}


def draw_pair(ax: Axes, x: Array, pair: tuple[Array, Array], colour: str, name: str) -> None:
    """Draw a measured line, and what was planned dashed in a darker shade of its colour.

    `pair`: measured and planned, over `x`.
    """
    measured, planned = pair
    ax.plot(x, measured, color=colour, **MEASURED, label=f"{name} measured")
    ax.plot(x, planned, color=darker(colour), **PLANNED)


def darker(colour: str) -> tuple[float, float, float]:
    """Return half the brightness of a colour."""
    red, green, blue = to_rgb(colour)
    return 0.5 * red, 0.5 * green, 0.5 * blue


def planned_key(label: str = "planned") -> Line2D:
    """Return the legend's entry for all dashed lines."""
    return Line2D([], [], color="0.25", **PLANNED, label=label)


def new_figure(width: float, height: float) -> Figure:
    """Return a figure (inches) that needs no screen and touches no global state."""
    figure = Figure(figsize=(width, height), layout="constrained")
    FigureCanvasAgg(figure)
    return figure


def save_figure(figure: Figure, path: str | os.PathLike[str]) -> Path:
    """Write the figure, whole or not at all, in the format that the suffix names.

    Raises:
        InvalidInput: matplotlib does not know the suffix.
        OutputError: the file cannot be written.
    """
    target = picture_path(path)
    with whole_file(target) as part:
        figure.savefig(part, format=target.suffix.lstrip(".").lower(), dpi=150)
    return target


def picture_path(path: str | os.PathLike[str]) -> Path:
    """Return the path of a picture.

    Raises:
        InvalidInput: it is none, or matplotlib does not know the suffix.
    """
    target = as_path(path)
    formats = sorted(FigureCanvasAgg.get_supported_filetypes())
    if target.suffix.lstrip(".").lower() not in formats:
        name = short(Path(target.name))
        raise InvalidInput(
            f"a plot's file name must end in one of {', '.join(formats)}, got '{name}'.",
            "path",
        )
    return target


def finish(ax: Axes, title: str, ylabel: str, *, time_axis: bool = True) -> None:
    """Give the axes their title and labels, a light grid and no box."""
    ax.set_title(title, loc="left", fontsize=10, fontweight="bold")
    ax.set_ylabel(ylabel)
    if time_axis:
        ax.set_xlabel("time [s]")
    ax.grid(True, color="0.9", linewidth=0.6)
    ax.set_axisbelow(True)
    ax.spines[["top", "right"]].set_visible(False)


def spans(time: Array, mask: NDArray[np.bool_]) -> list[tuple[float, float]]:
    """Return (start, length) in s of the stretches where `mask` (N,) holds."""
    edges = np.flatnonzero(np.diff(np.concatenate([[0], mask.astype(np.int8), [0]])))
    dt = float(time[1] - time[0]) if len(time) > 1 else 0.0
    ends = np.append(time, time[-1] + dt)
    return [(float(ends[a]), float(ends[b] - ends[a])) for a, b in edges.reshape(-1, 2)]


def shade_phases(ax: Axes, record: Record) -> list[Patch]:
    """Shade the planned single supports over the time axis; return patches for the legend."""
    patches = []
    for foot, code in zip(FEET, (LEFT_SUPPORT, RIGHT_SUPPORT), strict=True):
        ax.broken_barh(
            spans(record.time, record.phase_ref == code),
            (0, 1),
            transform=ax.get_xaxis_transform(),
            facecolor=FOOT_COLOURS[foot],
            alpha=0.15,
            linewidth=0,
        )
        patches.append(Patch(facecolor=FOOT_COLOURS[foot], alpha=0.3, label=f"{foot} support"))
    ax.set_xlim(record.time[0], max(record.time[-1], record.time[0] + record.dt))
    return patches


def mark_fall(ax: Axes, record: Record) -> None:
    """Draw a line where the robot fell, if it did."""
    fall_time = record.run.fall_time
    if fall_time is not None:
        ax.axvline(fall_time, color="black", linewidth=1.2)
        ax.annotate(
            "fell",
            (fall_time, 1.0),
            xycoords=ax.get_xaxis_transform(),
            xytext=(-3, -3),
            textcoords="offset points",
            ha="right",
            va="top",
            fontsize=8,
            bbox={"boxstyle": "round,pad=0.2", "facecolor": "white", "edgecolor": "none"},
        )


def legend(ax: Axes, *extra: Artist) -> None:
    """Place the legend below the axes, where it hides no data, in as many columns as fit."""
    handles, _ = ax.get_legend_handles_labels()
    cell, width = ax.get_subplotspec(), ax.figure.bbox.width / ax.figure.dpi
    if cell is not None:
        width *= len(cell.colspan) / cell.get_gridspec().ncols
    ax.legend(
        handles=[*handles, *extra],
        loc="upper left",
        bbox_to_anchor=(0.0, -0.16),
        ncols=max(2, int(width / _LEGEND_COLUMN)),
        fontsize=8,
        frameon=False,
    )
