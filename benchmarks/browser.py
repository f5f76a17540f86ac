"""What a page costs a walk, and what a walk weighs as one HTML file.

    python benchmarks/browser.py
    python benchmarks/browser.py --chromium    # and how often a real browser draws here

With Debian's chromium and chromium-driver the last counts the browser's own frames; without a
graphics card it draws by software, on the same cores as the walk.
"""

from __future__ import annotations

import argparse
import shutil
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path
from threading import Thread
from time import perf_counter, process_time
from typing import Any

import preview_walk as pw
from preview_walk.viewer.web.live import LiveWalk
from preview_walk.viewer.web.server import page

SPAN = 10.0
"""Seconds of every walk."""

COUNT = """
const done = arguments[0], start = performance.now();
let frames = 0;
function frame() {
    frames += 1;
    if (performance.now() - start < 4000) requestAnimationFrame(frame); else done(frames / 4);
}
requestAnimationFrame(frame);
"""


def walk_of(robot: pw.Robot) -> pw.Walk:
    """Return a walk at 0.4 m/s that turns."""
    walk = pw.Walk.standing(robot)
    walk.command(0.4, 0.0, 0.1)
    return walk


def cost(what: Callable[[], object]) -> tuple[float, float]:
    """Return the time on the CPU and on the clock (s) per second of a walk of `SPAN`."""
    cpu, clock = process_time(), perf_counter()
    what()
    return (process_time() - cpu) / SPAN, (perf_counter() - clock) / SPAN


def paged(robot: pw.Robot, visit: Callable[[str], object] | None) -> None:
    """Print what a walk with a page costs, with a visitor or with the server alone."""
    with page() as server:
        live = LiveWalk(walk := walk_of(robot), server, None)
        address = f"http://127.0.0.1:{server.get_port()}"
        if visit is None:
            server.get_clients = lambda: {0: None}  # somebody looks
            name = "page, nobody draws it"
        else:
            visit(address)
            name = "page, drawn by Chromium"
        while walk.time < 1.0:
            live.picture()
        pictures = 0

        def on() -> None:
            nonlocal pictures
            while walk.time < 1.0 + SPAN:
                live.picture()
                pictures += 1

        cpu, clock = cost(on)
        print(f"{name:28}{cpu:8.2f}{clock:8.2f}{pictures / (clock * SPAN):12.1f}")


def drawn(robot: pw.Robot) -> None:
    """Print the cost of a page in Chromium, and how often that draws it."""
    from selenium import webdriver

    options = webdriver.ChromeOptions()
    options.binary_location = shutil.which("chromium")
    flags = "--headless=new --no-sandbox --use-gl=angle --use-angle=swiftshader"
    profile = tempfile.mkdtemp()
    flags += " --enable-unsafe-swiftshader"
    for flag in (*flags.split(), "--window-size=900,560", f"--user-data-dir={profile}"):
        options.add_argument(flag)
    service = webdriver.ChromeService(shutil.which("chromedriver"))
    driver: Any = webdriver.Chrome(options=options, service=service)
    counted: list[float] = []
    try:
        paged(robot, driver.get)
        with page() as server:
            live = LiveWalk(walk_of(robot), server, None)
            driver.get(f"http://127.0.0.1:{server.get_port()}")
            for _ in range(300):
                live.picture()
            count = Thread(target=lambda: counted.append(driver.execute_async_script(COUNT)))
            count.start()
            while count.is_alive():
                live.picture()
        print(f"Chromium draws {counted[0]:.2f} frames per second")
    finally:
        driver.quit()


def main() -> None:
    """Print the tables."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--robot", default="talos", help="name or path (default talos)")
    parser.add_argument("--chromium", action="store_true", help="draw the page in Chromium too")
    given = parser.parse_args()
    robot = pw.load_robot(given.robot)
    print(f"{robot.name}: per second of walk   CPU s  clock s  pictures/s")
    cpu, clock = cost(lambda: walk_of(robot).run(until=SPAN))
    print(f"{'no page':28}{cpu:8.2f}{clock:8.2f}{'-':>12}")
    paged(robot, None)
    if given.chromium:
        drawn(robot)
    record = walk_of(robot).run(until=SPAN).record()
    with tempfile.TemporaryDirectory() as folder:
        start = perf_counter()
        path = pw.export_html(record, Path(folder) / "walk.html", robot)
        size = path.stat().st_size / 1e6
        print(f"one HTML file of {SPAN:g} s: {size:.1f} MB in {perf_counter() - start:.1f} s")


if __name__ == "__main__":
    sys.exit(main())
