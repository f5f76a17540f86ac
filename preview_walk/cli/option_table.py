"""The table of the options: name, what it reads, what is allowed, default, help."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from preview_walk.cli.values import Reader, named_numbers, number, numbers, text, whole

DEFAULT_ROBOT = "talos"
DEFAULT_STEPS = 20
DEFAULT_DOUBLE_SUPPORT_RATIO = 0.2
DEFAULT_OUT = "walk"
DEFAULT_PORT = 8080
MAX_STEPS = 100_000
PUSH_TIME = 0.2
"""Seconds that each push of `--pushes` lasts."""

MAX_SPEED, MAX_YAW_RATE = 10.0, 720.0
"""Of `--velocity`: m/s and degrees per second. What legs can do is less; it is scaled down to."""
MAX_FORCE, MAX_IMPULSE = 1e4, 2e3
"""Of a push: N and N·s. The robots of the catalogue fall at a tenth of these."""
MAX_TIME = 1e5
"""Seconds, of a walk and of a push."""
MAX_DISTANCE = 1e5
"""Metres of the start from the origin; further off the sums lose the tenths of a millimetre."""


@dataclass(frozen=True)
class Option:
    """An option that takes a value.

    Attributes:
        name: as it is typed.
        metavar: what stands for its value.
        reader: reads the value.
        help: one line.
        default: None where leaving it out has a meaning of its own.
        repeated: whether it may come more than once; then the value is a list.
    """

    name: str
    metavar: str
    reader: Reader
    help: str
    default: Any = None
    repeated: bool = False


def _velocity(xs: list[float]) -> bool:
    return max(abs(xs[0]), abs(xs[1])) <= MAX_SPEED and abs(xs[2]) <= MAX_YAW_RATE


def _push(xs: list[float]) -> bool:
    return (
        0.0 <= xs[0] <= MAX_TIME and 0.0 < xs[1] <= MAX_TIME and max(map(abs, xs[2:])) <= MAX_FORCE
    )


_STEPPING = (
    Option(
        "--steps",
        "N",
        whole(1, MAX_STEPS),
        f"number of steps (default {DEFAULT_STEPS})",
    ),
    Option(
        "--step-length",
        "M",
        number("a length in metres from -2 to 2", lambda x: -2.0 <= x <= 2.0),
        "metres from one landing to the next; below 0 walks backwards "
        "(default 0.25, less for short legs)",
    ),
    Option(
        "--step-time",
        "S",
        number("a time in seconds above 0 and up to 10", lambda x: 0.0 < x <= 10.0),
        "seconds from one landing to the next (default by the leg, 0.9 for one of 0.8 m)",
    ),
    Option(
        "--double-support-ratio",
        "R",
        number("a share of the step time above 0 and below 1", lambda x: 0.0 < x < 1.0),
        f"share of the step time on both feet (default {DEFAULT_DOUBLE_SUPPORT_RATIO})",
    ),
    Option(
        "--turn",
        "DEG",
        number("an angle in degrees from -90 to 90", lambda x: -90.0 <= x <= 90.0),
        "degrees to the left from each landing to the next (default 0)",
    ),
)

_FOOTSTEPS = Option(
    "--footsteps",
    "FILE",
    text("the name of a CSV or JSON file"),
    "walk along the footsteps of a file instead (columns foot, x, y, yaw_deg, lift, time)",
)

STEPPING = (*(option.name for option in _STEPPING), _FOOTSTEPS.name)
"""Options of a walk by footsteps, which a walk by velocity chooses itself."""

OPTIONS = (
    Option(
        "--robot",
        "NAME|PATH",
        text("the name of a robot or the path of its model"),
        f"robot of the catalogue, or a model file (default {DEFAULT_ROBOT})",
        DEFAULT_ROBOT,
    ),
    *_STEPPING,
    _FOOTSTEPS,
    Option(
        "--velocity",
        "VX,VY,YAWRATE_DEG",
        numbers(
            "VX,VY,YAWRATE_DEG",
            f" (m/s forward and m/s left, up to {MAX_SPEED:g} either way, degrees per second left, "
            f"up to {MAX_YAW_RATE:g})",
            _velocity,
        ),
        "walk at this velocity for the --duration that follows; may be repeated, then stops",
        repeated=True,
    ),
    Option(
        "--duration",
        "S",
        number("a time in seconds above 0 and up to 100000", lambda x: 0.0 < x <= MAX_TIME),
        "how long the --velocity before it is walked at",
        repeated=True,
    ),
    Option(
        "--start",
        "X,Y,YAW_DEG",
        numbers(
            "X,Y,YAW_DEG",
            f" (metres, metres, degrees, up to {MAX_DISTANCE:g} either way)",
            lambda xs: max(map(abs, xs)) <= MAX_DISTANCE,
        ),
        "where the middle of the feet stands at first and where it faces (default 0,0,0)",
        [0.0, 0.0, 0.0],
    ),
    Option(
        "--friction",
        "MU",
        number("a friction coefficient above 0 and up to 10", lambda x: 0.0 < x <= 10.0),
        "friction of the ground, known to the robot too",
    ),
    Option(
        "--ground",
        "NAME:KEY=VALUE,...",
        text("the name of a ground, as slope:degrees=8"),
        "slope, stairs, ramps, blocks, stones, rough or heightfield:FILE; all steps are laid on it",
    ),
    Option(
        "--realism",
        "none|lab|field",
        text("none, lab or field"),
        "sensors, motors and a model as good as in a laboratory, or in the field; seeded by --seed",
    ),
    Option(
        "--push",
        "T,DURATION,FX,FY,FZ",
        numbers(
            "T,DURATION,FX,FY,FZ",
            f" (seconds from 0 on, seconds above 0, newtons up to {MAX_FORCE:g} either way)",
            _push,
        ),
        "push the base (pelvis) from T on with this force in the world frame; may be repeated",
        repeated=True,
    ),
    Option(
        "--pushes",
        "every=S,impulse=NS",
        named_numbers(
            f"every=S,impulse=NS (seconds, {PUSH_TIME} or more; newton-seconds above 0 and up to "
            f"{MAX_IMPULSE:g})",
            ("every", "impulse"),
            lambda xs: PUSH_TIME <= xs["every"] <= MAX_TIME and 0.0 < xs["impulse"] <= MAX_IMPULSE,
        ),
        f"push the base every S seconds in a random direction, for {PUSH_TIME} s",
    ),
    Option("--seed", "N", whole(0, 2**32 - 1), "seed of whatever is random (default 0)", 0),
    Option("--physics-hz", "HZ", whole(1, 100_000), "steps of the physics per second"),
    Option("--control-hz", "HZ", whole(1, 100_000), "ticks of the controller per second"),
    Option(
        "--solver", "NAME", text("the name of a QP solver"), "osqp, or another one of qpsolvers"
    ),
    Option(
        "--com-generator",
        "preview|mpc|dcm",
        text("the name of a CoM generator"),
        "preview control (default), Wieber's ZMP MPC or the plan's DCM leads the CoM",
    ),
    Option(
        "--record-hz",
        "HZ",
        number("rows per second above 0 and up to 1e5", lambda x: 0.0 < x <= 1e5),
        "rows of the record per second (default: one a tick); for long walks",
    ),
    Option(
        "--swing-height",
        "M",
        number("a height in metres from 0 to 1", lambda x: 0.0 <= x <= 1.0),
        "height of the swinging foot (default: by the leg)",
    ),
    Option(
        "--com-height",
        "M",
        number("a height in metres above 0 and up to 5", lambda x: 0.0 < x <= 5.0),
        "height of the CoM above the soles (default: the walking posture's)",
    ),
    Option(
        "--config",
        "FILE",
        text("the name of a TOML file"),
        "options from a file, as the run.toml beside a walk's results; those typed come on top",
    ),
    Option(
        "--out",
        "DIR",
        text("the name of a folder"),
        "folder for record.npz, summary.json and the plots; replaces those of an earlier run "
        f"(default {DEFAULT_OUT})",
        DEFAULT_OUT,
    ),
    Option(
        "--port",
        "N",
        whole(0, 65535),
        f"port of --web on this machine; 0 takes any that is free (default {DEFAULT_PORT})",
        DEFAULT_PORT,
    ),
    Option(
        "--inspect",
        "NAME|PATH",
        text("the name of a robot or the path of its model"),
        "print what is found in a model, draw its stance, and end",
    ),
)
"""The options that take a value, in the order of `--help`."""

FLAGS = {
    "--blind": "the robot takes the --ground for level and feels its way",
    "--no-plots": "write record.npz and summary.json only (and walk.mp4 where it is asked for)",
    "--video": "write walk.mp4 too; needs no screen",
    "--view": "show the walk live; needs a screen; arrow keys steer, the mouse pushes",
    "--web": "show the walk live in the browser, to be steered and pushed; writes walk.html too",
    "--json": "print the figures as JSON in place of the table",
    "--quiet": "print nothing but errors",
    "--list-robots": "print the robots of the catalogue and end",
}
"""The options that take none."""
