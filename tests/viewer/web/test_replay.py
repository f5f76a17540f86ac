"""A record's page: it goes on in real time, and to any moment."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from page_handles import click, handle

from preview_walk.record.record import Record
from preview_walk.robots.robot import Robot
from preview_walk.viewer.web.picture import PICTURES
from preview_walk.viewer.web.replay import Replay, run_replay


@pytest.fixture
def replay(server: Any, short_walk: Record, talos: Robot) -> Replay:
    return Replay(short_walk, talos, server)


def shown(replay: Replay) -> Any:
    """Return where the base is drawn."""
    return replay._picture._nodes.frames[replay._picture._stage.base].position


def test_it_goes_on_in_real_time_or_faster(server: Any, replay: Replay, short_walk: Record) -> None:
    for count, speed in ((PICTURES, "1"), (PICTURES, "2")):
        handle(server, "speed").value = speed
        for _ in range(count):
            replay.picture()
    replay.picture()
    tick = int(np.searchsorted(short_walk.time, 3.0 - 1e-6))
    np.testing.assert_allclose(shown(replay), short_walk.qpos[tick, :3], atol=1e-3)
    assert handle(server, "time [s]").value == pytest.approx(3.0, abs=0.1)


def test_it_goes_to_any_moment_and_stays_there_paused(
    server: Any, replay: Replay, short_walk: Record
) -> None:
    click(server, "Pause")
    handle(server, "time [s]").value = 2.5
    for _ in range(3):
        replay.picture()
    tick = int(np.searchsorted(short_walk.time, 2.5 - 1e-9))
    np.testing.assert_allclose(shown(replay), short_walk.qpos[tick, :3], atol=1e-12)
    click(server, "Play")
    replay.picture()
    assert replay._at > 2.5


def test_it_stops_at_the_end_and_begins_again(
    server: Any, replay: Replay, short_walk: Record
) -> None:
    handle(server, "time [s]").value = round(float(short_walk.time[-1]), 2)
    replay.picture()
    replay.picture()
    assert replay._at == short_walk.time[-1]
    click(server, "Play")
    assert replay._at == short_walk.time[0]


def test_it_is_closed_on_its_page(server: Any, short_walk: Record, talos: Robot) -> None:
    server.get_clients = lambda: click(server, "Close") or {}
    run_replay(short_walk, talos, server)
