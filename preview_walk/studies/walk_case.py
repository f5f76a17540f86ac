"""The function of a study that names none: one walk, by values that a text file can hold."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import lru_cache
from math import cos, radians, sin
from typing import Any

from preview_walk.reality.realism import read_realism
from preview_walk.record.record import Record
from preview_walk.robots.load import load_robot
from preview_walk.robots.robot import Robot
from preview_walk.simulation.pushes import Push
from preview_walk.simulation.walk import Walk
from preview_walk.terrain.reading import read_ground
from preview_walk.tracking.gains import TrackingGains

PUSH_TIME = 0.2
"""Seconds that a push lasts."""


@lru_cache(maxsize=16)
def loaded_robot(robot: str) -> Robot:
    """Return a robot, loaded once in each process."""
    return load_robot(robot)


def walk_case(
    robot: str,
    velocity: Sequence[float] = (0.3, 0.0, 0.0),
    duration: float = 8.0,
    *,
    impulse: float = 0.0,
    direction: float = 0.0,
    push_at: float = 3.0,
    push_body: str | None = None,
    ground: str | None = None,
    blind: bool = False,
    realism: str = "none",
    friction: float | None = None,
    gains: Mapping[str, float] | None = None,
    solver: str = "osqp",
    com_generator: str = "preview",
    seed: int = 0,
) -> Record:
    """Walk a robot by a velocity command, with a push or not; return the record.

    Args:
        robot: name in the catalogue, or a model's path.
        velocity: forward (m/s), to the left (m/s), turning rate (rad/s).
        duration: for how long, s; then the robot stops and stands.
        impulse: of a push of 0.2 s, N·s; 0: none.
        direction: of the push, degrees to the left from straight ahead of the first heading.
        push_at: when it begins, s.
        push_body: the body that is pushed; None: the base.
        ground: what is walked on, as `read_ground` reads it; None: level.
        blind: whether the robot takes it for level.
        realism: "none", "lab" or "field".
        friction: of the ground; None: 0.8.
        gains: of `TrackingGains`, by name, that are not the default's.
        solver: of the QP.
        com_generator: what leads the CoM.
        seed: of whatever is random.

    Raises:
        InvalidInput: a value that cannot be.
    """
    body = loaded_robot(robot)
    force, angle = impulse / PUSH_TIME, radians(direction % 360.0)
    along = (force * cos(angle), force * sin(angle), 0.0)
    settings: dict[str, Any] = {
        "pushes": [Push(push_at, PUSH_TIME, along, push_body)] if impulse else [],
        "ground": None if ground is None else read_ground(ground),
        "blind": blind,
        "realism": read_realism(realism),
        "friction": friction,
        "gains": None if gains is None else TrackingGains(**gains),
        "solver": solver,
        "com_generator": com_generator,
        "seed": seed,
    }
    walk = Walk.standing(body, **settings)
    walk.schedule([((velocity[0], velocity[1], velocity[2]), duration)])
    walk.run()
    return walk.record()
