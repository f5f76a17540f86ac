"""For every test of the command: signals of a terminal, a simulation that costs nothing."""

from __future__ import annotations

import signal
from collections.abc import Iterator
from pathlib import Path
from types import SimpleNamespace

import pytest
from cli_stand_in import Simulation, blank

import preview_walk as pw
from preview_walk.analysis import plots
from preview_walk.cli import run as command_run


@pytest.fixture(autouse=True)
def signals_are_not_ignored() -> Iterator[None]:
    """Undo `nohup` and `&`: the command leaves a signal alone that was ignored before it."""
    usual = {
        signal.SIGHUP: signal.SIG_DFL,
        signal.SIGTERM: signal.SIG_DFL,
        signal.SIGINT: signal.default_int_handler,
    }
    before = {
        number: signal.signal(number, handler)
        for number, handler in usual.items()
        if signal.getsignal(number) is signal.SIG_IGN
    }
    yield
    for number, handler in before.items():
        signal.signal(number, handler)


@pytest.fixture
def simulation(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> Simulation:
    made = Simulation()
    monkeypatch.setattr(pw, "simulate", made)
    monkeypatch.setattr(pw, "simulate_commands", made.by_commands)
    if not request.node.get_closest_marker("real_plots"):
        monkeypatch.setattr(plots, "plot", lambda _, path: blank(path))
    robot = SimpleNamespace(step_width=0.17, leg_length=0.87)
    monkeypatch.setattr(pw, "load_robot", lambda name: SimpleNamespace(name=name, **vars(robot)))
    usual = pw.FootstepPlanner(0.25, robot.step_width, 0.9)
    monkeypatch.setattr(command_run, "usual_planner", lambda robot: usual)
    return made


@pytest.fixture
def out(tmp_path: Path) -> Path:
    return tmp_path / "results"
