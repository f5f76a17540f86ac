"""The command `preview-walk`: plan, walk, print the table, write the folder."""

from __future__ import annotations

import os
import re
import shlex
import sys
import traceback
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from functools import partial
from io import StringIO
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

from preview_walk.cli.options import PUSH_TIME, Options, complain, parse
from preview_walk.errors import InvalidInput, PreviewWalkError
from preview_walk.files import OutputError, whole_file

if TYPE_CHECKING:
    from preview_walk.footsteps.plan import FootstepPlan
    from preview_walk.record.record import Record
    from preview_walk.robots.robot import Robot
    from preview_walk.simulation.pushes import Push

RAMP_LENGTH = 0.1
"""m: the walk speeds up and slows down by about this much a step."""

WALKED, FELL, BAD_INPUT, BUG, STOPPED = 0, 1, 2, 3, 130

_OPTION_OF = {
    "step_length": "--step-length",
    "step_time": "--step-time",
    "double_support_ratio": "--double-support-ratio",
    "step_width": "--robot",
    "n_steps": "--steps",
    "start_pos": "--start",
    "turn": "--turn",
    "physics_hz": "--physics-hz",
    "friction": "--friction",
    "solver": "--solver",
    "push": "--push",
    "seed": "--seed",
    "robot": "--robot",
    # Words in which the check of a plan says what is wrong with a step.
    "ahead": "--step-length",
    "behind": "--step-length",
    "air": "--step-time",
    "turns": "--turn",
    "collides": "--turn",
    "beside": "--turn",
    "across": "--turn",
}
"""The option that sets an argument of the library, by the words that its errors use."""


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command with `argv` (default: the process's); return the exit code."""
    try:
        options = parse(argv)
        command = shlex.join(["preview-walk", *(sys.argv[1:] if argv is None else argv)])
        return _run(options, command)
    except OutputError as error:
        reason = str(error).rstrip(".")
        complain(f"--out: {reason}; choose a folder that can be written, with space left.")
        return BAD_INPUT
    except PreviewWalkError as error:
        complain(str(error))
        return BAD_INPUT
    except KeyboardInterrupt:
        complain("stopped by Ctrl-C.")
        return STOPPED
    except ImportError as error:
        missing = re.match(r"(lib[\w.+-]+): cannot open shared object file", str(error))
        if missing is None:
            traceback.print_exc()
        else:
            library = missing.group(1)
            complain(f"{library} is missing; on Debian or Ubuntu sudo apt install libgomp1 helps.")
        return BUG
    except Exception:
        traceback.print_exc()
        return BUG


def _run(options: Options, command: str) -> int:
    if options.list_robots:
        from preview_walk.robots.listing import list_robots

        _say(list_robots())
        return WALKED
    if options.inspect is not None:
        return _inspect(options.inspect, options.out)
    with _naming("--view"):
        _require_screen(options.view)
    import preview_walk as pw  # not before the options are right: engines take a while to load

    with _naming("--robot"):
        robot = pw.load_robot(options.robot)
    with _naming("--step-length", _OPTION_OF):
        plan = None if options.commands else _plan(options, robot)
    end = sum(duration for _, duration in options.commands) if plan is None else plan.end
    with _naming("--push"):
        pushes = _pushes(options, end)
    with _naming("--pushes"):
        pushes += _random_pushes(options, end)
    _make_folder(options.out)
    given = {
        "friction": options.friction,
        "physics_hz": options.physics_hz,
        "control_hz": options.control_hz,
        "solver": options.solver,
    }
    with _naming("--robot", _OPTION_OF), _progress_bar() as progress:
        settings: Any = {
            "pushes": pushes,
            "seed": options.seed,
            "progress": progress,
            "viewer": options.view,
            **{name: value for name, value in given.items() if value is not None},
        }
        if plan is None:
            record = pw.simulate_commands(robot, options.commands, start=options.start, **settings)
        else:
            record = pw.simulate(robot, plan, **settings)
    record = record.with_run(command=command)
    stopped = record.run.interrupted
    if stopped:
        _say(f"Stopped by Ctrl-C after {len(record) * record.dt:.2f} s; this is the walk so far.")
    _say(str(record.summary()))
    written, failure = _write(record, robot, options.out, video=options.video and not stopped)
    _say(f"Written to {options.out}: {', '.join(written) or 'nothing'}")
    if failure is not None:
        raise failure
    if stopped:
        return STOPPED
    return FELL if record.run.fell else WALKED


def _inspect(model: str, folder: Path) -> int:
    """Print the report on a model and draw its stance; it is bad input if it cannot stand."""
    from preview_walk.robots.inspection import inspect_robot

    inspection = inspect_robot(model)
    _say(str(inspection))
    if inspection.robot is None:
        complain(f"--inspect: {inspection.problems[0].rstrip('.')}.")
        return BAD_INPUT
    _make_folder(folder)
    picture = folder / "stance.png"
    with _naming("--inspect"), whole_file(picture) as part:
        inspection.write_picture(part)
    _say(f"\nstance and soles: {picture}")
    return WALKED


def _plan(options: Options, robot: Robot) -> FootstepPlan:
    from preview_walk.footsteps.planner import FootstepPlanner

    planner = FootstepPlanner(
        step_length=options.step_length,
        step_width=robot.step_width,
        step_time=options.step_time,
        double_support_ratio=options.double_support_ratio,
    )
    ramp = round(abs(options.step_length) / RAMP_LENGTH)
    return planner.generate_footsteps(options.steps, options.start, turn=options.turn, ramp=ramp)


def _pushes(options: Options, end: float) -> tuple[Push, ...]:
    """Return the pushes asked for one by one; the walk ends at `end` (s)."""
    from preview_walk.simulation.pushes import Push

    for time, _, _ in options.pushes:
        if time >= end:
            raise InvalidInput(f"must begin before the walk ends at {end:.2f} s, got {time:g} s.")
    return tuple(Push(time, duration, force) for time, duration, force in options.pushes)


def _random_pushes(options: Options, end: float) -> tuple[Push, ...]:
    """Return the random series of pushes; the walk ends at `end` (s)."""
    if options.random_pushes is None:
        return ()
    from preview_walk.simulation.pushes import random_pushes

    every, impulse = options.random_pushes
    if every >= end:
        raise InvalidInput(f"must begin before the walk ends at {end:.2f} s, got every={every:g}.")
    return random_pushes(every, impulse, PUSH_TIME, end, options.seed)


def _write(
    record: Record, robot: Robot, folder: Path, *, video: bool
) -> tuple[list[str], PreviewWalkError | None]:
    """Write everything to the folder, most precious first.

    Returns the names of the files written and the first failure: where a disk has no room for the
    record, it may have for the figures.
    """
    from preview_walk.analysis.plots import PLOTS, plot, save_plot

    writers: dict[str, Callable[[Path], object]] = {
        "record.npz": record.save,
        "summary.json": record.summary().write,
        "walk.png": partial(plot, record),
        **{f"{name}.png": partial(save_plot, record, name) for name in PLOTS},
        "walk.mp4": partial(_film, record, robot),
    }
    for name in writers:  # nothing may stay that could be taken for a part of this run
        (folder / name).unlink(missing_ok=True)
    if not len(record):
        writers = {name: writers[name] for name in ("record.npz", "summary.json")}
    elif not video:
        del writers["walk.mp4"]
    written: list[str] = []
    failure: PreviewWalkError | None = None
    for name, write in writers.items():
        try:
            write(folder / name)
            written.append(name)
        except PreviewWalkError as error:
            failure = failure or error
    return written, failure


def _film(record: Record, robot: Robot, path: Path) -> None:
    from preview_walk.viewer.video import render_video

    with _naming("--video"), whole_file(path) as part:
        render_video(record, robot, part)


def _say(text: str) -> None:
    """Print to stdout, whose reader may have gone (as in `preview-walk | head -1`)."""
    try:
        print(text, flush=True)
    except BrokenPipeError:
        sys.stdout = StringIO()


@contextmanager
def _naming(option: str, known: Mapping[str, str] = MappingProxyType({})) -> Iterator[None]:
    """Put an option's name before the sentence of an error: `option`, or a `known` word's."""
    try:
        yield
    except OutputError:
        raise
    except PreviewWalkError as error:
        words = [getattr(error, "argument", None), *re.findall(r"\w+", str(error))]
        name = next((known[word] for word in words if word in known), option)
        raise InvalidInput(f"{name}: {str(error).rstrip('.')}.") from error


def _make_folder(folder: Path) -> None:
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OutputError(f"cannot make the folder {folder}: {error.strerror}.") from error
    if not os.access(folder, os.W_OK):
        raise OutputError(f"cannot write to the folder {folder}: Permission denied.")


def _require_screen(view: bool) -> None:
    screens = ("DISPLAY", "WAYLAND_DISPLAY")
    if view and sys.platform.startswith("linux") and not any(map(os.environ.get, screens)):
        raise InvalidInput("needs a screen, and there is none; allowed without one is --video.")


@contextmanager
def _progress_bar() -> Iterator[Callable[[float, float], None]]:
    """Show a bar on stderr; gives the function to call with the simulated time and its end, s."""
    from tqdm import tqdm

    form = "{desc}: {percentage:3.0f}%|{bar}| {n:.1f}/{total:.1f} s [{elapsed}<{remaining}]"
    # None before the walk begins: bad input is to get its sentence and nothing else.
    bars: list[Any] = []

    def progress(time: float, end: float) -> None:
        if not bars:
            interval = 0.1 if sys.stderr.isatty() else 5.0
            bars.append(tqdm(desc="walking", total=end, bar_format=form, mininterval=interval))
        bars[0].total = end
        bars[0].update(time - bars[0].n)

    try:
        yield progress
    finally:
        for bar in bars:
            bar.close()


if __name__ == "__main__":
    raise SystemExit(main())
