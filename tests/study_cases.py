"""Functions of studies that tests run in workers, which import them by name."""

from __future__ import annotations

import os
import signal
import time
from pathlib import Path
from typing import Any

import numpy as np


def drawn(x: float, seed: int) -> dict[str, Any]:
    """Return figures that follow from the factors and the seed alone."""
    value = float(np.random.default_rng(seed).normal(x))
    return {"value": value, "success": value > 0.0}


def slow(x: float, seed: int, folder: str) -> dict[str, Any]:
    """Return the same; leave a line in a file for each time it was called.

    After ten of them it waits for the file `go`, so that a study is stopped in its midst however
    busy the machine is.
    """
    calls = Path(folder) / "calls"
    with calls.open("a") as file:
        file.write(f"{x} {seed}\n")
    while calls.read_text().count("\n") > 10 and not (Path(folder) / "go").exists():
        time.sleep(0.02)
    time.sleep(0.02)
    return drawn(x, seed)


def trouble(kind: str, seed: int) -> dict[str, Any]:
    """Come to the end that a kind names."""
    if kind == "raise":
        raise ValueError("no such luck")
    if kind == "exit":
        raise SystemExit(3)
    if kind == "loop":
        while True:
            pass
    if kind == "kill":
        os.kill(os.getpid(), signal.SIGKILL)
    if kind == "text":
        return "not figures"  # type: ignore[return-value]
    return {"seed_found": seed}


def killed_once(x: int, folder: str) -> dict[str, Any]:
    """Kill the worker at the first call for x = 3, as somebody's `kill -9` would."""
    mark = Path(folder) / "killed"
    if x == 3 and not mark.exists():
        mark.touch()
        os.kill(os.getpid(), signal.SIGKILL)
    time.sleep(0.02)
    return {"square": x * x}


def stands(gain: float, push: float) -> bool:
    """Return whether a push is survived: up to ten times the gain, and in an island above."""
    return push < 10.0 * gain or 90.0 < push < 95.0


def pushed(gain: float, push: float) -> dict[str, Any]:
    """Return whether a push is survived as the figure that tells."""
    return {"success": stands(gain, push)}
