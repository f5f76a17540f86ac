"""Whole walks in one call, along a plan or by velocity commands, watched or not."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Protocol, TypedDict

from preview_walk.arguments import function_of
from preview_walk.controller.robot_limits import gait_limits
from preview_walk.footsteps.reading import PlanLike, as_plan
from preview_walk.pattern.check import require_walkable
from preview_walk.reality.realism import Realism
from preview_walk.record.record import Record
from preview_walk.robots.robot import Robot
from preview_walk.simulation.commands import Command
from preview_walk.simulation.pushes import Push
from preview_walk.simulation.walk import Progress, Walk
from preview_walk.terrain.ground import Ground
from preview_walk.tracking.gains import TrackingGains

if TYPE_CHECKING:
    from typing_extensions import Unpack


class Settings(TypedDict, total=False):
    """The settings of a run, all optional; what they mean stands at `Walk`."""

    physics_hz: int | None
    control_hz: float
    friction: float | None
    pushes: Sequence[Push] | None
    seed: int
    gains: TrackingGains | None
    solver: str
    swing_height: float | None
    com_height: float | None
    com_generator: str
    ground: Ground | None
    blind: bool
    realism: Realism | None
    record_hz: float | None
    blocks: str | os.PathLike[str] | None
    on_tick: Callable[[Walk], None] | None


class Viewer(Protocol):
    """Runs a walk where somebody watches it, as `show` does."""

    def __call__(self, walk: Walk, /, *, progress: Progress | None) -> object:
        """Run the walk; `progress`: as of `simulate`."""


def simulate(
    robot: Robot,
    plan: PlanLike,
    *,
    progress: Progress | None = None,
    viewer: bool | Viewer = False,
    **settings: Unpack[Settings],
) -> Record:
    """Walk a robot along a plan in MuJoCo and return the record.

    The robot starts standing on the plan's stance soles and stands for a second after its end. A
    fall or Ctrl-C ends the run early; the record says so.

    Args:
        robot: from `load_robot`.
        plan: the footsteps, in any form that `as_plan` reads.
        progress: called now and then with the simulated time and its end (s).
        viewer: True opens MuJoCo's live viewer and runs in real time; a function, as `show`, runs
            the walk in its place.
        settings: the keyword arguments of `Walk`.

    Raises:
        InvalidInput: the plan has a step that the robot cannot make; and as `Walk` does.
    """
    function_of(progress, "progress")
    plan = as_plan(plan)
    seen = settings.get("ground") is not None and not settings.get("blind")
    if not seen:
        require_walkable(plan, gait_limits(robot))
    walk = Walk(robot, plan, visuals=viewer is True, **settings)
    if seen:  # only now are the soles where the ground has them
        require_walkable(walk.plan, gait_limits(robot))
    return _recorded(walk, progress, viewer)


def simulate_commands(
    robot: Robot,
    commands: Sequence[tuple[Command, float]],
    *,
    start: Sequence[float] = (0.0, 0.0),
    progress: Progress | None = None,
    viewer: bool | Viewer = False,
    **settings: Unpack[Settings],
) -> Record:
    """Walk a robot by velocity commands, each for its duration, then to a stop; return the record.

    Args:
        robot: from `load_robot`.
        commands: pairs ((vx, vy, wz), duration) in m/s, m/s, rad/s and s.
        start: (x, y) or (x, y, yaw) midway between the feet at first (m, rad).
        progress: called now and then with the simulated time and its end (s).
        viewer: True opens MuJoCo's live viewer and runs in real time; a function, as `show`, runs
            the walk in its place.
        settings: the keyword arguments of `Walk`.

    Raises:
        InvalidInput: a command or duration that cannot be; and as `Walk` does.
    """
    function_of(progress, "progress")
    walk = Walk.standing(robot, start, visuals=viewer is True, **settings)
    walk.schedule(commands)
    return _recorded(walk, progress, viewer)


def _recorded(walk: Walk, progress: Progress | None, viewer: bool | Viewer) -> Record:
    """Run a walk to its end and return its record."""
    if callable(viewer):
        viewer(walk, progress=progress)
    elif viewer:
        from preview_walk.viewer.window import run_in_viewer

        run_in_viewer(walk, progress)
    else:
        walk.run(progress=progress)
    return walk.record()
