"""How files that no robot has must be answered."""

from __future__ import annotations

import time
from pathlib import Path

import mujoco
import pytest

from preview_walk.errors import RobotError
from preview_walk.robots.inspection import inspect_robot
from preview_walk.robots.load import load_robot
from preview_walk.robots.robot import Robot

SOON = 10.0
"""Time (s) within which a file must be answered."""


def refused(path: Path) -> str:
    """Return the one sentence with which a file is refused, and how the inspection tells it."""
    start = time.monotonic()
    with pytest.raises(RobotError) as caught:
        load_robot(path)
    sentence = str(caught.value)
    assert time.monotonic() - start < SOON
    assert sentence
    assert "\n" not in sentence
    assert len(sentence) < 2000
    assert inspect_robot(path).problems == (sentence,)
    return sentence


def taken(model: Path | mujoco.MjSpec) -> Robot | None:
    """Return a robot, or None where one sentence refuses it."""
    report = inspect_robot(model)
    if report.robot is None:
        assert "\n" not in report.problems[0]
    return report.robot
