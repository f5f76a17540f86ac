"""The rates of physics and control: how they go together, and how slow they may be."""

from __future__ import annotations

from preview_walk.arguments import SMALLEST, finite_number
from preview_walk.errors import InvalidInput
from preview_walk.tracking.gains import TrackingGains

MIN_PHYSICS_HZ = 100
"""MuJoCo's contacts give way with a time constant of 0.02 s; with less than two steps in it they
turn soft, and the robot sinks in."""


def steps_per_tick(physics_hz: float, control_hz: float) -> int:
    """Return the physics steps of one control tick.

    Args:
        physics_hz: steps of the physics per second.
        control_hz: ticks of the controller per second.

    Raises:
        InvalidInput: a rate is not positive, or physics does not make a whole number of steps in a
            tick.
    """
    physics_hz = finite_number(physics_hz, "physics_hz", "per second")
    control_hz = finite_number(control_hz, "control_hz", "per second")
    steps = round(physics_hz / control_hz) if min(physics_hz, control_hz) >= SMALLEST else 0
    if steps < 1 or abs(steps * control_hz / physics_hz - 1.0) > 1e-9:
        raise InvalidInput(
            "physics_hz must be a positive multiple of control_hz, "
            f"got {physics_hz:g} and {control_hz:g}.",
            "physics_hz",
        )
    return steps


def ticks_per_row(control_hz: float, record_hz: float | None) -> int:
    """Return of how many control ticks a record keeps one row.

    Args:
        control_hz: ticks of the controller per second.
        record_hz: rows per second; None: one at every tick.

    Raises:
        InvalidInput: the rate is not positive, or there is no whole number of ticks in a row.
    """
    if record_hz is None:
        return 1
    record_hz = finite_number(record_hz, "record_hz", "per second")
    ticks = round(control_hz / record_hz) if record_hz >= SMALLEST else 0
    if ticks < 1 or abs(ticks * record_hz / control_hz - 1.0) > 1e-9:
        raise InvalidInput(
            f"record_hz must be control_hz, {control_hz:g}, over a whole number, "
            f"got {record_hz:g}.",
            "record_hz",
        )
    return ticks


def require_rates(physics_hz: float, control_hz: float, gains: TrackingGains) -> None:
    """Do nothing if the robot can be balanced at these rates.

    A critically damped spring of frequency f (rad/s) whose force is held for a tick of T seconds is
    stable while f T < 1. Half of that is asked for.

    Args:
        physics_hz: steps of the physics per second.
        control_hz: ticks of the controller per second.
        gains: of the tracker.

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
