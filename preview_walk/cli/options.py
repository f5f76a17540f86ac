"""The options of `preview-walk`: names, defaults, what is allowed, and a sentence when it isn't."""

from __future__ import annotations

import argparse
import re
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from math import radians
from pathlib import Path
from typing import Any, NoReturn

from preview_walk.cli.values import Reader, named_numbers, number, numbers, text, whole

DEFAULT_ROBOT = "talos"
DEFAULT_STEPS = 20
DEFAULT_STEP_LENGTH = 0.25
"""m"""
DEFAULT_STEP_TIME = 0.9
"""s, from one landing to the next"""
DEFAULT_DOUBLE_SUPPORT_RATIO = 0.2
DEFAULT_OUT = "walk"
MAX_STEPS = 100_000
PUSH_TIME = 0.2
"""s, of each push of `--pushes`"""

EXIT_CODES = """\
exit code: 0 walked and stood; 1 fell; 2 bad input or a result that could not be written;
3 an error of preview-walk itself; 130 stopped by Ctrl-C (the record so far is written)"""

_FLAGS = {
    "--video": "write walk.mp4 too; needs no screen",
    "--view": "show the walk live; needs a screen; the mouse can push the robot",
    "--list-robots": "print the robots of the catalogue and end",
}
_STEPPING = ("steps", "step_length", "step_time", "double_support_ratio", "turn")
"""Options of a walk by footsteps, which a walk by velocity chooses itself."""


@dataclass(frozen=True)
class Options:
    """What the command was asked for, SI units; None is the simulation's default.

    `commands`: pairs of a velocity (m/s, m/s, rad/s) and its duration (s); none: walk by footsteps.
    `random_pushes`: (every, impulse) in s and N·s. `inspect`: the model to report on, not to walk.
    """

    robot: str
    steps: int
    step_length: float
    step_time: float
    double_support_ratio: float
    turn: float
    commands: tuple[tuple[tuple[float, float, float], float], ...]
    start: tuple[float, float, float]
    friction: float | None
    pushes: tuple[tuple[float, float, tuple[float, float, float]], ...]
    random_pushes: tuple[float, float] | None
    seed: int
    physics_hz: int | None
    control_hz: int | None
    solver: str | None
    out: Path
    video: bool
    view: bool
    list_robots: bool
    inspect: str | None


def parse(argv: Sequence[str] | None = None) -> Options:
    """Read the command line; exit with code 2 and one sentence on stderr when it can't be.

    `argv` is without the program's name; None takes the process's own.
    """
    arguments = list(sys.argv[1:] if argv is None else argv)
    parser = _parser()
    found = parser.parse_args(_join_negative_values(arguments))
    if len(found.velocity) != len(found.duration):
        parser.error(
            "--velocity: must come with one --duration each, got "
            f"{len(found.velocity)} of --velocity and {len(found.duration)} of --duration."
        )
    given = [name for name in _STEPPING if getattr(found, name) is not None]
    if found.velocity and given:
        name = given[0].replace("_", "-")
        parser.error(
            f"--{name}: must be left out beside --velocity, which chooses the steps by itself."
        )
    x, y, yaw = found.start
    return Options(
        robot=found.robot,
        steps=_or(found.steps, DEFAULT_STEPS),
        step_length=_or(found.step_length, DEFAULT_STEP_LENGTH),
        step_time=_or(found.step_time, DEFAULT_STEP_TIME),
        double_support_ratio=_or(found.double_support_ratio, DEFAULT_DOUBLE_SUPPORT_RATIO),
        turn=radians(_or(found.turn, 0.0)),
        commands=tuple(
            ((v[0], v[1], radians(v[2])), duration)
            for v, duration in zip(found.velocity, found.duration, strict=True)
        ),
        start=(x, y, radians(yaw)),
        friction=found.friction,
        pushes=tuple((p[0], p[1], (p[2], p[3], p[4])) for p in found.push),
        random_pushes=found.pushes and (found.pushes["every"], found.pushes["impulse"]),
        seed=found.seed,
        physics_hz=found.physics_hz,
        control_hz=found.control_hz,
        solver=found.solver,
        out=Path(found.out),
        video=found.video,
        view=found.view,
        list_robots=found.list_robots,
        inspect=found.inspect,
    )


def _or(value: Any, default: Any) -> Any:
    return default if value is None else value


