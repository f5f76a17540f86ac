"""Pictures of a recorded walk: the robot in the middle, moved on later, and a film of it."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import imageio.v2 as imageio
import numpy as np
import pytest

from preview_walk.offscreen import RenderError
from preview_walk.record.record import Record
from preview_walk.robots.robot import Robot
from preview_walk.viewer import video
from preview_walk.viewer.video import Frame, frames, render_video

SIZE = (96, 128)
CENTRE = (slice(30, 70), slice(44, 84))


@pytest.fixture(scope="module")
def pictures(talos: Robot, short_walk: Record) -> list[Frame]:
    """Return three pictures, the last two of one time; none where there is no OpenGL."""
    try:
        return list(frames(short_walk, talos, (0.0, 4.0, 4.0), SIZE))
    except RenderError as error:
        # A machine without EGL: the one sentence must say what to do.
        words = str(error)
    assert re.search(r"sudo apt install libegl1|MUJOCO_GL", words)
    return []


def test_the_robot_is_in_the_picture(pictures: list[Frame]) -> None:
    """It is grey and black before a blue sky: the middle differs from the corner."""
    for picture in pictures:
        assert picture.shape == (*SIZE, 3)
        assert picture.dtype == np.uint8
        sky = picture[:6, :6].reshape(-1, 3).mean(axis=0)
        away = np.abs(picture[CENTRE].astype(float) - sky).sum(axis=-1)
        assert (away > 60.0).mean() > 0.3


def test_the_same_time_is_the_same_picture_and_another_is_not(pictures: list[Frame]) -> None:
    if pictures:
        first, later, again = (picture.astype(int) for picture in pictures)
        assert (later == again).all()
        assert np.abs(first - later)[CENTRE].mean() > 2.0


def test_the_film_lasts_as_long_as_the_walk(
    talos: Robot, short_walk: Record, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Encoded and read back; the pictures are stand-ins, one grey level per time."""
    asked: list[float] = []

    def grey(record: Record, robot: Robot, times: list[float]) -> Iterator[Frame]:
        for time in times:
            asked.append(time)
            yield np.full((*SIZE, 3), int(30 * time), dtype=np.uint8)

    monkeypatch.setattr(video, "frames", grey)
    told: list[tuple[float, float]] = []
    path = render_video(
        short_walk, talos, tmp_path / "walk.mp4", progress=lambda *t: told.append(t)
    )
    assert len(told) == len(asked)
    assert told[-1][0] == told[-1][1] == pytest.approx(len(asked) / video.FPS)
    assert asked[0] == short_walk.time[0]
    assert np.diff(asked) == pytest.approx(1.0 / video.FPS)
    assert asked[-1] == pytest.approx(short_walk.time[-1], abs=2.0 / video.FPS)
    film: Any
    with imageio.get_reader(path) as film:
        assert film.get_meta_data()["fps"] == video.FPS
        levels = [float(picture.mean()) for picture in film]
    assert len(levels) == len(asked)
    assert levels == pytest.approx([30 * t for t in asked], abs=6.0)


def test_a_film_that_cannot_be_written_says_why(
    talos: Robot, short_walk: Record, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def blank(record: Record, robot: Robot, times: list[float]) -> Iterator[Frame]:
        yield np.zeros((*SIZE, 3), dtype=np.uint8)

    monkeypatch.setattr(video, "frames", blank)
    path = tmp_path / "no such folder" / "walk.mp4"
    with pytest.raises(RenderError, match=f"^cannot write the video {re.escape(str(path))}: "):
        render_video(short_walk, talos, path)
