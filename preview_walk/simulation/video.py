"""Pictures of a recorded walk: the robot in its visual meshes, rendered without a screen."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from pathlib import Path

import mujoco
import numpy as np
from numpy.typing import NDArray

from preview_walk.errors import PreviewWalkError
from preview_walk.robots.load import visual_model
from preview_walk.robots.robot import Robot
from preview_walk.robots.state import to_mujoco
from preview_walk.simulation.record import Record

FPS = 30
"""Frames per second of a video; it runs in real time."""

SIZE = (720, 1280)
"""Height and width of a frame (pixels)."""

Frame = NDArray[np.uint8]


class VideoError(PreviewWalkError, RuntimeError):
    """A picture could not be rendered or written; says why."""


def frames(
    record: Record, robot: Robot, times: Sequence[float], size: tuple[int, int] = SIZE
) -> Iterator[Frame]:
    """Yield a picture (height, width, 3) of the robot at each of `times` (s).

    The recorded configurations are shown, nothing is simulated again. The camera walks along.

    Raises `VideoError` where there is no OpenGL to render with.
    """
    # Off screen MuJoCo needs EGL; it reads this when its renderer is first made.
    if not os.environ.get("DISPLAY"):
        os.environ.setdefault("MUJOCO_GL", "egl")
    model = visual_model(robot)
    model.vis.global_.offheight, model.vis.global_.offwidth = size
    data = mujoco.MjData(model)
    try:
        renderer = mujoco.Renderer(model, *size)
    except Exception as error:
        raise VideoError(f"no OpenGL to render with off screen (EGL): {error}") from error
    camera = mujoco.MjvCamera()
    camera.distance = 3.2 * robot.com_height
    camera.elevation = -12.0
    q0 = record.q[0]
    heading = np.degrees(np.arctan2(2 * (q0[6] * q0[5] + q0[3] * q0[4]), 1 - 2 * (q0[4] ** 2 + q0[5] ** 2)))
    camera.azimuth = heading + 125.0
    still = np.zeros(model.nv)
    with renderer:
        for time in times:
            tick = min(int(np.searchsorted(record.time, time)), len(record) - 1)
            to_mujoco(record.q[tick], still, data.qpos, data.qvel)
            mujoco.mj_kinematics(model, data)
            mujoco.mj_camlight(model, data)
            camera.lookat[:] = (*record.com[tick, :2], 0.95 * robot.com_height)
            renderer.update_scene(data, camera)
            yield renderer.render()


def render_video(record: Record, robot: Robot, path: str | os.PathLike[str]) -> Path:
    """Write an mp4 of a recorded walk in real time and return its path.

    Raises `VideoError` where it cannot be rendered or encoded.
    """
    import imageio.v2 as imageio

    target = Path(path)
    count = max(1, int((record.time[-1] - record.time[0]) * FPS))
    times = record.time[0] + np.arange(count) / FPS
    try:
        with imageio.get_writer(
            target, format="FFMPEG", fps=FPS, codec="libx264", quality=8, macro_block_size=8
        ) as writer:
            for frame in frames(record, robot, times.tolist()):
                writer.append_data(frame)
    except (OSError, ValueError, ImportError) as error:
        raise VideoError(f"cannot write the video {target}: {error}") from error
    return target
