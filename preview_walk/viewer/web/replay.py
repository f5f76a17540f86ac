"""The loop of a record's page: play, speed, and any moment of it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from preview_walk.record.record import Record
from preview_walk.robots.robot import Robot
from preview_walk.viewer.web.pace import Pace
from preview_walk.viewer.web.picture import PICTURES, Picture
from preview_walk.viewer.web.plots import Plots
from preview_walk.viewer.web.stage import stage_on
from preview_walk.viewer.web.traces import SPAN, recorded

if TYPE_CHECKING:
    from viser import ViserServer

SPEEDS = {"1/10": 0.1, "1/4": 0.25, "1/2": 0.5, "1": 1.0, "2": 2.0, "4": 4.0}
"""Speeds of a replay over real time."""

PLOT_EVERY = 5
"""Plots are drawn at every so many pictures."""


def run_replay(record: Record, robot: Robot, server: ViserServer) -> None:
    """Replay a record on a page until it is closed there, or by Ctrl-C."""
    replay = Replay(record, robot, server)
    try:
        while not replay.closed:
            replay.picture()
    except KeyboardInterrupt:
        pass


class Replay:
    """A record and its page; `picture` goes on by one picture.

    Attributes:
        closed: whether the visitor has closed it.
    """

    def __init__(self, record: Record, robot: Robot, server: ViserServer) -> None:
        gui = server.gui
        self.closed = False
        self._server = server
        self._time, self._qpos, self._rows = record.time, record.qpos, recorded(record)
        self._picture = Picture(server, stage_on(robot, record.ground), robot.com_height)
        first, last = float(self._time[0]), float(self._time[-1])
        self._state = gui.add_markdown("")
        self._play = gui.add_button("Pause")
        self._slider: Any = gui.add_slider(
            "time [s]", min=first, max=max(last, first + 0.01), step=0.01, initial_value=first
        )
        self._speed: Any = gui.add_dropdown("speed", tuple(SPEEDS), initial_value="1")
        self._follow = gui.add_checkbox("follow", True, hint="The view walks along.")
        self._close = gui.add_button("Close")
        self._plots = Plots(gui)
        self._pace = Pace(PICTURES)
        self._playing, self._at, self._count = True, first, 0
        self._play.on_click(lambda _: self._set(not self._playing))
        self._close.on_click(lambda _: setattr(self, "closed", True))
        self._slider.on_update(self._go)

    def _set(self, playing: bool) -> None:
        if playing and self._at >= self._time[-1]:
            self._at = float(self._time[0])
        self._playing = playing
        self._play.label = "Pause" if playing else "Play"

    def _go(self, _: Any) -> None:
        wanted = float(self._slider.value)
        if wanted != round(self._at, 2):  # else it is the replay's own move of the slider
            self._at = wanted

    def picture(self) -> None:
        """Show the moment, and go on to the next."""
        tick = min(int(np.searchsorted(self._time, self._at - 1e-9)), len(self._time) - 1)
        self._picture.follow = bool(self._follow.value)
        self._picture.show(self._qpos[tick], self._rows[tick])
        if self._count % PLOT_EVERY == 0:
            past = np.searchsorted(self._time, self._time[tick] - SPAN)
            self._plots.show(self._rows[int(past) : tick + 1])
            self._state.content = f"**{self._time[tick]:.3f} s** · {self._pace.rate:.0f} pictures/s"
        self._count += 1
        if self._playing and self._server.get_clients():
            self._at += SPEEDS[self._speed.value] / PICTURES
            if self._at >= self._time[-1]:
                self._at = float(self._time[-1])
                self._set(False)
            self._slider.value = round(self._at, 2)
        self._pace.wait()
