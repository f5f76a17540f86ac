"""How slowly the controller may tick and the physics may step."""

from __future__ import annotations

from preview_walk.errors import InvalidInput
from preview_walk.tracking.gains import TrackingGains

MIN_PHYSICS_HZ = 100
"""MuJoCo's contacts give way with a time constant of 0.02 s; with less than two steps in it they
turn soft, and the robot sinks in."""


def require_rates(physics_hz: float, control_hz: float, gains: TrackingGains) -> None:
    """Do nothing if the robot can be balanced at these rates (1/s).

    A critically damped spring of frequency f (rad/s) whose force is held for a tick of T seconds is
    stable while f T < 1. Half of that is asked for.

    Raises:
        InvalidInput: a rate is lower; says the bound.
    """
    fastest = max(gains.dcm, gains.height, gains.foot, gains.torso, gains.posture, gains.momentum)
    if not control_hz >= 2.0 * fastest:
        raise InvalidInput(
            f"control_hz must be at least {2.0 * fastest:g}, twice the fastest feedback "
            f"({fastest:g} rad/s), to balance the robot, got {control_hz}.",
            argument="control_hz",
        )
    if not physics_hz >= MIN_PHYSICS_HZ:
        raise InvalidInput(
            f"physics_hz must be at least {MIN_PHYSICS_HZ} for the feet to stand firm, "
            f"got {physics_hz}.",
            argument="physics_hz",
        )
