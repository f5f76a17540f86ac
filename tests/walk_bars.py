"""The figures that an undisturbed walk must reach."""

from __future__ import annotations

import numpy as np

from preview_walk.record.record import Record


def assert_within_the_bars(record: Record) -> None:
    """Hold a walk to the figures that the default walk must reach."""
    summary = record.summary()
    assert not summary.fell, summary.fall_reason
    assert summary.final_position_error is not None
    assert summary.final_yaw_error is not None
    assert summary.final_position_error <= 0.03
    assert summary.final_yaw_error <= 0.03
    assert max(x or np.inf for x in summary.com_error_rms[:2]) <= 0.005
    assert max(x or np.inf for x in summary.zmp_error_rms) <= 0.015
    assert summary.qp_failures == 0
