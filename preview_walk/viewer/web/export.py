"""A record as one HTML file that needs no server and no network."""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np

from preview_walk.files import whole_file
from preview_walk.record.record import Record
from preview_walk.robots.robot import Robot
from preview_walk.viewer.video import require_pictures
from preview_walk.viewer.web.picture import PICTURES, Picture
from preview_walk.viewer.web.server import page
from preview_walk.viewer.web.stage import robot_of, stage_on
from preview_walk.viewer.web.traces import recorded


def export_html(record: Record, path: str | os.PathLike[str], robot: Robot | None = None) -> Path:
    """Write a walk as one HTML file to be played in any browser; return its path.

    The robot walks in its own meshes on its ground, in real time, with its CoM, ZMP and DCM; the
    page plays, pauses, and goes to any moment. It loads nothing else.

    Args:
        record: the walk.
        path: the .html file to write.
        robot: the one that walked; None is the one of that name in the catalogue.

    Raises:
        InvalidInput: a record that cannot be shown, no robot, or viser is not installed.
        OutputError: the file cannot be written.
    """
    robot = robot_of(record, robot)
    require_pictures(record, robot)
    rows, qpos = recorded(record), record.qpos
    times = np.arange(record.time[0], record.time[-1], 1.0 / PICTURES)
    with whole_file(path) as part, page() as server:
        picture = Picture(server, stage_on(robot, record.ground), robot.com_height)
        picture.show(qpos[0], rows[0])
        film = server.get_scene_serializer()
        for tick in np.searchsorted(record.time, times - 1e-9):
            picture.show(qpos[tick], rows[tick])
            film.insert_sleep(1.0 / PICTURES)
        part.write_text(film.as_html(), encoding="utf-8")
    return Path(path)
