"""The walking lab's swing, as it is typed there."""

import inspect

import numpy as np
import pytest

from preview_walk.lab.swing import SwingLegTrajectory
from preview_walk.lab.zmp import ZMPTrajectoryGenerator


def test_the_labs_defaults():
    call = inspect.signature(SwingLegTrajectory.generate_trajectory)
    defaults = {name: p.default for name, p in call.parameters.items()}
    assert (defaults["duration"], defaults["dt"]) == (0.3, 0.01)
    zmp = inspect.signature(ZMPTrajectoryGenerator.generate_zmp_trajectory)
    assert zmp.parameters["dt"].default == 0.01


def test_a_swing_without_times_is_the_labs():
    swing = SwingLegTrajectory(0.05, 0.02)
    t, position, velocity = swing.generate_trajectory((0.0, 0.1, 0.0), (0.3, 0.1, 0.0))
    assert t == pytest.approx(0.01 * np.arange(31))
    assert position[[0, -1]] == pytest.approx(np.array([[0.0, 0.1, 0.0], [0.3, 0.1, 0.0]]))
    assert position[:, 2].max() == pytest.approx(0.05, abs=1e-3)
    assert velocity[[0, -1]] == pytest.approx(np.zeros((2, 3)))
    # Central differences of a quintic over 0.3 m in 0.3 s, sampled every 10 ms.
    assert np.gradient(position, t, axis=0)[2:-2] == pytest.approx(velocity[2:-2], abs=0.02)
