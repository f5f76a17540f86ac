"""The random series of pushes."""

from __future__ import annotations

import re

import numpy as np
import pytest

from preview_walk.errors import InvalidInput
from preview_walk.simulation.pushes import random_pushes


def test_times_and_impulses_are_as_asked_and_directions_horizontal() -> None:
    pushes = random_pushes(3.0, 20.0, 0.2, 12.0, seed=1)
    assert [push.t for push in pushes] == [3.0, 6.0, 9.0]
    for push in pushes:
        assert push.duration == 0.2
        assert np.hypot(*push.force[:2]) * push.duration == pytest.approx(20.0)
        assert push.force[2] == 0.0


def test_the_seed_decides() -> None:
    assert random_pushes(1.0, 5.0, 0.2, 9.0, 7) == random_pushes(1.0, 5.0, 0.2, 9.0, 7)
    assert random_pushes(1.0, 5.0, 0.2, 9.0, 7) != random_pushes(1.0, 5.0, 0.2, 9.0, 8)


def test_directions_are_uniform() -> None:
    forces = np.array([push.force for push in random_pushes(1.0, 1.0, 1.0, 4001.0, 0)])
    angles = np.arctan2(forces[:, 1], forces[:, 0])
    counts, _ = np.histogram(angles, bins=8, range=(-np.pi, np.pi))
    assert counts.sum() == 4000
    assert abs(counts - 500).max() < 5 * np.sqrt(500)


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        ((0.0, 1.0, 0.2, 9.0), "every must be > 0 s, got 0.0."),
        ((1.0, np.inf, 0.2, 9.0), "impulse must be > 0 N·s, got inf."),
        ((1.0, 1.0, -0.2, 9.0), "duration must be > 0 s, got -0.2."),
        ((1.0, 1.0, 0.2, np.nan), "until must be finite (s), got nan."),
        ((0.1, 1.0, 0.2, 9.0), "every must be at least the duration of a push, 0.2 s, got 0.1 s."),
    ],
)
def test_what_cannot_be_is_refused(
    arguments: tuple[float, float, float, float], sentence: str
) -> None:
    with pytest.raises(InvalidInput, match=f"^{re.escape(sentence)}$"):
        random_pushes(*arguments, 0)
