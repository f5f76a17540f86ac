"""CoM, ZMP and DCM beside the scene, planned dashed, measured solid; and as marks in it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.colors import to_hex

from preview_walk.analysis.style import COM, DCM, ZMP, darker
from preview_walk.types import Array
from preview_walk.viewer.web.nodes import ROOT
from preview_walk.viewer.web.traces import POINTS, SPAN, place

if TYPE_CHECKING:
    from viser import GuiApi, SceneApi

COLOURS = dict(zip(POINTS, (COM, ZMP, DCM), strict=True))
NAMES = dict(zip(POINTS, ("CoM", "ZMP", "DCM"), strict=True))
AXES = {"x": "x, forward at the start [m]", "y": "y, to the left [m]"}

HEIGHT, PANEL = 215, 360
"""Of a plot and the width of their panel, pixels."""

MARK = 0.025
"""Radius of a mark, m."""

MOST = 180
"""Rows of a plot; a longer record is thinned out."""


class Plots:
    """Two plots over time, of x and of y."""

    def __init__(self, gui: GuiApi) -> None:
        """Add the empty plots in a panel of their own."""
        self._plots: list[Any] = []
        panel = gui.add_panel()
        panel.dock_left()
        panel.set_width(PANEL)
        empty = np.full((1, 1 + 2 * len(POINTS)), np.nan)
        empty[:, 0] = 0.0
        with panel.add_tab("planned and measured"):
            for title in AXES.values():
                plot = gui.add_uplot(
                    data=tuple(empty.T),
                    series=({"label": "time [s]"}, *_series()),
                    title=title,
                    height=HEIGHT,
                    scales={"x": {"time": False, "auto": True}},
                    legend={"show": True, "live": False},
                )
                self._plots.append(plot)

    def show(self, rows: Array) -> None:
        """Show rows (n, `traces.WIDTH`) of the traces, those of the last `SPAN` seconds."""
        if not len(rows):
            return
        rows = rows[rows[:, 0] >= rows[-1, 0] - SPAN]
        rows = rows[:: -(-len(rows) // MOST)]
        count = 2 * len(POINTS)
        for axis, plot in enumerate(self._plots):
            first = 1 + axis * count
            plot.data = (
                np.ascontiguousarray(rows[:, 0]),
                *(np.ascontiguousarray(rows[:, first + k]) for k in range(count)),
            )


class Marks:
    """The three points in the scene, where they are measured."""

    def __init__(self, scene: SceneApi) -> None:
        """Add the marks to a scene that has its bodies already."""
        self._marks = {}
        for point, colour in COLOURS.items():
            rgb = int(colour[1:3], 16), int(colour[3:5], 16), int(colour[5:7], 16)
            name = f"{ROOT}/{NAMES[point]}"
            self._marks[point] = scene.add_icosphere(name, MARK, color=rgb, visible=False)
            scene.add_label(f"{name}/name", NAMES[point], position=(0.0, 0.0, 2.0 * MARK))

    def show(self, row: Array) -> None:
        """Put the marks where a row (`traces.WIDTH`,) has them; none where there is no contact."""
        for point, mark in self._marks.items():
            at = place(row, point)
            mark.visible = bool(np.isfinite(at).all())
            if mark.visible:
                mark.position = at


def _series() -> list[Any]:
    """Return how the lines of a plot look, in the order of a row."""
    series = []
    for point in POINTS:
        planned = to_hex(darker(COLOURS[point]))
        for label, look in (
            (NAMES[point], {"stroke": COLOURS[point], "width": 2.5}),
            ("planned", {"stroke": planned, "width": 1.5, "dash": (6, 4)}),
        ):
            series.append({**look, "label": label, "points": {"show": False}})
    return series
