"""Public calls of the walk's rooms given what no caller should give: one sentence, or a result.

The planning and preview rooms have tests of this kind of their own.
"""

from __future__ import annotations

import warnings
from collections.abc import Callable, Iterator
from dataclasses import fields
from pathlib import Path
from typing import Any

import mujoco
import numpy as np
import pytest
from synthetic_walk import walk_record

import preview_walk as pw
from preview_walk.errors import InvalidInput
from preview_walk.files import OutputError
from preview_walk.viewer.web.server import require_port

ODD: list[Any] = [
    "text", "", "\0", b"bytes", None, 1j, [], [1.0], [1.0, "two", 3.0], [[1.0], [1.0, 2.0]], {},
    {"foot": "left"}, np.zeros(0), np.zeros(3), np.zeros((4, 4)), np.full((4, 4), np.nan),
    np.array(["a", "b"]), np.array([1j, 2j, 3j]), 1e308, -1e308, 5e-324, np.nan, np.inf, -np.inf,
    10**400, -1, 0, True, object(), len, int, (1e308, 1e308, 1e308), (np.nan, 0.0, 0.0), 1e30, 1e9,
    [None], [[(0.1, 0.0, 0.0)]], [((0.1, 0.0, 0.0), np.nan)], [(None, 1.0)], "x" * 5000,
]  # fmt: skip

NAME = "humanoid-walker"
ROBOT = pw.load_robot(NAME)
PLAN = pw.FootstepPlanner(0.2, ROBOT.step_width, 0.8).generate_footsteps(2)
EYE = np.eye(4)
WIDTH = ROBOT.step_width
PUSH = pw.Push(0.0, 0.1, (1.0, 0.0, 0.0))
SCENE = """<mujoco><worldbody><geom type="plane" size="1 1 1"/></worldbody></mujoco>"""


class Over(KeyboardInterrupt):
    """Ends a run after its first tick, as Ctrl-C does."""


def stop(walk: pw.Walk) -> None:
    raise Over


def run(walk: pw.Walk) -> None:
    """Run a walk for a few ticks at most."""
    walk.run(until=walk.time + 0.004)


def scene_of(robot: pw.Robot) -> mujoco.MjModel:
    """Return the world that the project itself makes: a scene with a floor."""
    return pw.World(robot).model


RECORD = walk_record(4)
MODEL = scene_of(ROBOT)
LAB = pw.WalkingController(MODEL, mujoco.MjData(MODEL))
WALK, STANDING = pw.Walk(ROBOT, PLAN, on_tick=stop), pw.Walk.standing(ROBOT)
FEW = {"friction": 0.8, "physics_hz": 1000, "pushes": (PUSH,), "visuals": False}
SETTINGS: dict[str, Any] = FEW | {
    "control_hz": 500, "seed": 1, "gains": pw.TrackingGains(), "solver": "osqp",
    "swing_height": 0.05, "com_height": ROBOT.com_height, "on_tick": stop,
}  # fmt: skip
WHOLE = {name: value for name, value in SETTINGS.items() if name != "visuals"}

SLOW = (
    "run_in_viewer",
    "show",
    "export_html",
    "plot",
    "plot_all",
    "write_picture",
    "render_video",
    "frames",
)
"""What is right of these needs a screen or draws for seconds; tests of their own do that."""

