"""The options of `preview-walk` as one value in SI units."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from math import radians
from pathlib import Path
from typing import Any

from preview_walk.cli.config import config_text, with_config
from preview_walk.cli.option_table import (
    DEFAULT_DOUBLE_SUPPORT_RATIO,
    DEFAULT_PORT,
    DEFAULT_STEPS,
    STEPPING,
)
from preview_walk.cli.parser import make_parser


@dataclass(frozen=True)
class Options:
    """What the command was asked for, SI units; None is the simulation's default.

    Attributes:
        robot: name or path.
        steps, step_length, step_time, double_support_ratio, turn: of a walk by footsteps; turn in
            rad per step; length and time None: what suits the robot.
        commands: pairs of a velocity (m/s, m/s, rad/s) and its duration (s); none: walk by
            footsteps.
        start: x, y (m), yaw (rad).
        friction: of the ground.
        ground: what is walked on, in words.
        blind: whether the robot knows nothing of it.
        realism: how good the robot is, in words; None: perfect.
        pushes: (begin, duration, force) in s, s and N.
        random_pushes: (every, impulse) in s and N·s.
        seed: of whatever is random.
        physics_hz, control_hz: rates.
        solver: of the QP.
        com_generator: what leads the CoM along the plan.
        out: the folder of results.
        video, view, web, no_plots: what to make of the walk.
        port: of the page that `web` asks for.
        footsteps: file of footsteps to walk along; None: those of the options.
        swing_height, com_height: m; None: the robot's own.
        record_hz: rows of the record per second; None: one a tick.
        json, quiet: what is printed.
        config: the options given, as the text of a TOML file that gives them again.
        list_robots: print the catalogue, do not walk.
        inspect: the model to report on, not to walk.
    """

    robot: str
    steps: int
    step_length: float | None
    step_time: float | None
    double_support_ratio: float
    turn: float
    commands: tuple[tuple[tuple[float, float, float], float], ...]
    start: tuple[float, float, float]
    friction: float | None
    ground: str | None
    pushes: tuple[tuple[float, float, tuple[float, float, float]], ...]
    random_pushes: tuple[float, float] | None
    seed: int
    physics_hz: int | None
    control_hz: int | None
    solver: str | None
    com_generator: str | None
    out: Path
    video: bool
    view: bool
    list_robots: bool
    inspect: str | None
    no_plots: bool = False
    blind: bool = False
    realism: str | None = None
    web: bool = False
    port: int = DEFAULT_PORT
    footsteps: str | None = None
    swing_height: float | None = None
    com_height: float | None = None
    record_hz: float | None = None
    json: bool = False
    quiet: bool = False
    config: str = ""


def parse(argv: Sequence[str] | None = None) -> Options:
    """Read the command line; exit with code 2 and one sentence on stderr when it can't be.

    `argv` is without the program's name; None takes the process's own.
    """
    arguments = list(sys.argv[1:] if argv is None else argv)
    parser = make_parser()
    found = parser.read(with_config(arguments, parser))
    _check_together(found, parser)
    x, y, yaw = found.start
    return Options(
        robot=found.robot,
        steps=_or(found.steps, DEFAULT_STEPS),
        step_length=found.step_length,
        step_time=found.step_time,
        double_support_ratio=_or(found.double_support_ratio, DEFAULT_DOUBLE_SUPPORT_RATIO),
        turn=radians(_or(found.turn, 0.0)),
        commands=tuple(
            ((v[0], v[1], radians(v[2])), duration)
            for v, duration in zip(found.velocity, found.duration, strict=True)
        ),
        start=(x, y, radians(yaw)),
        friction=found.friction,
        ground=found.ground,
        pushes=tuple((p[0], p[1], (p[2], p[3], p[4])) for p in found.push),
        random_pushes=found.pushes and (found.pushes["every"], found.pushes["impulse"]),
        seed=found.seed,
        physics_hz=found.physics_hz,
        control_hz=found.control_hz,
        solver=found.solver,
        com_generator=found.com_generator,
        out=Path(found.out),
        video=found.video,
        view=found.view,
        list_robots=found.list_robots,
        inspect=found.inspect,
        no_plots=found.no_plots,
        blind=found.blind,
        realism=found.realism,
        web=found.web,
        port=found.port,
        footsteps=found.footsteps,
        swing_height=found.swing_height,
        com_height=found.com_height,
        record_hz=found.record_hz,
        json=found.json,
        quiet=found.quiet,
        config=config_text(vars(found)),
    )


def _check_together(found: argparse.Namespace, parser: argparse.ArgumentParser) -> None:
    """End the command where options do not go together."""
    if len(found.velocity) != len(found.duration):
        parser.error(
            "--velocity: must come with one --duration each, got "
            f"{len(found.velocity)} of --velocity and {len(found.duration)} of --duration."
        )
    given = [name for name in STEPPING if vars(found)[name[2:].replace("-", "_")] is not None]
    if found.velocity and given:
        parser.error(
            f"{given[0]}: must be left out beside --velocity, which chooses the steps by itself."
        )
    if found.footsteps is not None and given != ["--footsteps"]:
        parser.error(f"{given[0]}: must be left out beside --footsteps, which has all of them.")


def _or(value: Any, default: Any) -> Any:
    return default if value is None else value
