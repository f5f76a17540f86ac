"""The walking lab's walk in its own model, and in models that are made otherwise."""

from __future__ import annotations

import mujoco
import numpy as np
import pytest

from preview_walk.lab.walking_controller import WalkingController
from preview_walk.robots.reading.description import models_folder
from preview_walk.types import Array

XML = models_folder() / "humanoid-walker.xml"
History = dict[str, Array]


def assert_followed(history: History, height: float = 0.0) -> None:
    """Hold a walk to its plan."""
    assert np.sqrt(np.mean((history["com"] - history["com_ref"]) ** 2, axis=0)).max() < 2e-3
    assert np.sqrt(np.nanmean((history["zmp"] - history["zmp_ref"]) ** 2, axis=0)).max() < 0.02
    for foot in ("left_foot", "right_foot"):
        sole, planned = history[foot][:, :3, 3], history[f"{foot}_ref"][:, :3, 3]
        assert np.abs(sole - planned).max() < 8e-3
        assert sole[-1, 2] == pytest.approx(height, abs=5e-3)


def walk(spec: mujoco.MjSpec, n_steps: int = 2) -> History:
    model = spec.compile()
    controller = WalkingController(model, mujoco.MjData(model))
    history = controller.run_walking(n_steps)
    assert controller.fall is None
    return history
