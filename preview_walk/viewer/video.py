"""Pictures of a recorded walk: the robot in its visual meshes, rendered without a screen."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

from preview_walk.arguments import function_of, instance_of, real_array, shown
from preview_walk.errors import InvalidInput
from preview_walk.files import as_path
from preview_walk.geometry.poses import midfeet
from preview_walk.offscreen import RenderError, off_screen
from preview_walk.record.record import Record
from preview_walk.robots.robot import Robot
from preview_walk.simulation.ground_geoms import model_on
from preview_walk.types import Array

FPS = 30
"""Frames per second of a video; it runs in real time."""

SIZE = (720, 1280)
"""Height and width of a frame (pixels)."""

SWAY = 1.0
"""The camera follows the mean of the CoM over this time (s) before and after: it does not sway."""

Frame = NDArray[np.uint8]


def frames(
    record: Record, robot: Robot, times: Sequence[float], size: tuple[int, int] = SIZE
) -> Iterator[Frame]:
    """Yield a picture (height, width, 3) of the robot at each of `times` (s).

    The recorded configurations are shown, nothing is simulated again. The camera walks along.

    Args:
        record: the walk.
        robot: the one that walked.
        times: when each picture is of, s.
        size: height and width of a picture, pixels.

    Raises:
        InvalidInput: an argument that cannot be, or a record of another robot.
        RenderError: there is no OpenGL to render with.
    """
    require_pictures(record, robot)
    wanted = real_array(times, "times", "times in s")
    if wanted.ndim != 1 or np.isnan(wanted).any():
        raise InvalidInput(f"times must be a row of times in s, got {shown(times)}.", "times")
    model = model_on(robot, record.ground, visuals=True)
    model.vis.global_.offheight, model.vis.global_.offwidth = size
    if mujoco.__version__.startswith("3."):  # whose floor shows specks of its own shadow
        model.vis.map.shadowclip = 3.0
    data = mujoco.MjData(model)
    camera = mujoco.MjvCamera()
    camera.distance = 3.2 * robot.com_height
    camera.elevation = -12.0
    heading = midfeet(record.left_foot_ref[0], record.right_foot_ref[0])[2]
    camera.azimuth = np.degrees(heading) + 125.0
    way = _smooth(record.com, round(SWAY / record.dt))
    qpos = record.qpos
    with off_screen():
        renderer = mujoco.Renderer(model, *size)
    with renderer:
        for time in times:
            tick = min(int(np.searchsorted(record.time, time)), len(record) - 1)
            data.qpos[:] = qpos[tick]
            mujoco.mj_kinematics(model, data)
            mujoco.mj_comPos(model, data)
            mujoco.mj_camlight(model, data)
            camera.lookat[:] = way[tick]
            renderer.update_scene(data, camera)
            yield renderer.render()


def require_pictures(record: Record, robot: Robot) -> None:
    """Raise `InvalidInput` unless this robot can be drawn as a record has it."""
    instance_of(record, Record, "record")
    instance_of(robot, Robot, "robot")
    if not len(record):
        raise InvalidInput(
            "a film needs a record of at least one tick, got an empty one.", "record"
        )
    if record.q.shape[1] != robot.pin.nq:
        raise InvalidInput(
            f"robot must be the one that walked, with {record.q.shape[1]} positions, "
            f"got {robot.name} with {robot.pin.nq}.",
            "robot",
        )
    if not (np.isfinite(record.q).all() and np.isfinite(record.left_foot_ref[0]).all()):
        raise InvalidInput("a film needs a record of finite positions, got others.", "record")


def _smooth(path: Array, ticks: int) -> Array:
    """Return a path (N, 3) averaged over so many ticks before and after each."""
    padded = np.pad(path, ((ticks + 1, ticks), (0, 0)), mode="edge")
    total = padded.cumsum(axis=0)
    average: Array = (total[2 * ticks + 1 :] - total[: -2 * ticks - 1]) / (2 * ticks + 1)
    return average


def render_video(
    record: Record,
    robot: Robot,
    path: str | os.PathLike[str],
    *,
    progress: Callable[[float, float], None] | None = None,
) -> Path:
    """Write an mp4 that plays a recorded walk in real time; return its path.

    Args:
        record: the walk.
        robot: the one that walked.
        path: of the film.
        progress: called for every picture with its time and the end (s), from the walk's start.

    Raises:
        InvalidInput: an argument that cannot be, or a record of another robot.
        RenderError: it cannot be rendered or encoded.
    """
    import imageio.v2 as imageio

    function_of(progress, "progress")
    require_pictures(record, robot)
    target = as_path(path)
    count = max(1, int((record.time[-1] - record.time[0]) * FPS))
    times = record.time[0] + np.arange(count) / FPS
    try:
        writer: Any = imageio.get_writer(
            target, format="FFMPEG", fps=FPS, codec="libx264", quality=8, macro_block_size=8
        )
        with writer:
            for number, frame in enumerate(frames(record, robot, times.tolist()), 1):
                writer.append_data(frame)
                if progress is not None:
                    progress(number / FPS, count / FPS)
    except (OSError, ValueError, ImportError) as error:
        raise RenderError(f"cannot write the video {target}: {error}") from error
    return target
