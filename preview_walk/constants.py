"""Physical constants shared by every room."""

from __future__ import annotations

GRAVITY = 9.81
"""Acceleration of gravity (m/s^2) of the planner, the models and the simulation alike."""
