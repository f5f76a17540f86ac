"""The loop of a live walk: it walks in real time while a page is open."""

from __future__ import annotations

from typing import TYPE_CHECKING

from preview_walk.simulation.walk import STAND_AFTER, Progress, Walk
from preview_walk.viewer.web.controls import Controls
from preview_walk.viewer.web.pace import Pace
from preview_walk.viewer.web.picture import PICTURES, Picture
from preview_walk.viewer.web.plots import Plots
from preview_walk.viewer.web.stage import configuration, stage_of
from preview_walk.viewer.web.traces import LiveTraces

if TYPE_CHECKING:
    from viser import ViserServer

PLOT_EVERY = 5
"""Plots are drawn at every so many pictures."""

IDLE = 60.0
"""A walk that stands and is asked for nothing pauses after this time (s): its record would grow for
nothing."""


def run_live(walk: Walk, server: ViserServer, progress: Progress | None = None) -> None:
    """Run a walk by what the page asks for until it is ended there, or by Ctrl-C.

    Args:
        walk: the walk.
        server: of an empty page.
        progress: called at every picture with the simulated time and the end of the plan (s).
    """
    live = LiveWalk(walk, server, progress)
    try:
        while not (live.controls.ended or walk.interrupted):
            live.picture()
    except KeyboardInterrupt:
        walk.interrupt()


class LiveWalk:
    """A walk and its page; `picture` makes both go on by one picture."""

    def __init__(self, walk: Walk, server: ViserServer, progress: Progress | None) -> None:
        self._walk, self._server, self._progress = walk, server, progress
        self._picture = Picture(server, stage_of(walk), walk.robot.com_height)
        self.controls = Controls(server.gui, walk)
        self._plots = Plots(server.gui)
        self._traces = LiveTraces(walk, PICTURES)
        self._pace = Pace(PICTURES)
        self._count, self._inputs, self._idle_since = 0, 0, walk.time
        self._why = ""

    def picture(self) -> None:
        """Walk on until the next picture, if the page says so, and show it."""
        self._tell()
        self._advance()
        self._traces.add()
        rows = self._traces.rows
        self._picture.follow = bool(self.controls.follow.value)
        self._picture.show(configuration(self._walk), rows[-1] if len(rows) else None)
        if self._count % PLOT_EVERY == 0:
            self._plots.show(rows)
            self.controls.say(self._state())
        self._count += 1
        self._pace.wait()

    def _advance(self) -> None:
        walk, controls = self._walk, self.controls
        for _ in range(controls.take_ticks()):
            if not walk.fallen:
                walk.tick()
        self._rest()
        if controls.playing and self._server.get_clients():
            walk.run(until=walk.time + 1.0 / PICTURES)

    def _rest(self) -> None:
        """Pause a walk that has stood for long and is asked for nothing."""
        walk, controls = self._walk, self.controls
        if not walk.finished or controls.inputs != self._inputs:
            self._inputs, self._idle_since = controls.inputs, walk.time
        elif walk.time - self._idle_since > IDLE and controls.playing:
            controls.play(False)

    def _tell(self) -> None:
        if self._progress is not None:
            self._progress(self._walk.time, max(self._walk.plan.end + STAND_AFTER, self._walk.time))

    def _state(self) -> str:
        walk = self._walk
        if walk.fallen:
            return f"**{walk.time:.3f} s** · fell: {walk.fall_reason}"
        push = float((walk.plant.push**2).sum() ** 0.5)
        pushed = f" · pushed with {push:.0f} N" if push else ""
        paused = "" if self.controls.playing else " · paused"
        return f"**{walk.time:.3f} s** · {self._pace.rate:.0f} pictures/s{pushed}{paused}"
