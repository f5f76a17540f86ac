"""Comparing the rows of two runs of a study."""

from __future__ import annotations

import pandas as pd

import preview_walk as pw

CIRCUMSTANCES = ["seconds", "started", "host", "versions"]


def same_rows(a: pw.Results, b: pw.Results) -> None:
    """Assert that two runs came to the same, bit for bit."""
    pd.testing.assert_frame_equal(
        a.table.drop(columns=CIRCUMSTANCES), b.table.drop(columns=CIRCUMSTANCES), check_exact=True
    )
