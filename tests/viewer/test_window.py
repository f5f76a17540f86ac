"""The live window, which stands in: keys steer the walk, Ctrl-C ends it and keeps it."""

from __future__ import annotations

import os
import signal
import threading
from collections.abc import Callable, Iterator
from types import SimpleNamespace
from typing import Any

import mujoco.viewer
import pytest

from preview_walk.robots.robot import Robot
from preview_walk.simulation.walk import Walk
from preview_walk.viewer.keys import COMMA, DOWN, ENTER, LEFT, PERIOD, RIGHT, UP, steered
from preview_walk.viewer.window import run_in_viewer


class Window:
    """What `launch_passive` returns, without a screen: at each picture it does the next thing."""

    def __init__(self, acts: Iterator[Callable[[Any], None]]) -> None:
        self.cam = SimpleNamespace()
        self.open, self.pictures, self.press = True, 0, lambda key: None
        self.closed = threading.Event()
        self._acts = acts
        self._thread = threading.Thread(target=self.closed.wait, daemon=True)

    def __enter__(self) -> Window:
        self._thread.start()
        return self

    def __exit__(self, *error: object) -> None:
        self.closed.set()

    def is_running(self) -> bool:
        return self.open

    def sync(self) -> None:
        self.pictures += 1
        next(self._acts, lambda window: None)(self)


@pytest.fixture
def shown(monkeypatch: pytest.MonkeyPatch) -> Callable[..., Window]:
    """Return a function that shows a walk in a window in which these things happen."""

    def show(walk: Walk, *acts: Callable[[Window], None]) -> Window:
        window = Window(iter(acts))

        def launch(model: Any, data: Any, key_callback: Callable[[int], None]) -> Window:
            window.press = key_callback
            return window

        monkeypatch.setattr(mujoco.viewer, "launch_passive", launch)
        run_in_viewer(walk)
        return window

    return show


def close(window: Window) -> None:
    window.open = False


def test_keys_add_up_and_stop_at_what_the_legs_can_do(talos: Robot) -> None:
    walk = Walk.standing(talos)
    for key, axis, sign in ((UP, 0, 1), (DOWN, 0, -1), (COMMA, 1, 1), (PERIOD, 1, -1)):
        velocity = steered(key, walk)
        assert velocity is not None
        assert velocity[axis] * sign > 0.0
    assert steered(LEFT, walk) == (0.0, 0.0, pytest.approx(0.1))
    assert steered(RIGHT, walk) == (0.0, 0.0, pytest.approx(-0.1))
    assert steered(ENTER, walk) == (0.0, 0.0, 0.0)
    assert steered(ord("A"), walk) is None
    walk.command(0.3, 0.0, 0.0)
    assert steered(UP, walk) == (pytest.approx(0.35), 0.0, 0.0)
    for _ in range(100):
        walk.command(*(steered(UP, walk) or (0.0, 0.0, 0.0)))
    fastest = walk.commanded
    assert 0.5 < fastest[0] < 3.0
    assert steered(DOWN, walk) == (pytest.approx(fastest[0] - 0.05), 0.0, 0.0)


def test_a_walk_that_was_steered_goes_on_until_the_window_is_closed(
    talos: Robot, shown: Callable[..., Window]
) -> None:
    walk = Walk.standing(talos)
    wait: list[Callable[[Window], None]] = [lambda window: None] * 70
    keys = [lambda window: window.press(UP), lambda window: window.press(ENTER)]
    window = shown(walk, *keys, *wait, close)
    assert window.pictures == 73
    assert walk.time > 1.1  # a walk that nobody steers ends 0.5 s after it stands
    assert walk.commanded == (0.0, 0.0, 0.0)
    assert not walk.interrupted


def test_without_a_key_it_ends_with_its_plan(talos: Robot, shown: Callable[..., Window]) -> None:
    walk = Walk.standing(talos)
    shown(walk)
    assert walk.finished
    assert not walk.interrupted


def test_ctrl_c_ends_the_walk_and_waits_for_the_window(
    talos: Robot, shown: Callable[..., Window]
) -> None:
    def ctrl_c(window: Window) -> None:
        os.kill(os.getpid(), signal.SIGINT)

    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        walk = Walk.standing(talos)
        walk.command(0.2, 0.0, 0.0)
        window = shown(walk, ctrl_c)
    finally:
        signal.signal(signal.SIGINT, before)
    assert walk.interrupted
    assert len(walk.record().time) > 0
    assert window.closed.is_set()
    assert not window._thread.is_alive()


def test_a_key_after_a_fall_does_nothing(talos: Robot, shown: Callable[..., Window]) -> None:
    walk = Walk.standing(talos, pushes=[])
    walk.push((20000.0, 0.0, 0.0), 0.2)
    walk.run(until=2.0)
    assert walk.fallen
    shown(walk, lambda window: window.press(UP), close)
    assert walk.commanded == (0.0, 0.0, 0.0)
