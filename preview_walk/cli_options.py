"""The options of `preview-walk`: names, defaults, what is allowed, and a sentence when it isn't."""

from __future__ import annotations

import argparse
import re
import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import isfinite, radians
from pathlib import Path
from typing import Any, NoReturn

DEFAULT_ROBOT = "talos"
DEFAULT_STEPS = 20
DEFAULT_STEP_LENGTH = 0.25
"""m"""
DEFAULT_STEP_TIME = 0.9
"""s, from one landing to the next"""
DEFAULT_DOUBLE_SUPPORT_RATIO = 0.2
DEFAULT_OUT = "walk"
MAX_STEPS = 100_000

EXIT_CODES = """\
exit code: 0 walked and stood; 1 fell; 2 bad input or a result that could not be written;
3 an error of preview-walk itself; 130 stopped by Ctrl-C (the record so far is written)"""


@dataclass(frozen=True)
class Options:
    """What the command was asked for, SI units; `friction` None is the simulation's default."""

    robot: str
    steps: int
    step_length: float
    step_time: float
    double_support_ratio: float
    start: tuple[float, float, float]
    friction: float | None
    pushes: tuple[tuple[float, float, tuple[float, float, float]], ...]
    seed: int
    out: Path
    video: bool
    view: bool


def parse(argv: Sequence[str] | None = None) -> Options:
    """Read the command line; exit with code 2 and one sentence on stderr when it can't be.

    `argv` is without the program's name; None takes the process's own.
    """
    arguments = list(sys.argv[1:] if argv is None else argv)
    found = _parser().parse_args(_join_negative_values(arguments))
    x, y, yaw = found.start
    return Options(
        robot=found.robot,
        steps=found.steps,
        step_length=found.step_length,
        step_time=found.step_time,
        double_support_ratio=found.double_support_ratio,
        start=(x, y, radians(yaw)),
        friction=found.friction,
        pushes=tuple((p[0], p[1], (p[2], p[3], p[4])) for p in found.push),
        seed=found.seed,
        out=Path(found.out),
        video=found.video,
        view=found.view,
    )


def _value(
    allowed: str, read: Callable[[str], Any], accept: Callable[[Any], bool]
) -> Callable[[str], Any]:
    """Return a reader of one option's text, whose error says what is allowed."""

    def convert(text: str) -> Any:
        try:
            value = read(text)
        except ValueError:
            value = None
        if value is None or not accept(value):
            raise argparse.ArgumentTypeError(f"must be {allowed}, got '{text}'.")
        return value

    convert.__doc__ = allowed  # `_Parser.error` quotes it when the value is missing
    return convert


def _whole(low: int, high: int) -> Callable[[str], Any]:
    return _value(f"a whole number from {low} to {high}", int, lambda n: low <= n <= high)


def _number(allowed: str, accept: Callable[[float], bool]) -> Callable[[str], Any]:
    return _value(allowed, float, lambda x: isfinite(x) and accept(x))


def _numbers(
    names: str, rule: str = "", accept: Callable[[list[float]], bool] = lambda _: True
) -> Any:
    """Return a reader of finite numbers separated by commas, as many as there are names."""
    count = names.count(",") + 1
    allowed = f"{count} numbers {names} separated by commas{rule}"
    return _value(
        allowed,
        lambda text: [float(part) for part in text.split(",")],
        lambda xs: len(xs) == count and all(map(isfinite, xs)) and accept(xs),
    )


def _text(allowed: str) -> Callable[[str], Any]:
    return _value(allowed, str, bool)


