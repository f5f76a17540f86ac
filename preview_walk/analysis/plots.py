"""The plots of a run, each as a figure or a file, from its record alone.

Every picture is seen from the start: x along the first heading, y to its left, so that a walk looks
the same wherever it began. Planned is dashed, measured is solid.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from preview_walk.analysis.frame import from_start
from preview_walk.analysis.load_plots import (
    draw_forces,
    draw_friction,
    draw_torque_peaks,
    draw_torques,
)
from preview_walk.analysis.motion_plots import draw_axis, draw_errors, draw_feet
from preview_walk.analysis.names import OVERVIEW, SINGLE
from preview_walk.analysis.phase_plots import draw_phases, draw_timing_errors
from preview_walk.analysis.style import new_figure, picture_path, save_figure
from preview_walk.analysis.top_view import draw_top_view
from preview_walk.arguments import LARGEST, instance_of, shown
from preview_walk.errors import InvalidInput
from preview_walk.files import OutputError, as_path, is_folder, short
from preview_walk.record.record import Record


def top_view(record: Record) -> Figure:
    """Draw footprints, ZMP and CoM from above, planned and measured."""
    _require_ticks(record)
    width, height = np.ptp(from_start(record, record.com[:, :2]), axis=0) + 0.6
    figure = new_figure(12, float(np.clip(11 * height / width + 1.6, 3.2, 12)))
    draw_top_view(figure.subplots(), record)
    return figure


def com_dcm_zmp(record: Record) -> Figure:
    """Draw x(t) and y(t) of CoM, DCM and ZMP, and the CoM's error, over shaded phases."""
    figure = new_figure(12, 11)
    forward, sideways, errors = figure.subplots(3, 1)
    draw_axis(forward, record, 0)
    draw_axis(sideways, record, 1)
    draw_errors(errors, record)
    return figure


def feet(record: Record) -> Figure:
    """Draw the heights of the sole centres over shaded phases."""
    figure = new_figure(12, 4)
    draw_feet(figure.subplots(), record)
    return figure


def forces(record: Record) -> Figure:
    """Draw the vertical contact forces and the friction used."""
    figure = new_figure(12, 8)
    above, below = figure.subplots(2, 1)
    draw_forces(above, record)
    draw_friction(below, record)
    return figure


def torques(record: Record) -> Figure:
    """Draw torques as shares of their limits: over time, and their peaks."""
    figure = new_figure(12, 7)
    left, right = figure.subplots(1, 2, width_ratios=[5, 1])
    draw_torques(left, record)
    draw_torque_peaks(right, record)
    return figure


def phases(record: Record) -> Figure:
    """Draw the gait diagram, planned and measured, and the timing error of each step."""
    figure = new_figure(12, 6)
    above, below = figure.subplots(2, 1)
    draw_phases(above, record)
    draw_timing_errors(below, record)
    return figure


def overview(record: Record) -> Figure:
    """Draw the whole run on one page."""
    figure = new_figure(14, 15)
    grid = figure.add_gridspec(4, 2, height_ratios=[1.0, 1.0, 0.8, 1.2])
    draw_top_view(figure.add_subplot(grid[0, :]), record)
    draw_axis(figure.add_subplot(grid[1, 0]), record, 0)
    draw_axis(figure.add_subplot(grid[1, 1]), record, 1)
    draw_feet(figure.add_subplot(grid[2, 0]), record)
    draw_forces(figure.add_subplot(grid[2, 1]), record)
    draw_torques(figure.add_subplot(grid[3, 0]), record)
    draw_phases(figure.add_subplot(grid[3, 1]), record)
    return figure


PLOTS: dict[str, Callable[[Record], Figure]] = dict(
    zip(SINGLE, (top_view, com_dcm_zmp, feet, forces, torques, phases), strict=True)
)
"""Every single plot by the name of its file."""


def figure(record: Record, name: str = OVERVIEW) -> Figure:
    """Return a plot of a run as a figure of matplotlib, which notebooks show.

    Args:
        record: of the run.
        name: "overview", or a name in `PLOTS`.

    Raises:
        InvalidInput: there is no such plot, or the record is empty or not finite.
    """
    draw = overview if name == OVERVIEW else _plot_of(name)
    _require_ticks(record)
    return draw(record)


def plot(record: Record, path: str | os.PathLike[str]) -> Path:
    """Write the overview of a run to one picture (.png, .pdf, .svg, ...); return its path.

    Raises:
        InvalidInput: the record is empty or not finite, or matplotlib does not know the suffix.
        OutputError: the file cannot be written.
    """
    _require_ticks(record)
    target = picture_path(path)
    return save_figure(overview(record), target)


def save_plot(record: Record, name: str, path: str | os.PathLike[str]) -> Path:
    """Write the plot of that name in `PLOTS` to one picture; return its path.

    Raises:
        InvalidInput: there is no such plot, the record is empty, or matplotlib does not know the
            suffix.
        OutputError: the file cannot be written.
    """
    draw = _plot_of(name)
    _require_ticks(record)
    target = picture_path(path)
    return save_figure(draw(record), target)


def plot_all(record: Record, folder: str | os.PathLike[str]) -> list[Path]:
    """Write every plot of `PLOTS` to an existing folder as `NAME.png`; return their paths.

    Raises:
        InvalidInput: the record is empty, or the folder no path.
        OutputError: there is no such folder, or a file cannot be written.
    """
    _require_ticks(record)
    if not is_folder(folder):
        raise OutputError(f"cannot write to {short(as_path(folder))}: there is no such folder.")
    return [save_plot(record, name, as_path(folder) / f"{name}.png") for name in PLOTS]


def _plot_of(name: str) -> Callable[[Record], Figure]:
    if not isinstance(name, str) or name not in PLOTS:
        raise InvalidInput(
            f"a plot's name must be one of {', '.join(PLOTS)}, got {shown(name)}.", argument="name"
        )
    return PLOTS[name]


def _require_ticks(record: Record) -> None:
    if not len(instance_of(record, Record, "record")):
        raise InvalidInput(
            "a plot needs a record of at least one tick, got an empty one.", "record"
        )
    for name in ("left_foot_ref", "right_foot_ref", "com", "com_ref", "zmp_ref"):
        array = record.arrays()[name]
        if not (np.abs(array) < LARGEST).all():
            raise InvalidInput(
                f"a plot needs a record whose {name} is finite and within {LARGEST:g} m, "
                "got one with other numbers.",
                "record",
            )