Case = tuple[Callable[..., object], dict[str, Any]]
CALLS: dict[str, Case] = {
    "TrackingGains": (
        pw.TrackingGains,
        {gain.name: 1.0 for gain in fields(pw.TrackingGains)},
    ),
    "Push": (
        pw.Push,
        {"t": 0.0, "duration": 1.0, "force": (1.0, 0.0, 0.0), "body": "pelvis"}
        | {"point": (0.0, 0.0, 0.0)},
    ),
    "random_pushes": (
        pw.random_pushes,
        {"every": 1.0, "impulse": 1.0, "duration": 0.2, "until": 5.0, "seed": 0},
    ),
    "World": (pw.World, {"robot": ROBOT, **FEW}),
    "Scene": (
        lambda **given: pw.Scene(**given),
        {"robot": ROBOT, "model": MODEL, "data": mujoco.MjData(MODEL), "pushes": (PUSH,)},
    ),
    "Walk": (lambda **given: run(pw.Walk(**given)), {"robot": ROBOT, "plan": PLAN, **SETTINGS}),
    "Walk.standing": (
        lambda **given: run(pw.Walk.standing(**given)),
        {"robot": ROBOT, "start": (0.0, 0.0, 0.1)},
    ),
    "Walk.run": (
        lambda **given: WALK.run(**given),
        {"until": 0.5, "progress": lambda time, end: None},
    ),
    "Walk.command": (
        lambda **given: STANDING.command(**given),
        {"vx": 0.1, "vy": 0.0, "wz": 0.0},
    ),
    "Walk.schedule": (
        lambda **given: STANDING.schedule(**given),
        {"commands": [((0.1, 0.0, 0.0), 1.0)]},
    ),
    "a scheduled command": (
        lambda **given: STANDING.schedule([(given["command"], given["duration"])]),
        {"command": (0.1, 0.0, 0.0), "duration": 1.0},
    ),
    "Walk.push": (
        lambda **given: STANDING.push(**given),
        {"force": (1.0, 0.0, 0.0), "duration": 0.1, "body": None},
    ),
    "Walk.gains": (
        lambda gains: setattr(STANDING, "gains", gains),
        {"gains": pw.TrackingGains()},
    ),
    "Walk.plan": (
        lambda plan: setattr(WALK, "plan", plan),
        {"plan": PLAN},
    ),
    "simulate": (pw.simulate, {"robot": ROBOT, "plan": PLAN, "progress": print, **WHOLE}),
    "simulate_commands": (
        pw.simulate_commands,
        {"robot": ROBOT, "commands": [((0.1, 0.0, 0.0), 1.0)], "start": (0.0, 0.0), **WHOLE},
    ),
    "WalkingController": (
        pw.WalkingController,
        {"model": MODEL, "data": mujoco.MjData(MODEL), "com_height": ROBOT.com_height},
    ),
    "WalkingController.com_height": (
        lambda com_height: setattr(LAB, "com_height", com_height),
        {"com_height": ROBOT.com_height},
    ),
    "WalkingController.planner": (
        lambda planner: _walked(planner),
        {"planner": pw.FootstepPlanner(0.1, WIDTH, 0.8)},
    ),
    "run_walking": (
        lambda **given: LAB.run_walking(**given, on_tick=stop),
        {"n_steps": 2, "dt": 0.01, "pushes": (PUSH,), "turn": 0.0, "swing_height": 0.05},
    ),
    "run_walking on_tick": (lambda **given: LAB.run_walking(2, **given), {"on_tick": stop}),
    "run_walking plan": (
        lambda plan: _walked_by(plan),
        {"plan": PLAN},
    ),
    "standing_configuration": (
        pw.standing_configuration,
        {"robot": ROBOT, "left": pw.pose_at(0, WIDTH / 2), "right": pw.pose_at(0, -WIDTH / 2)},
    ),
    "at_com_height": (pw.at_com_height, {"robot": ROBOT, "com_height": ROBOT.com_height}),
    "load_robot": (pw.load_robot, {"model": NAME}),
    "inspect_robot": (pw.inspect_robot, {"model": NAME}),
    "write_picture": (
        lambda path: pw.inspect_robot(NAME).write_picture(path),
        {"path": Path("stance.png")},
    ),
    "gait_limits": (pw.gait_limits, {"robot": ROBOT}),
    "command_limits": (pw.command_limits, {"robot": ROBOT}),
    "plot": (pw.plot, {"record": RECORD, "path": "walk.pdf"}),
    "plot_all": (pw.plot_all, {"record": RECORD, "folder": "."}),
    "save_plot": (pw.save_plot, {"record": RECORD, "name": "feet", "path": "feet.svg"}),
    "top_view": (pw.top_view, {"record": RECORD}),
    "render_video": (pw.render_video, {"record": RECORD, "robot": ROBOT, "path": "walk.mp4"}),
    "frames": (
        lambda **given: next(pw.frames(**given)),
        {"record": RECORD, "robot": ROBOT, "times": (0.0,)},
    ),
    "run_in_viewer": (pw.run_in_viewer, {"walk": None}),
    "show": (pw.show, {"record_or_walk": None}),
    "export_html": (pw.export_html, {"record": RECORD, "path": "walk.html", "robot": ROBOT}),
    "require_port": (require_port, {"port": 0, "host": "127.0.0.1"}),
    "WholeBodyController": (
        pw.WholeBodyController,
        {"robot": ROBOT, "gains": pw.TrackingGains(), "friction": 0.8, "solver": "osqp"},
    ),
    "Walker": (
        pw.Walker,
        {"robot": ROBOT, "plan": PLAN, "friction": 0.8, "gains": None, "solver": "osqp"}
        | {"swing_height": 0.05, "q": ROBOT.posture},
    ),
}
CASES = [(call, name) for call, (_, arguments) in CALLS.items() for name in arguments]


def _walked(planner: Any) -> None:
    LAB.planner = planner
    LAB.run_walking(2, on_tick=stop)


def _walked_by(plan: Any) -> None:
    fresh = pw.WalkingController(MODEL, mujoco.MjData(MODEL))
    fresh.run_walking(plan=plan, on_tick=stop)


@pytest.fixture(autouse=True)
def elsewhere(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """Let what is written by a call that is taken go to a folder of its own, and be quiet."""
    monkeypatch.chdir(tmp_path)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        yield


def refused(
    function: Callable[..., object], arguments: dict[str, Any]
) -> InvalidInput | OutputError | None:
    """Return the error that a call raises on purpose; None where it gives a result."""
    try:
        function(**arguments)
    except (InvalidInput, OutputError) as error:
        return error
    except Over:
        return None
    return None


@pytest.mark.parametrize(("call", "name"), CASES)
def test_what_cannot_be_is_told_in_one_sentence(call: str, name: str) -> None:
    function, good = CALLS[call]
    for value in ODD:
        if name == "on_tick" and (value is None or callable(value)):
            continue  # what somebody's own function raises is left to it
        error = refused(function, {**good, name: value})
        if error is not None:
            assert isinstance(error, OutputError) or error.argument, (value, error)
            assert "\n" not in str(error), (value, error)
            assert len(str(error)) < 700, (value, error)


@pytest.mark.parametrize("call", [call for call in CALLS if call not in SLOW])
def test_the_calls_of_the_table_are_right_but_for_what_is_odd(call: str) -> None:
    function, good = CALLS[call]
    function(**good)
