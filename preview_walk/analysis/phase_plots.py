"""Phase timing: the gait diagram, and how early or late each lift and landing was."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.ticker import MaxNLocator
from numpy.typing import NDArray

from preview_walk.analysis.style import COM, FOOT_COLOURS, ZMP, finish, legend, mark_fall, spans
from preview_walk.record.record import Record
from preview_walk.types import DOUBLE_SUPPORT, FEET, LEFT_SUPPORT, RIGHT_SUPPORT, Array


def contact(phase: NDArray[np.int8], foot: str) -> NDArray[np.bool_]:
    """Return where (N,) a foot is on the ground, from the support phases."""
    own = LEFT_SUPPORT if foot == "left" else RIGHT_SUPPORT
    on_ground: NDArray[np.bool_] = (phase == DOUBLE_SUPPORT) | (phase == own)
    return on_ground


def timing_errors(record: Record) -> tuple[Array, Array]:
    """Return (lift, landing) errors (S,) in s of the steps taken: measured minus planned.

    nan where the foot did not leave the ground, or was not seen to leave or come back.
    """
    walked = record.plans.walked(float(record.time[-1]))
    errors = np.full((2, len(walked.landings)), np.nan)
    on_ground = {k: contact(record.phase, foot) for k, foot in enumerate(FEET)}
    for i, (lift, land) in enumerate(zip(walked.lifts, walked.landings, strict=True)):
        grounded = on_ground[int(walked.foot[2 + i])]
        middle = int(np.searchsorted(record.time, 0.5 * (lift + land)))
        if middle >= len(record) or grounded[middle]:
            continue
        before, after = np.flatnonzero(grounded[:middle]), np.flatnonzero(grounded[middle:])
        if len(before):
            errors[0, i] = record.time[before[-1] + 1] - lift
        if len(after):
            errors[1, i] = record.time[middle + after[0]] - land
    return errors[0], errors[1]


def draw_phases(ax: Axes, record: Record) -> None:
    """Draw the gait diagram: when each foot was planned on the ground, and when it was."""
    rows = []
    for k, foot in enumerate(FEET):
        for row, phase, alpha in (
            (2 * k, record.phase_ref, 0.45),
            (2 * k + 1, record.phase, 1.0),
        ):
            bars = spans(record.time, contact(phase, foot))
            ax.broken_barh(
                bars, (row - 0.4, 0.8), facecolor=FOOT_COLOURS[foot], alpha=alpha, linewidth=0
            )
        rows += [f"{foot}, planned", f"{foot}, measured"]
    ax.set_yticks(range(len(rows)), rows)
    ax.set_ylim(len(rows) - 0.5, -0.5)
    ax.set_xlim(record.time[0], max(record.time[-1], record.time[0] + record.dt))
    mark_fall(ax, record)
    finish(ax, "Phase timing: feet on the ground", "")


def draw_timing_errors(ax: Axes, record: Record) -> None:
    """Draw how late (above 0) or early each lift and landing came, ms, step by step."""
    lift, land = timing_errors(record)
    steps = np.arange(1, len(lift) + 1)
    ax.axhline(0.0, color="0.5", linewidth=0.8)
    ax.plot(steps, 1e3 * lift, "^", color=COM, markersize=5, label="lift")
    ax.plot(steps, 1e3 * land, "v", color=ZMP, markersize=5, label="landing")
    finish(ax, "Measured minus planned", "late by [ms]", time_axis=False)
    ax.set_xlabel("step")
    ax.xaxis.set_major_locator(MaxNLocator(integer=True))
    legend(ax)
