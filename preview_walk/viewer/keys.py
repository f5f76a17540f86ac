"""The keys that steer a walk in the live window."""

from __future__ import annotations

from preview_walk.footsteps.velocity import saturated
from preview_walk.simulation.commands import Command
from preview_walk.simulation.walk import Walk

UP, DOWN, LEFT, RIGHT, COMMA, PERIOD, ENTER = 265, 264, 263, 262, 44, 46, 257
"""Codes of keys, as GLFW has them."""

CHANGES: dict[int, Command] = {
    UP: (0.05, 0.0, 0.0),
    DOWN: (-0.05, 0.0, 0.0),
    LEFT: (0.0, 0.0, 0.1),
    RIGHT: (0.0, 0.0, -0.1),
    COMMA: (0.0, 0.02, 0.0),
    PERIOD: (0.0, -0.02, 0.0),
}
"""What a key adds to the velocity: forward and to the left (m/s), turning to the left (rad/s)."""


def steered(key: int, walk: Walk) -> Command | None:
    """Return the velocity (m/s, m/s, rad/s) that a key asks of a walk; None for another key.

    It is what the robot's legs can do, so that the next key counts from there.
    """
    if key == ENTER:
        return (0.0, 0.0, 0.0)
    change = CHANGES.get(key)
    if change is None:
        return None
    wanted = [now + more for now, more in zip(walk.commanded, change, strict=True)]
    vx, vy, wz = (float(value) for value in saturated(wanted, walk.limits))
    return vx, vy, wz