def _parser() -> _Parser:
    parser = _Parser(
        prog="preview-walk",
        description="A humanoid walks in MuJoCo by preview control and one whole-body QP a tick.",
        epilog=EXIT_CODES,
        formatter_class=argparse.RawDescriptionHelpFormatter,
        allow_abbrev=False,
    )

    def add(name: str, metavar: str, reader: Callable[[str], Any], help: str, **more: Any) -> None:
        parser.readers[name] = str(reader.__doc__)
        parser.add_argument(name, metavar=metavar, type=reader, help=help, **more)

    add(
        "--robot",
        "NAME|PATH",
        _text("the name of a robot or the path of its model"),
        f"robot of the catalogue, or a model file (default {DEFAULT_ROBOT})",
        default=DEFAULT_ROBOT,
    )
    add(
        "--steps",
        "N",
        _whole(1, MAX_STEPS),
        f"number of steps (default {DEFAULT_STEPS})",
        default=DEFAULT_STEPS,
    )
    add(
        "--step-length",
        "M",
        _number("a length in metres from -2 to 2", lambda x: -2.0 <= x <= 2.0),
        "metres from one landing to the next; below 0 walks backwards "
        f"(default {DEFAULT_STEP_LENGTH})",
        default=DEFAULT_STEP_LENGTH,
    )
    add(
        "--step-time",
        "S",
        _number("a time in seconds above 0 and up to 10", lambda x: 0.0 < x <= 10.0),
        f"seconds from one landing to the next (default {DEFAULT_STEP_TIME})",
        default=DEFAULT_STEP_TIME,
    )
    add(
        "--double-support-ratio",
        "R",
        _number("a share of the step time above 0 and below 1", lambda x: 0.0 < x < 1.0),
        f"share of the step time on both feet (default {DEFAULT_DOUBLE_SUPPORT_RATIO})",
        default=DEFAULT_DOUBLE_SUPPORT_RATIO,
    )
    add(
        "--start",
        "X,Y,YAW_DEG",
        _numbers("X,Y,YAW_DEG", " (metres, metres, degrees)"),
        "where the middle of the feet stands at first and where it faces (default 0,0,0)",
        default=[0.0, 0.0, 0.0],
    )
    add(
        "--friction",
        "MU",
        _number("a friction coefficient above 0 and up to 10", lambda x: 0.0 < x <= 10.0),
        "friction of the ground, known to the robot too",
        default=None,
    )
    add(
        "--push",
        "T,DURATION,FX,FY,FZ",
        _numbers(
            "T,DURATION,FX,FY,FZ",
            " (seconds from 0 on, seconds above 0, newtons)",
            lambda xs: xs[0] >= 0.0 and xs[1] > 0.0,
        ),
        "push the torso from T on with this force in the world frame; may be repeated",
        action="append",
        default=[],
    )
    add("--seed", "N", _whole(0, 2**32 - 1), "seed of whatever is random (default 0)", default=0)
    add(
        "--out",
        "DIR",
        _text("the name of a folder"),
        "folder for record.npz, summary.json and the plots; replaces those of an earlier run "
        f"(default {DEFAULT_OUT})",
        default=DEFAULT_OUT,
    )
    parser.add_argument("--video", action="store_true", help="write walk.mp4 too; needs no screen")
    parser.add_argument("--view", action="store_true", help="show the walk live; needs a screen")
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
            known = ", ".join(sorted([*self.readers, "--video", "--view", "--help"]))
            message = f"{unknown.group(1)}: no such option; allowed are {known}."
        complain(message.removeprefix("argument "))
        raise SystemExit(2)


def complain(sentence: str) -> None:
    """Print one line on stderr."""
    print(f"preview-walk: {' '.join(sentence.split())}", file=sys.stderr)


def _join_negative_values(arguments: list[str]) -> list[str]:
    """Write `--start -1,0,0` as `--start=-1,0,0`, which argparse takes for an option otherwise."""
    joined: list[str] = []
    for text in arguments:
        follows_option = bool(joined) and re.fullmatch(r"--[a-z-]+", joined[-1]) is not None
        if follows_option and re.match(r"-(\d|\.|inf|nan)", text):
            joined[-1] += f"={text}"
        else:
            joined.append(text)
    return joined
