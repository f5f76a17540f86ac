"""The pages in a real Chromium: they load, move, obey, and are silent."""

from __future__ import annotations

import io
import threading
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import imageio.v3 as imageio
import numpy as np
import pytest
from chromium import CHROMIUM, DRIVER, NEEDED, asked_for, browser, complaints
from selenium.common.exceptions import TimeoutException

import preview_walk as pw
from preview_walk.robots.robot import Robot
from preview_walk.viewer.web.live import run_live
from preview_walk.viewer.web.server import page

pytestmark = [
    pytest.mark.skipif(not (CHROMIUM and DRIVER), reason=NEEDED),
    pytest.mark.xdist_group("chromium"),
]


@pytest.fixture(scope="module")
def light() -> Robot:
    """Return a robot of simple shapes, which software draws in a moment."""
    return pw.load_robot("humanoid-walker")


@pytest.fixture(scope="module")
def chromium(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Any]:
    with browser(tmp_path_factory.mktemp("profile")) as driver:
        yield driver


def wait_for(what: Callable[[], Any]) -> Any:
    """Return the first value that is true; software draws slowly, so there is a minute for it."""
    for _ in range(600):
        try:
            value = what()
        except TimeoutException:  # the driver waits for ten seconds, a busy machine needs more
            continue
        if value:
            return value
        time.sleep(0.1)
    raise AssertionError("it never came")


def drawn(server: Any) -> Any:
    """Return what the page draws, as small pixels that the page itself sends."""
    (visitor,) = server.get_clients().values()
    for _ in range(10):  # a busy machine may lose one
        try:
            return visitor.get_render(90, 120, timeout=20.0)[..., :3].astype(int)
        except TimeoutError:
            continue
    raise AssertionError("the page draws nothing")


def seen(driver: Any) -> Any:
    """Return the page as pixels."""
    pixels: Any = imageio.imread(io.BytesIO(driver.get_screenshot_as_png()))[..., :3]
    return pixels.astype(int)


def moved(before: Any, after: Any) -> bool:
    """Return whether more than a hundredth of a picture has changed."""
    return bool((np.abs(after - before).sum(axis=-1) > 60).mean() > 0.01)


def click(driver: Any, label: str) -> None:
    """Click on a button of the page, whatever note of the browser's lies over it."""
    path = f"//button[.//text()[normalize-space()='{label}']]"
    button = wait_for(lambda: driver.find_elements("xpath", path))[0]
    driver.execute_script("arguments[0].click()", button)


def type_into(driver: Any, label: str, text: str) -> None:
    """Type a number beside a slider, as a visitor does."""
    path = f"//label[normalize-space()='{label}']/following::input[@type='text'][1]"
    field = wait_for(lambda: driver.find_elements("xpath", path))[0]
    field.send_keys("\ue009a\ue000" + text + "\ue007")  # all of it is replaced


def test_a_live_walk_is_steered_pushed_paused_and_ended(chromium: Any, light: Robot) -> None:
    walk = pw.Walk.standing(light)
    with page() as server:
        server.scene.configure_default_lights(cast_shadow=False)  # software draws them for long
        loop = threading.Thread(target=run_live, args=(walk, server))
        loop.start()
        try:
            chromium.get(f"http://127.0.0.1:{server.get_port()}")
            wait_for(lambda: walk.time > 0.3)
            click(chromium, "Pause")  # what stands still is drawn sooner
            wait_for(lambda: np.ptp(drawn(server)) > 150)
            before = drawn(server)
            click(chromium, "Play")
            type_into(chromium, "forward [m/s]", "0.4")
            wait_for(lambda: walk.commanded == (0.4, 0.0, 0.0))
            wait_for(lambda: walk.plant.q[0] > 0.3)
            click(chromium, "Push")
            wait_for(lambda: walk.plant.pushes and walk.time > walk.plant.pushes[0].t + 0.25)
            click(chromium, "Pause")
            wait_for(lambda: chromium.find_elements("xpath", "//button[contains(., 'Play')]"))
            assert moved(before, drawn(server))
            paused = walk.time
            click(chromium, "One tick")
            wait_for(lambda: walk.time > paused)
            assert walk.time == pytest.approx(paused + 0.002)
            assert complaints(chromium) == []
            here = f"http://127.0.0.1:{server.get_port()}/"
            assert {address for address in asked_for(chromium) if address != here} == set()
            click(chromium, "End the walk")
        finally:
            walk.interrupt()
            loop.join(60)
            chromium.get("about:blank")
    record = walk.record()
    assert np.abs(record.push).max() == pytest.approx(75.0, abs=0.5)
    assert record.run.pushes[0]["duration"] == 0.2
    assert not record.run.fell


def test_the_exported_file_plays_without_server_and_network(
    chromium: Any, light: Robot, tmp_path: Path
) -> None:
    walk = pw.Walk.standing(light, ground=pw.stairs(0.1, 0.3, 2))
    walk.command(0.4, 0.0, 0.0)
    path = pw.export_html(walk.run(until=2.0).record(), tmp_path / "walk.html", light)
    complaints(chromium), asked_for(chromium)
    chromium.execute_cdp_cmd("Network.enable", {})
    chromium.execute_cdp_cmd(
        "Network.emulateNetworkConditions",
        {"offline": True, "latency": 0, "downloadThroughput": 0, "uploadThroughput": 0},
    )
    chromium.set_window_size(400, 300)
    chromium.get(path.as_uri())
    wait_for(lambda: np.ptp(seen(chromium)) > 150)
    first = wait_for(lambda: [seen(chromium)])[0]
    wait_for(lambda: moved(first, seen(chromium)))
    assert complaints(chromium) == []
    assert asked_for(chromium) == {path.as_uri()}
