"""Motion over time: CoM, DCM and ZMP along an axis; heights of the feet."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes

from preview_walk.analysis.frame import from_start, start_frame
from preview_walk.analysis.style import (
    COM,
    DCM,
    MEASURED,
    ZMP,
    draw_pair,
    finish,
    legend,
    mark_fall,
    planned_key,
    shade_phases,
)
from preview_walk.geometry.planar import turn
from preview_walk.record.record import Record
from preview_walk.terrain.ground import FlatGround

SHOWN = 0.1
"""Ground deeper than this (m) below the lowest sole is not drawn."""


def draw_axis(ax: Axes, record: Record, axis: int) -> None:
    """Draw CoM, DCM and ZMP, measured and planned, over time in the start's frame.

    Args:
        ax: where to draw.
        record: the run.
        axis: 0 for x (along the first heading), 1 for y (to its left), m.
    """
    patches = shade_phases(ax, record)
    for name, points, ref, colour in (
        ("ZMP", record.zmp, record.zmp_ref, ZMP),
        ("DCM", record.dcm, record.dcm_ref, DCM),
        ("CoM", record.com[:, :2], record.com_ref[:, :2], COM),
    ):
        measured = from_start(record, points)[:, axis]
        planned = from_start(record, ref)[:, axis]
        draw_pair(ax, record.time, (measured, planned), colour, name)
    mark_fall(ax, record)
    title, label = (("Forward", "x [m]"), ("Sideways", "y, to the left [m]"))[axis]
    finish(ax, f"{title}: CoM, DCM and ZMP", label)
    legend(ax, planned_key(), *patches)


def draw_errors(ax: Axes, record: Record) -> None:
    """Draw the CoM's error, measured minus reference, in the start's frame, mm."""
    patches = shade_phases(ax, record)
    error = record.com - record.com_ref
    plane = 1e3 * turn(error[:, :2], -start_frame(record)[1])
    for name, values, colour in (
        ("x", plane[:, 0], COM),
        ("y", plane[:, 1], ZMP),
        ("z", 1e3 * error[:, 2], DCM),
    ):
        ax.plot(record.time, values, color=colour, **MEASURED, label=name)
    mark_fall(ax, record)
    finish(ax, "CoM, measured minus planned", "error [mm]")
    legend(ax, *patches)


def draw_feet(ax: Axes, record: Record) -> None:
    """Draw the height of the sole centres over time, mm above the first planned soles.

    Thin lines are the ground under them where it is not level.
    """
    patches = shade_phases(ax, record)
    ground = 0.5 * (record.left_foot_ref[0, 2, 3] + record.right_foot_ref[0, 2, 3])
    for foot, measured, planned in (
        ("left", record.left_foot, record.left_foot_ref),
        ("right", record.right_foot, record.right_foot_ref),
    ):
        colour = COM if foot == "left" else ZMP  # stronger than the shading of the same foot
        height, planned_height = (1e3 * (pose[:, 2, 3] - ground) for pose in (measured, planned))
        draw_pair(ax, record.time, (height, planned_height), colour, foot)
        if not isinstance(record.ground, FlatGround):
            under = record.ground.height(measured[:, 0, 3], measured[:, 1, 3]) - ground
            # Where the foot passes over a pit the picture would show nothing but its depth.
            shown = np.where(under > height.min() * 1e-3 - SHOWN, 1e3 * under, np.nan)
            ax.plot(record.time, shown, color=colour, linewidth=0.6, alpha=0.6)
    mark_fall(ax, record)
    finish(ax, "Height of the sole centres", "height [mm]")
    legend(ax, planned_key(), *patches)
