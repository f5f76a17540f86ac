"""The torso: upright, and turning as the feet do."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from preview_walk.controller.feet import FootTarget
from preview_walk.geometry.planar import wrap
from preview_walk.geometry.poses import pose_at, yaw_of
from preview_walk.types import Array, Foot


def torso_motion(targets: Mapping[Foot, FootTarget]) -> tuple[Array, Array]:
    """Return the torso's rotation (3, 3), midway between the feet, and its velocity (3,), rad/s.

    Args:
        targets: what each foot should do.
    """
    turning = 0.0
    for target in targets.values():
        if not target.contact:
            turning += 0.5 * float(target.velocity[5])
    a, b = yaw_of(targets["left"].pose), yaw_of(targets["right"].pose)
    rotation = pose_at(0.0, 0.0, a + 0.5 * wrap(b - a))[:3, :3]
    return rotation, np.array((0.0, 0.0, turning))