def _parser() -> _Parser:
    parser = _Parser(
        prog="preview-walk",
        description="A humanoid walks in MuJoCo by preview control and one whole-body QP a tick.",
        epilog=EXIT_CODES,
        formatter_class=argparse.RawDescriptionHelpFormatter,
        allow_abbrev=False,
    )

    def add(name: str, metavar: str, reader: Reader, help: str, **more: Any) -> None:
        parser.readers[name] = str(reader.__doc__)
        parser.add_argument(name, metavar=metavar, type=reader, help=help, **more)

    def repeat(name: str, metavar: str, reader: Reader, help: str) -> None:
        add(name, metavar, reader, help, action="append", default=[])

    reader = text("the name of a robot or the path of its model")
    line = f"robot of the catalogue, or a model file (default {DEFAULT_ROBOT})"
    add("--robot", "NAME|PATH", reader, line, default=DEFAULT_ROBOT)
    add("--steps", "N", whole(1, MAX_STEPS), f"number of steps (default {DEFAULT_STEPS})")
    reader = number("a length in metres from -2 to 2", lambda x: -2.0 <= x <= 2.0)
    line = "metres from one landing to the next; below 0 walks backwards "
    add("--step-length", "M", reader, f"{line}(default {DEFAULT_STEP_LENGTH})")
    reader = number("a time in seconds above 0 and up to 10", lambda x: 0.0 < x <= 10.0)
    line = f"seconds from one landing to the next (default {DEFAULT_STEP_TIME})"
    add("--step-time", "S", reader, line)
    reader = number("a share of the step time above 0 and below 1", lambda x: 0.0 < x < 1.0)
    line = f"share of the step time on both feet (default {DEFAULT_DOUBLE_SUPPORT_RATIO})"
    add("--double-support-ratio", "R", reader, line)
    reader = number("an angle in degrees from -90 to 90", lambda x: -90.0 <= x <= 90.0)
    add("--turn", "DEG", reader, "degrees to the left from each landing to the next (default 0)")
    reader = numbers("VX,VY,YAWRATE_DEG", " (m/s forward, m/s left, degrees per second left)")
    line = "walk at this velocity for the --duration that follows; may be repeated, then stops"
    repeat("--velocity", "VX,VY,YAWRATE_DEG", reader, line)
    reader = number("a time in seconds above 0 and up to 100000", lambda x: 0.0 < x <= 1e5)
    repeat("--duration", "S", reader, "how long the --velocity before it is walked at")
    reader = numbers("X,Y,YAW_DEG", " (metres, metres, degrees)")
    line = "where the middle of the feet stands at first and where it faces (default 0,0,0)"
    add("--start", "X,Y,YAW_DEG", reader, line, default=[0.0, 0.0, 0.0])
    reader = number("a friction coefficient above 0 and up to 10", lambda x: 0.0 < x <= 10.0)
    add("--friction", "MU", reader, "friction of the ground, known to the robot too")
    reader = numbers(
        "T,DURATION,FX,FY,FZ",
        " (seconds from 0 on, seconds above 0, newtons)",
        lambda xs: xs[0] >= 0.0 and xs[1] > 0.0,
    )
    line = "push the base (pelvis) from T on with this force in the world frame; may be repeated"
    repeat("--push", "T,DURATION,FX,FY,FZ", reader, line)
    reader = named_numbers(
        f"every=S,impulse=NS (seconds, {PUSH_TIME} or more; newton-seconds above 0)",
        ("every", "impulse"),
        lambda xs: xs["every"] >= PUSH_TIME and xs["impulse"] > 0.0,
    )
    line = f"push the base every S seconds in a random direction, for {PUSH_TIME} s"
    add("--pushes", "every=S,impulse=NS", reader, line)
    add("--seed", "N", whole(0, 2**32 - 1), "seed of whatever is random (default 0)", default=0)
    add("--physics-hz", "HZ", whole(1, 100_000), "steps of the physics per second")
    add("--control-hz", "HZ", whole(1, 100_000), "ticks of the controller per second")
    add("--solver", "NAME", text("the name of a QP solver"), "osqp, or another one of qpsolvers")
    line = "folder for record.npz, summary.json and the plots; replaces those of an earlier run "
    reader = text("the name of a folder")
    add("--out", "DIR", reader, f"{line}(default {DEFAULT_OUT})", default=DEFAULT_OUT)
    reader = text("the name of a robot or the path of its model")
    add(
        "--inspect", "NAME|PATH", reader, "print what is found in a model, draw its stance, and end"
    )
    for name, help in _FLAGS.items():
        parser.add_argument(name, action="store_true", help=help)
    return parser


class _Parser(argparse.ArgumentParser):
    """An argument parser that complains in one sentence."""

    def __init__(self, **arguments: Any) -> None:
        super().__init__(**arguments)
        self.readers: dict[str, str] = {}

    def error(self, message: str) -> NoReturn:
        """Print one sentence that names the option and what is allowed; exit with code 2."""
        missing = re.match(r"argument (--[\w-]+): expected one argument", message)
        unknown = re.match(r"unrecognized arguments: (\S+)", message)
        if missing:
            name = missing.group(1)
            message = f"{name}: must be {self.readers[name]}, got nothing."
        elif unknown:
            known = ", ".join(sorted([*self.readers, *_FLAGS, "--help"]))
            message = f"{unknown.group(1)}: no such option; allowed are {known}."
        complain(message.removeprefix("argument "))
        raise SystemExit(2)


def complain(sentence: str) -> None:
    """Print one line on stderr."""
    print(f"preview-walk: {' '.join(sentence.split())}", file=sys.stderr)


def _join_negative_values(arguments: list[str]) -> list[str]:
    """Write `--start -1,0,0` as `--start=-1,0,0`, which argparse takes for an option otherwise."""
    joined: list[str] = []
    for argument in arguments:
        follows_option = bool(joined) and re.fullmatch(r"--[a-z-]+", joined[-1]) is not None
        if follows_option and re.match(r"-(\d|\.|inf|nan)", argument):
            joined[-1] += f"={argument}"
        else:
            joined.append(argument)
    return joined
