"""What the options ask for reaches the plan and the simulation."""

from __future__ import annotations

import socket
import sys
from functools import partial
from pathlib import Path

import numpy as np
import pytest
from cli_stand_in import OUTPUTS, Simulation, complaint, run

import preview_walk as pw
from preview_walk.cli import main as cli


def test_options_reach_plan_and_simulation(simulation: Simulation, out: Path) -> None:
    arguments = "--robot x.xml --step-length 0.3 --step-time 0.8 --double-support-ratio 0.25"
    start = "--start 1,-2,90 --friction 0.5 --push 1,0.2,1,2,3 --seed 5"
    assert run(out, *arguments.split(), *start.split()) == 0
    (call,) = simulation.calls
    plan = call["plan"]
    assert call["robot"].name == "x.xml"
    assert (call["friction"], call["seed"], call["viewer"]) == (0.5, 5, False)
    assert call["pushes"] == (pw.Push(1.0, 0.2, (1.0, 2.0, 3.0)),)
    np.testing.assert_allclose(plan[0].pos + plan[1].pos, [2.0, -4.0, 0.0], atol=1e-12)
    assert plan[0].yaw == pytest.approx(np.pi / 2)
    assert plan.steps[1].land - plan.steps[0].land == pytest.approx(0.8)
    assert plan.steps[0].land - plan.steps[0].lift == pytest.approx(0.6)


def test_what_is_not_asked_for_the_simulation_decides(simulation: Simulation, out: Path) -> None:
    assert run(out) == 0
    given = simulation.calls[0]
    assert set(given) == {"robot", "plan", "pushes", "seed", "viewer", "blocks"}
    assert given["blocks"] == out / "record.blocks"


def test_rates_solver_and_generator_reach_the_simulation(simulation: Simulation, out: Path) -> None:
    line = "--physics-hz 2000 --control-hz 500 --solver daqp --com-generator mpc"
    assert run(out, *line.split()) == 0
    (call,) = simulation.calls
    assert call["com_generator"] == "mpc"
    assert (call["physics_hz"], call["control_hz"], call["solver"]) == (2000, 500, "daqp")


def test_turn_is_per_step(simulation: Simulation, out: Path) -> None:
    assert run(out, "--turn", "-9") == 0
    plan = simulation.calls[0]["plan"]
    assert plan.steps[-1].yaw == pytest.approx(np.radians(-9 * (1 / 3 + 2 / 3 + 1 / 3)))


def test_a_walk_by_velocity(simulation: Simulation, out: Path) -> None:
    line = "--velocity 0.3,0,0 --duration 4 --velocity 0,.1,-18 --duration 2 --start 1,2,180"
    assert cli.main([*line.split(), "--out", str(out)]) == 0
    (call,) = simulation.calls
    assert call["commands"] == (((0.3, 0.0, 0.0), 4.0), ((0.0, 0.1, np.radians(-18)), 2.0))
    assert call["start"] == (1.0, 2.0, np.pi)
    assert {path.name for path in out.iterdir()} == OUTPUTS


def test_random_pushes_begin_within_the_walk(simulation: Simulation, out: Path) -> None:
    line = "--velocity 0.3,0,0 --duration 10 --pushes every=3,impulse=20 --seed 4"
    assert cli.main([*line.split(), "--push", "1,0.1,5,0,0", "--out", str(out)]) == 0
    first, *series = simulation.calls[0]["pushes"]
    assert first == pw.Push(1.0, 0.1, (5.0, 0.0, 0.0))
    assert tuple(series) == pw.random_pushes(3.0, 20.0, 0.2, 10.0, 4)
    assert len(series) == 3


def test_random_pushes_that_come_too_late_are_told(
    simulation: Simulation, out: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    line = "--velocity 0.3,0,0 --duration 2 --pushes every=3,impulse=20"
    assert cli.main([*line.split(), "--out", str(out)]) == 2
    assert complaint(capsys) == (
        "preview-walk: --pushes: must begin before the walk ends at 2.00 s, got every=3."
    )


def test_the_walk_speeds_up_and_slows_down(simulation: Simulation, out: Path) -> None:
    assert cli.main(["--steps", "20", "--step-length", "0.5", "--out", str(out)]) == 0
    x = np.array([step.pos[0] for step in simulation.calls[0]["plan"].steps])
    advance = np.diff(np.concatenate([[0.0], x]))
    assert advance.max() == pytest.approx(0.5)
    assert 0 < advance[0] <= 0.1
    assert np.abs(np.diff(advance)).max() <= 0.1 + 1e-9


def test_a_push_after_the_walk_is_told(
    simulation: Simulation, out: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(out, "--push", "99,0.1,1,1,1") == 2
    text = complaint(capsys)
    assert text.startswith("preview-walk: --push: must begin before the walk ends at ")
    assert text.endswith(" s, got 99 s.")


def test_view_without_a_screen_is_told(
    out: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delenv("DISPLAY", raising=False)
    monkeypatch.delenv("WAYLAND_DISPLAY", raising=False)
    monkeypatch.setattr(sys, "platform", "linux")
    assert run(out, "--view") == 2
    assert complaint(capsys) == (
        "preview-walk: --view: needs a screen, and there is none; allowed without one is --video."
    )


def test_a_page_is_handed_to_the_simulation_and_written_with_the_plots(
    simulation: Simulation, out: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    written = []

    def write(record: pw.Record, path: Path, robot: object) -> None:
        written.append(robot)
        path.write_text("a page")

    monkeypatch.setattr("preview_walk.viewer.web.export.export_html", write)
    assert run(out, "--web", "--port", "0") == 0
    (call,) = simulation.calls
    viewer = call["viewer"]
    assert isinstance(viewer, partial)
    assert (viewer.func, viewer.keywords) == (pw.show, {"port": 0})
    assert {path.name for path in out.iterdir()} == OUTPUTS | {"walk.html"}
    assert written == [call["robot"]]


def test_a_page_that_cannot_be_is_told_before_the_walk(
    simulation: Simulation, out: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        port = taken.getsockname()[1]
        assert run(out, "--web", "--port", str(port)) == 2
    assert complaint(capsys).startswith(f"preview-walk: --port: port must be free, got {port} at ")
    assert run(out, "--web", "--view") == 2
    assert complaint(capsys).startswith("preview-walk: --")
    assert simulation.calls == []
