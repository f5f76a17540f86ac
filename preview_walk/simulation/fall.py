"""When a robot has fallen, and in words why."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from preview_walk.geometry.support import Sole
from preview_walk.terrain.ground import Ground
from preview_walk.tracking.dynamics import Dynamics
from preview_walk.types import FEET, Array, Foot

FALL_HEIGHT = 0.7
"""The robot has fallen when its CoM is below this share of its height above the soles."""

EDGE = 0.02
"""Ground that falls away from a sole's plane by more than this (m) has an edge there."""

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


def over_edges(soles: Mapping[Foot, Array], sole: Sole, ground: Ground) -> str:
    """Return which soles reach over an edge of the ground, to be added to a reason; "" for none.

    Args:
        soles: poses (4, 4) where they were put down, world, m.
        sole: half sizes, m.
        ground: what is under them.
    """
    over = []
    for foot in FEET:
        corners = sole.corners(soles[foot])
        gaps = corners[:, 2] - ground.height(corners[:, 0], corners[:, 1])
        if gaps.max() - gaps.min() > EDGE:
            over.append(foot)
    return f"; over an edge of the ground: {' and '.join(over)} sole" if over else ""
