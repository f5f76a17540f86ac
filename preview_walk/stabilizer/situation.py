"""What recovery judges by: the state and the plan of one instant."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from preview_walk.footsteps.plan import FootstepPlan
from preview_walk.types import Array


@dataclass(frozen=True, eq=False)
class Situation:
    """A walker at one instant.

    Attributes:
        t: now, s.
        plan: the walk.
        dcm: (2,) measured DCM, world, m.
        disturbance: (2,) rate at which a push drives the DCM, world, m/s.
        planned_dcm: returns the DCM (2,) that the plan has at a time (s), now or later.
        swing: position (3,), m, and velocity (3,), m/s, in the world of the sole that swings
            freely; None where none does.
    """

    t: float
    plan: FootstepPlan
    dcm: Array
    disturbance: Array
    planned_dcm: Callable[[float], Array]
    swing: tuple[Array, Array] | None
