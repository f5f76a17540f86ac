"""The plots by name, without matplotlib, which takes long to import."""

from __future__ import annotations

OVERVIEW = "overview"
"""Name of all of them on one page."""

SINGLE = ("top_view", "com_dcm_zmp", "feet", "forces", "torques", "phases")
"""Names of the single plots."""
