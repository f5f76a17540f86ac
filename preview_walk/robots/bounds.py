"""What a walking robot can measure: a number beyond these bounds is a slip in its file."""

from __future__ import annotations

SMALLEST_SOLE = 0.01
"""Smallest length and width (m) that a sole may have."""

LARGEST = 1e3
"""Largest position, size (m) or angle (rad) that a file or a description may hold."""
