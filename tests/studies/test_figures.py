"""What functions return becomes plain figures by name."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pytest
from synthetic_walk import walk_record

from preview_walk.errors import InvalidInput
from preview_walk.studies.figures import figures_of, succeeded


def test_a_record_gives_the_figures_of_its_summary_by_axis() -> None:
    record = walk_record()
    figures = figures_of(record, {"ticks": len})
    summary = record.summary()
    assert figures["com_error_rms_y"] == summary.com_error_rms[1]
    assert figures["ticks"] == len(record)
    assert figures["success"] is True
    assert not succeeded(figures_of(record.with_run(fell=True, fall_time=1.0), {}))


def test_mappings_numbers_and_dataclasses_are_taken() -> None:
    @dataclass
    class Found:
        a: float
        b: str

    assert figures_of({"a": np.float64(1.5), "b": np.arange(2)}, {}) == {"a": 1.5, "b": "[0, 1]"}
    assert figures_of(np.float32(0.5), {}) == {"value": 0.5}
    assert figures_of(True, {}) == {"value": True}
    assert figures_of(Found(1.0, "x"), {}) == {"a": 1.0, "b": "x"}
    assert figures_of(None, {"one": lambda _: 1}) == {"one": 1}
    for bad in ("text", None, [1, 2]):
        with pytest.raises(InvalidInput, match="must return figures by name"):
            figures_of(bad, {})
