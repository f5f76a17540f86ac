"""When a robot has fallen, and in words why."""

from __future__ import annotations

import numpy as np

from preview_walk.tracking.dynamics import Dynamics
from preview_walk.types import FEET

FALL_HEIGHT = 0.7
"""The robot has fallen when its CoM is below this share of its height above the soles."""

FALL_TILT = 0.9
"""The robot has fallen when its torso leans further than this (rad)."""


def fall_reason(dynamics: Dynamics, com_height: float) -> str | None:
    """Return why a robot counts as fallen, or None while it stands.

    Args:
        dynamics: at the measured state.
        com_height: of the CoM above the soles in the walking posture, m.
    """
    # The lower foot is on the ground; the other one may be flung up by a recovery step.
    ground = min(dynamics.soles[foot].position[2] for foot in FEET)
    height = float(dynamics.com[2] - ground)
    if height < FALL_HEIGHT * com_height:
        return f"the CoM sank to {height:.2f} m of {com_height:.2f} m above the feet"
    tilt = float(np.arccos(np.clip(dynamics.torso.rotation[2, 2], -1.0, 1.0)))
    if tilt > FALL_TILT:
        return f"the torso leaned {np.degrees(tilt):.0f} degrees"
    return None
