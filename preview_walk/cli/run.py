"""One run of the command: plan, walk, print the table, write the folder."""

from __future__ import annotations

import json
import os
import sys
from functools import partial
from pathlib import Path
from typing import Any

import preview_walk as pw
from preview_walk.cli.interruption import Interruption
from preview_walk.cli.naming import naming
from preview_walk.cli.option_table import PUSH_TIME
from preview_walk.cli.options import Options
from preview_walk.cli.progress import progress_bar
from preview_walk.cli.results import (
    BLOCKS,
    CONFIG,
    RECORD,
    result_names,
    write_results,
    writers_of,
)
from preview_walk.cli.streams import complain, emphasised, say
from preview_walk.controller.robot_limits import usual_planner
from preview_walk.errors import InvalidInput
from preview_walk.files import claimed, make_folder, whole_file
from preview_walk.footsteps.plan import FootstepPlan
from preview_walk.record.blocks import remove_blocks
from preview_walk.record.record import Record
from preview_walk.robots.robot import Robot
from preview_walk.simulation.pushes import Push, random_pushes

RAMP_LENGTH, RAMP_SHARE = 0.1, 0.125
"""The walk speeds up and slows down by about so much a step (m), and by no more than this share of
the leg."""


def run(options: Options, command: str, interruption: Interruption) -> Record:
    """Walk as the options say, print the table and write the folder; return the record.

    Args:
        options: what is asked for.
        command: the command line, kept with the record.
        interruption: receives the signals.

    Raises:
        PreviewWalkError: bad input, named by its option, or a result that cannot be written.
    """
    with naming("--view"):
        _require_screen(options.view)
    with naming("--web"):
        _require_page(options)
    with naming("--robot"):
        robot = pw.load_robot(options.robot)
    with naming("--step-length"):
        plan = _plan(options, robot)
    end = sum(duration for _, duration in options.commands) if plan is None else plan.end
    with naming("--push"):
        pushes = _pushes(options, end)
    with naming("--pushes"):
        pushes += _random_pushes(options, end)
    make_folder(options.out, result_names())
    with claimed(options.out):
        record = _walk(options, robot, plan, pushes, interruption).with_run(command=command)
        interruption.hold()
        return _write(record, robot, options, interruption)


def _write(record: Record, robot: Robot, options: Options, interruption: Interruption) -> Record:
    """Print the table of a walk and write the folder; return the record."""
    stopped = record.run.interrupted
    if stopped:
        span = f"{len(record) * record.dt:.2f} s"
        say(f"Stopped by {interruption.name} after {span}; this is the walk so far.")
    _show(record, options)
    figures, pictures = writers_of(
        record,
        robot,
        pictures=not options.no_plots,
        film=options.video and not stopped,
        page=options.web and not options.no_plots,
        quiet=options.quiet,
    )
    figures = {**figures, CONFIG: partial(_keep_config, options.config)}
    written, failure = write_results(options.out, figures, pictures, interruption)
    if not options.quiet and not options.json:
        say(f"Written to {options.out}: {', '.join(written) or 'nothing'}")
    if RECORD in written:
        remove_blocks(options.out / BLOCKS)
    if failure is not None:
        raise failure
    if len(written) < len(figures) + len(pictures):
        complain(f"stopped by {interruption.name} while writing; the other pictures are left out.")
    return record


def _show(record: Record, options: Options) -> None:
    """Print the figures of a walk as they are asked for."""
    if options.json:
        say(json.dumps(record.summary().as_json(), indent=2))
    elif not options.quiet:
        say(emphasised(str(record.summary())))


def _keep_config(text: str, path: Path) -> None:
    with whole_file(path) as part:
        part.write_text(text, encoding="utf-8")


def _walk(
    options: Options,
    robot: Robot,
    plan: FootstepPlan | None,
    pushes: tuple[Push, ...],
    interruption: Interruption,
) -> Record:
    """Walk along the plan, or by the commands where there is none; return the record."""
    given = {
        "friction": options.friction,
        "physics_hz": options.physics_hz,
        "control_hz": options.control_hz,
        "solver": options.solver,
        "com_generator": options.com_generator,
        "swing_height": options.swing_height,
        "com_height": options.com_height,
        "record_hz": options.record_hz,
        "blocks": options.out / BLOCKS,
    }
    with naming("--robot"), progress_bar(shown=not options.quiet) as show:

        def progress(time: float, end: float) -> None:
            interruption.hold()
            interruption.check()
            show(time, end)

        settings: Any = {
            "pushes": pushes,
            "seed": options.seed,
            "progress": progress,
            "viewer": partial(pw.show, port=options.port) if options.web else options.view,
            **{name: value for name, value in given.items() if value is not None},
        }
        if options.ground is not None:
            settings["ground"] = pw.read_ground(options.ground)
        if options.realism is not None:
            settings["realism"] = pw.read_realism(options.realism)
        if options.blind:
            settings["blind"] = True
        if plan is None:
            return pw.simulate_commands(robot, options.commands, start=options.start, **settings)
        return pw.simulate(robot, plan, **settings)


def _plan(options: Options, robot: Robot) -> FootstepPlan | None:
    """Return the footsteps of a file, of a straight walk or an arc; None for a walk by commands."""
    if options.commands:
        return None
    if options.footsteps is not None:
        return pw.read_footsteps(options.footsteps)
    usual = usual_planner(robot)
    planner = pw.FootstepPlanner(
        step_length=usual.step_length if options.step_length is None else options.step_length,
        step_width=robot.step_width,
        step_time=usual.step_time if options.step_time is None else options.step_time,
        double_support_ratio=options.double_support_ratio,
    )
    ramp = round(abs(planner.step_length) / min(RAMP_LENGTH, RAMP_SHARE * robot.leg_length))
    return planner.generate_footsteps(options.steps, options.start, turn=options.turn, ramp=ramp)


def _pushes(options: Options, end: float) -> tuple[Push, ...]:
    """Return the pushes asked for one by one; the walk ends at `end` (s)."""
    for time, _, _ in options.pushes:
        if time >= end:
            raise InvalidInput(f"must begin before the walk ends at {end:.2f} s, got {time:g} s.")
    return tuple(Push(time, duration, force) for time, duration, force in options.pushes)


def _random_pushes(options: Options, end: float) -> tuple[Push, ...]:
    """Return the random series of pushes; the walk ends at `end` (s)."""
    if options.random_pushes is None:
        return ()
    every, impulse = options.random_pushes
    if every >= end:
        raise InvalidInput(f"must begin before the walk ends at {end:.2f} s, got every={every:g}.")
    return random_pushes(every, impulse, PUSH_TIME, end, options.seed)


def _require_page(options: Options) -> None:
    if not options.web:
        return
    from preview_walk.viewer.web.server import require_port, require_web

    if options.view:
        raise InvalidInput("must be left out beside --view; one walk is watched in one place.")
    require_web()
    require_port(options.port)


def _require_screen(view: bool) -> None:
    screens = ("DISPLAY", "WAYLAND_DISPLAY")
    if view and sys.platform.startswith("linux") and not any(map(os.environ.get, screens)):
        raise InvalidInput("needs a screen, and there is none; allowed without one is --video.")
