"""Readings that cannot be are replaced, counted, and after a while end the walk."""

from __future__ import annotations

import numpy as np
import pytest

from preview_walk.estimation.signals import LONGEST, Channel, SensorError

EXPECTED = np.array((1.0, 2.0))


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf, 1e6, 40.0])
def test_what_cannot_be_is_replaced_and_counted(bad: float) -> None:
    channel = Channel("axis of the gyro", "rad/s", 50.0, 30.0)
    taken = channel.take(np.array((bad, 2.5)), EXPECTED, 0.002)
    np.testing.assert_array_equal(taken, (1.0, 2.5))
    assert channel.refused == 1
    reading = np.array((1.5, 2.5))
    assert channel.take(reading, EXPECTED, 0.002) is reading
    assert channel.refused == 1


def test_for_longer_it_is_an_end() -> None:
    channel = Channel("axis of the gyro", "rad/s", 50.0)
    ticks = round(LONGEST / 0.002)
    for _ in range(ticks):
        channel.take(np.full(2, np.nan), EXPECTED, 0.002)
    with pytest.raises(SensorError, match=r"axis of the gyro 0 has given nothing that can be"):
        channel.take(np.full(2, np.nan), EXPECTED, 0.002)
