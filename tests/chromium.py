"""A real browser without a screen, where the system has one: Debian's chromium and its driver."""

from __future__ import annotations

import json
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

CHROMIUM, DRIVER = shutil.which("chromium"), shutil.which("chromedriver")

NEEDED = "needs Chromium and its driver: sudo apt install chromium chromium-driver"

_FLAGS = (
    *("--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--window-size=1000,600"),
    *("--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"),
    *("--disable-quic", "--no-first-run", "--disable-background-networking"),
    *("--disable-component-update", "--disable-sync", "--disable-extensions"),
)

NOT_OURS = ("THREE.Clock: This module has been deprecated",)
"""What viser's own page writes on the console."""


@contextmanager
def browser(profile: Path) -> Iterator[Any]:
    """Give a browser with an empty profile in the folder `profile`."""
    from selenium import webdriver

    options = webdriver.ChromeOptions()
    options.binary_location = CHROMIUM
    for flag in (*_FLAGS, f"--user-data-dir={profile}"):
        options.add_argument(flag)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    driver = webdriver.Chrome(options=options, service=webdriver.ChromeService(DRIVER))
    try:
        yield driver
    finally:
        driver.quit()


def complaints(driver: Any) -> list[str]:
    """Return the warnings and errors on the console since the last time, but for `NOT_OURS`."""
    lines = [line for line in driver.get_log("browser") if line["level"] in ("WARNING", "SEVERE")]
    texts = [line["message"] for line in lines]
    return [text for text in texts if not any(known in text for known in NOT_OURS)]


def asked_for(driver: Any) -> set[str]:
    """Return the addresses that the page has asked for, but for those of the browser itself."""
    addresses = set()
    for line in driver.get_log("performance"):
        message = json.loads(line["message"])["message"]
        if message["method"] in ("Network.requestWillBeSent", "Network.webSocketCreated"):
            parts = message["params"]
            addresses.add(str(parts.get("url") or parts["request"]["url"]))
    return {a for a in addresses if not a.startswith(("chrome", "data:", "blob:", "about:"))}
