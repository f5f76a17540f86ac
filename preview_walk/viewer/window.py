"""MuJoCo's live viewer on a running walk, in real time; keys steer, the mouse pushes the robot."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from time import perf_counter, sleep
from typing import TYPE_CHECKING, Any

import mujoco.viewer

from preview_walk.arguments import shown
from preview_walk.errors import InvalidInput
from preview_walk.simulation.pushes import base_of
from preview_walk.simulation.scene import Scene
from preview_walk.simulation.world import World
from preview_walk.stopping import Stop
from preview_walk.viewer.keys import steered

if TYPE_CHECKING:
    from preview_walk.simulation.walk import Progress, Walk

REFRESH = 1.0 / 60.0
"""Time (s) between two pictures."""

CLOSING = 10.0
"""Longest time (s) that a window may need to close."""


def run_in_viewer(walk: Walk, progress: Progress | None = None) -> None:
    """Run a walk made with `visuals=True` in the live viewer until its end or a closed window.

    The arrow keys change its speed and turn it, comma and period let it step aside, Enter lets it
    stand; a walk that was steered goes on until the window is closed. Double-click a body and drag
    with Ctrl and the right button to push it. Ctrl-C closes the window and ends the walk.
    """
    if not isinstance(getattr(walk, "plant", None), World | Scene):
        raise InvalidInput(f"a live window needs a walk in MuJoCo, got {shown(walk)}.", "walk")
    world = walk.plant
    assert isinstance(world, World | Scene)
    keyed = False

    def on_key(key: int) -> None:  # on the window's own thread
        nonlocal keyed
        velocity = None if walk.fallen else steered(key, walk)
        if velocity is not None:
            walk.command(*velocity)
            keyed = True

    # A window that is half open when Ctrl-C strikes takes the whole program down.
    with Stop() as stop, _window(world, on_key) as window:
        body = base_of(world.model)
        window.cam.type = mujoco.mjtCamera.mjCAMERA_TRACKING
        window.cam.trackbodyid = body
        window.cam.distance = 3.2 * walk.robot.com_height
        begun, first = perf_counter(), walk.time
        while window.is_running() and not stop.asked and (keyed or not walk.finished):
            walk.run(until=walk.time + REFRESH, progress=progress)
            window.sync()
            ahead = (walk.time - first) - (perf_counter() - begun)
            if ahead > 0.0:
                sleep(ahead)
        if stop.asked:
            walk.interrupt()


@contextmanager
def _window(world: World | Scene, on_key: Callable[[int], None]) -> Iterator[Any]:
    """Open MuJoCo's window on a world; at the end it is closed, and its thread has ended.

    A thread that still draws when the program ends takes it down with a segmentation fault.
    """
    before = set(threading.enumerate())
    with mujoco.viewer.launch_passive(world.model, world.data, key_callback=on_key) as window:
        started = set(threading.enumerate()) - before
        yield window
    for thread in started:
        thread.join(CLOSING)
