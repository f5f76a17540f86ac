"""The panel of a live walk: play, velocity, push and gains."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from math import atan2, cos, radians, sin
from typing import TYPE_CHECKING, Any

import numpy as np

from preview_walk.errors import InvalidInput
from preview_walk.footsteps.velocity import saturated
from preview_walk.simulation.walk import Walk

if TYPE_CHECKING:
    from viser import GuiApi

PUSH_TIME = 0.2
"""Seconds that a push lasts."""

MOST_IMPULSE = 100.0
"""Of a push, N·s: TALOS falls well below it."""

GAINS = {"dcm": (5.0, 40.0), "foot": (10.0, 60.0), "torso": (4.0, 40.0), "posture": (2.0, 20.0)}
"""Gains of the tracker that the panel changes, with the range of their sliders, 1/s and rad/s."""

FAST = 9.0
"""A velocity that no robot reaches: what it is scaled down to is the end of a slider."""


class Controls:
    """What a visitor of the page asks for; the loop of the walk reads it.

    Attributes:
        playing: whether the walk goes on.
        ended: whether the walk is over by the visitor's will.
        inputs: how many times something was asked for.
    """

    def __init__(self, gui: GuiApi, walk: Walk) -> None:
        """Add the controls to the page's panel.

        Args:
            gui: of the page.
            walk: that they steer.
        """
        self.playing, self.ended, self.inputs = True, False, 0
        self._ticks = 0
        self._walk = walk
        self._state = gui.add_markdown("")
        self._play = gui.add_button("Pause")
        self._step = gui.add_button("One tick", disabled=True)
        self._end = gui.add_button("End the walk")
        self.follow = gui.add_checkbox("follow", True, hint="The view walks along.")
        with gui.add_folder("Velocity"):
            self._velocity = [
                _speed_slider(gui, walk, label, axis)
                for axis, label in enumerate(("forward [m/s]", "left [m/s]", "turn [rad/s]"))
            ]
            self._stop = gui.add_button("Stand")
        with gui.add_folder("Push"):
            self._angle = _slider(gui, "towards [deg]", (-180.0, 180.0), 15.0, 90.0)
            self._impulse = _slider(gui, "impulse [N·s]", (1.0, MOST_IMPULSE), 1.0, 15.0)
            self._push = gui.add_button("Push")
        with gui.add_folder("Gains", expand_by_default=False):
            self._gains = {
                name: _slider(gui, name, ends, 0.5, float(getattr(walk.gains, name)))
                for name, ends in GAINS.items()
            }
        self._connect()

    def _connect(self) -> None:
        """Let the controls do what they say."""
        self._on(self._play.on_click, lambda: self.play(not self.playing))
        self._on(self._step.on_click, self._one_tick)
        self._on(self._end.on_click, lambda: setattr(self, "ended", True))
        for slider in self._velocity:
            self._on(slider.on_update, self._command)
        self._on(self._stop.on_click, self._stand)
        self._on(self._push.on_click, self._shove)
        for slider in self._gains.values():
            self._on(slider.on_update, self._tune)

    def _on(self, event: Callable[[Any], Any], act: Callable[[], object]) -> None:
        """Let an event act; what is refused is told on the page it came from."""

        def answer(what: Any) -> None:
            self.inputs += 1
            try:
                act()
            except InvalidInput as refusal:
                if what.client is not None:
                    what.client.add_notification("That is not possible", str(refusal), color="red")

        event(answer)

    def play(self, on: bool) -> None:
        """Let the walk go on, or pause it."""
        self.playing = on
        self._play.label = "Pause" if on else "Play"
        self._step.disabled = on

    def take_ticks(self) -> int:
        """Return how many single ticks were asked for since the last time."""
        ticks, self._ticks = self._ticks, 0
        return ticks

    def say(self, text: str) -> None:
        """Show a line of text above the controls."""
        if self._state.content != text:
            self._state.content = text

    def _one_tick(self) -> None:
        self._ticks += 1

    def _command(self) -> None:
        vx, vy, wz = (float(slider.value) for slider in self._velocity)
        self._walk.command(vx, vy, wz)

    def _stand(self) -> None:
        for slider in self._velocity:
            slider.value = 0.0
        self._walk.command(0.0, 0.0, 0.0)

    def _shove(self) -> None:
        """Push the base: 0 degrees is to where the robot faces, 90 to its left."""
        torso = self._walk.walker.body.dynamics.torso.rotation
        yaw = atan2(torso[1, 0], torso[0, 0]) + radians(self._angle.value)
        force = float(self._impulse.value) / PUSH_TIME
        self._walk.push((force * cos(yaw), force * sin(yaw), 0.0), PUSH_TIME)

    def _tune(self) -> None:
        chosen = {name: float(slider.value) for name, slider in self._gains.items()}
        self._walk.gains = replace(self._walk.gains, **chosen)


def _speed_slider(gui: GuiApi, walk: Walk, label: str, axis: int) -> Any:
    """Return the slider of a velocity, from what the robot's legs can do to what they can do."""
    wish = np.zeros(3)
    wish[axis] = FAST
    low, high = (
        round(saturated((sign * wish).tolist(), walk.limits)[axis], 2) for sign in (-1.0, 1.0)
    )
    return _slider(gui, label, (low, high), 0.01, walk.commanded[axis])


def _slider(gui: GuiApi, label: str, ends: tuple[float, float], step: float, value: float) -> Any:
    """Return a slider at a value, which is within its ends."""
    low, high = min(ends[0], value), max(ends[1], value)
    return gui.add_slider(label, min=low, max=high, step=step, initial_value=value)
