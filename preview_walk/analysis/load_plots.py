"""Loads over time: contact forces and friction used, torques against their limits."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes

from preview_walk.analysis.style import (
    COM,
    MEASURED,
    PLANNED,
    ZMP,
    draw_pair,
    finish,
    legend,
    mark_fall,
    planned_key,
    shade_phases,
)
from preview_walk.record.record import Record
from preview_walk.record.summarize import torque_ratios
from preview_walk.types import Array

_LOADED = 0.05
"""Share of the weight below which a foot's friction ratio says nothing."""

_LABELS = 50
"""So many joint names find room beside the torque map; of more only every second is written."""

_COLUMNS = 1500
"""Columns of the torque map; more ticks than that are taken together by their maximum."""


def draw_forces(ax: Axes, record: Record) -> None:
    """Draw the vertical force under each foot, measured and as the QP planned it, N."""
    patches = shade_phases(ax, record)
    for foot, colour, force, planned in (
        ("left", COM, record.left_force, record.left_force_ref),
        ("right", ZMP, record.right_force, record.right_force_ref),
    ):
        draw_pair(ax, record.time, (force[:, 2], planned[:, 2]), colour, foot)
    ax.axhline(record.run.weight, color="0.5", linewidth=0.8, linestyle=":", label="weight")
    mark_fall(ax, record)
    finish(ax, "Contact forces, vertical", "force [N]")
    planned_too = np.isfinite(record.left_force_ref).any()
    legend(ax, *([planned_key("planned by the QP")] if planned_too else []), *patches)


def draw_friction(ax: Axes, record: Record) -> None:
    """Draw horizontal over vertical force of each loaded foot, and the ground's friction."""
    patches = shade_phases(ax, record)
    for foot, colour, force in (
        ("left", COM, record.left_force),
        ("right", ZMP, record.right_force),
    ):
        loaded = force[:, 2] > _LOADED * record.run.weight
        ratio = np.full(len(record), np.nan)
        ratio[loaded] = np.hypot(force[loaded, 0], force[loaded, 1]) / force[loaded, 2]
        ax.plot(record.time, ratio, color=colour, **MEASURED, label=foot)
    if np.isfinite(record.run.friction):
        ax.axhline(record.run.friction, color="black", **PLANNED, label="friction of the ground")
    ax.set_ylim(bottom=0)
    mark_fall(ax, record)
    finish(ax, "Friction used by the loaded feet", "horizontal / vertical force")
    legend(ax, *patches)


def _motors(record: Record) -> tuple[list[str], Array]:
    """Return names and |tau| / limit (N, motors) of the joints that have a motor."""
    ratios = torque_ratios(record, record.run)
    count = ratios.shape[1]
    names = record.run.joint_names or range(count)
    has_motor = [k for k in range(count) if np.isfinite(ratios[:, k]).any()]
    return [str(names[k]) for k in has_motor], ratios[:, has_motor]


def draw_torques(ax: Axes, record: Record) -> None:
    """Draw every motor's torque as a share of its limit over time, as a colour map."""
    names, ratios = _motors(record)
    block = -(-len(record) // _COLUMNS)
    padded = np.pad(ratios, ((0, -len(ratios) % block), (0, 0)), constant_values=0.0)
    peaks = np.nan_to_num(padded).reshape(-1, block, len(names)).max(axis=1)
    end = float(record.time[0]) + len(padded) * record.dt
    image = ax.imshow(
        peaks.T,
        aspect="auto",
        interpolation="nearest",
        cmap="cividis",
        vmin=0.0,
        vmax=1.0,
        extent=(float(record.time[0]), end, len(names) - 0.5, -0.5),
    )
    figure = ax.get_figure()
    if figure is not None:
        figure.colorbar(image, ax=ax, label="|torque| / limit", pad=0.01)
    every = -(-len(names) // _LABELS) or 1
    size = max(4, min(8, 200 // max(1, len(names))))
    ax.set_yticks(range(0, len(names), every), names[::every], fontsize=size)
    mark_fall(ax, record)
    finish(ax, "Torques against their limits", "")
    ax.grid(False)


def draw_torque_peaks(ax: Axes, record: Record) -> None:
    """Draw each motor's largest torque as a share of its limit."""
    names, ratios = _motors(record)
    peaks = np.nanmax(ratios, axis=0) if len(names) else np.zeros(0)
    ax.barh(range(len(names)), peaks, color=[ZMP if peak > 0.9 else COM for peak in peaks])
    ax.axvline(1.0, color="black", **PLANNED)
    ax.set_ylim(len(names) - 0.5, -0.5)
    ax.set_yticks([])
    ax.set_xlim(0, max(1.05, *peaks) if len(names) else 1.05)
    finish(ax, "Peaks", "", time_axis=False)
    ax.set_xlabel("share of the limit")
