"""The walk from above: footprints, ZMP and CoM, planned and measured."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Patch, Polygon

from preview_walk.analysis.frame import from_start, start_frame
from preview_walk.analysis.style import (
    COM,
    FOOT_COLOURS,
    MEASURED,
    PLANNED,
    ZMP,
    darker,
    finish,
    legend,
    planned_key,
)
from preview_walk.geometry.support import Sole
from preview_walk.record.record import Record
from preview_walk.terrain.ground import FlatGround
from preview_walk.types import FEET, Array

BESIDE = 0.3
"""The ground is drawn so far (m) around the walk."""

_USUAL_SOLE = Sole(0.1, 0.05)
"""Drawn where a record does not know its robot's soles."""


def planned_footprints(record: Record) -> list[tuple[int, Array, float, float]]:
    """Return every sole of the plan, as stepped on or, ahead, as the last plan has it.

    Returns:
        Tuples of the foot (0 left, 1 right), its pose (4, 4) in the world (m), when it lands and
        when that foot lifts again (s; infinite for the last).
    """
    if not len(record.plans):
        return []
    end = float(record.time[-1])
    walked, last = record.plans.walked(end), record.plans[-1]
    soles = list(zip(walked.foot, walked.pose, walked.lift, walked.land, strict=True))
    ahead = last.land > end
    soles += zip(
        last.foot[ahead], last.pose[ahead], last.lift[ahead], last.land[ahead], strict=True
    )
    footprints = []
    for i, (foot, pose, _, land) in enumerate(soles):
        lifts = (float(lift) for other, _, lift, _ in soles[max(i + 1, 2) :] if other == foot)
        footprints.append((int(foot), pose, float(land), next(lifts, np.inf)))
    return footprints


def measured_footprints(record: Record) -> list[tuple[int, Array]]:
    """Return (foot, pose (4, 4)) of the soles as measured in the middle of each stance."""
    first, end = float(record.time[0]), float(record.time[-1])
    footprints = []
    for foot, _, land, lift in planned_footprints(record):
        if land <= end:
            middle = 0.5 * (max(land, first) + min(lift, end))
            tick = min(int(np.searchsorted(record.time, middle)), len(record) - 1)
            poses = record.left_foot if FEET[foot] == "left" else record.right_foot
            footprints.append((foot, poses[tick]))
    return footprints


def draw_ground(ax: Axes, record: Record) -> None:
    """Shade the ground by its height around the walk, the higher the darker, where not level."""
    if isinstance(record.ground, FlatGround):
        return
    way = from_start(record, np.concatenate([record.left_foot, record.right_foot])[:, :2, 3])
    (x0, y0), (x1, y1) = way.min(axis=0) - BESIDE, way.max(axis=0) + BESIDE
    x, y = np.meshgrid(np.linspace(x0, x1, 400), np.linspace(y0, y1, 200))
    (cx, cy), yaw = start_frame(record)
    c, s = np.cos(yaw), np.sin(yaw)
    heights = record.ground.height(cx + c * x - s * y, cy + s * x + c * y)
    low = float(np.quantile(heights, 0.02))
    shade = np.clip(heights, low, None)
    ax.pcolormesh(x, y, shade, cmap="Greys", alpha=0.5, shading="auto", zorder=0, rasterized=True)


def draw_top_view(ax: Axes, record: Record) -> None:
    """Draw soles (planned dashed, measured filled), ZMP and CoM in the start's frame, m."""
    draw_ground(ax, record)
    known = bool(np.isfinite(record.run.sole).all())
    sole = Sole(*record.run.sole) if known else _USUAL_SOLE
    for foot, pose in measured_footprints(record):
        corners = from_start(record, sole.corners(pose)[:, :2])
        colour = FOOT_COLOURS[FEET[foot]]
        ax.add_patch(Polygon(corners, facecolor=colour, alpha=0.35, edgecolor="none"))
    for _, pose, _, _ in planned_footprints(record):
        corners = from_start(record, sole.corners(pose)[:, :2])
        ax.add_patch(Polygon(corners, fill=False, edgecolor="0.3", zorder=2, **PLANNED))
    for name, points, ref, colour in (
        ("ZMP", record.zmp, record.zmp_ref, ZMP),
        ("CoM", record.com[:, :2], record.com_ref[:, :2], COM),
    ):
        ax.plot(*from_start(record, points).T, color=colour, **MEASURED, label=f"{name} measured")
        ax.plot(*from_start(record, ref).T, color=darker(colour), **PLANNED)
    ax.set_aspect("equal", adjustable="datalim")
    ax.autoscale_view()
    (x, y), yaw = start_frame(record)
    where = ""
    if np.abs([x, y, yaw]).max() > 1e-3:
        where = f" (from the start at {x:.2f}, {y:.2f} m, heading {np.degrees(yaw):.0f}°)"
    finish(ax, f"Top view{where}", "y, to the left [m]", time_axis=False)
    ax.set_xlabel("x, along the first heading [m]")
    soles = [
        Patch(facecolor=FOOT_COLOURS[foot], alpha=0.35, label=f"{foot} sole measured")
        for foot in FEET
    ]
    outline = Patch(fill=False, edgecolor="0.3", linestyle="--", label="soles planned")
    legend(ax, planned_key("ZMP, CoM planned"), *soles, outline)
