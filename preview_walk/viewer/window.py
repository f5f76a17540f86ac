"""MuJoCo's live viewer on a running walk, in real time; the mouse can shove the robot."""

from __future__ import annotations

from time import perf_counter, sleep
from typing import TYPE_CHECKING

import mujoco.viewer

from preview_walk.arguments import shown
from preview_walk.errors import InvalidInput
from preview_walk.simulation.pushes import base_of
from preview_walk.simulation.scene import Scene
from preview_walk.simulation.world import World

if TYPE_CHECKING:
    from preview_walk.simulation.walk import Progress, Walk

REFRESH = 1.0 / 60.0
"""Time (s) between two pictures."""


def run_in_viewer(walk: Walk, progress: Progress | None = None) -> None:
    """Run a walk made with `visuals=True` in the live viewer until its end or a closed window.

    Double-click a body and drag with Ctrl and the right button to push it.
    """
    if not isinstance(getattr(walk, "plant", None), World | Scene):
        raise InvalidInput(f"a live window needs a walk in MuJoCo, got {shown(walk)}.", "walk")
    world = walk.plant
    assert isinstance(world, World | Scene)
    with mujoco.viewer.launch_passive(world.model, world.data) as window:
        body = base_of(world.model)
        window.cam.type = mujoco.mjtCamera.mjCAMERA_TRACKING
        window.cam.trackbodyid = body
        window.cam.distance = 3.2 * walk.robot.com_height
        begun, first = perf_counter(), walk.time
        try:
            while window.is_running() and not walk.finished:
                walk.run(until=walk.time + REFRESH, progress=progress)
                window.sync()
                ahead = (walk.time - first) - (perf_counter() - begun)
                if ahead > 0.0:
                    sleep(ahead)
        except KeyboardInterrupt:  # between two stretches of the walk, which is kept
            walk.interrupt()
