"""The command: what it passes on, what it says when it can't, and what it leaves behind.

Stand-ins take the place of robot and simulation, and of the plots but for one test.
"""

from __future__ import annotations

import errno
import json
import sys
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from synthetic_walk import walk_record

import preview_walk as pw
from preview_walk import files
from preview_walk.analysis import plots
from preview_walk.analysis.plots import PLOTS
from preview_walk.cli import main as cli
from preview_walk.errors import InvalidInput, PreviewWalkError
from preview_walk.record.record import Record
from preview_walk.robots import inspection

OUTPUTS = {"record.npz", "summary.json", "walk.png", *(f"{name}.png" for name in PLOTS)}


class Simulation:
    """A stand-in for `simulate`: keeps what it was given, returns a closed-form record."""

    def __init__(self) -> None:
        self.settings: dict[str, Any] = {}
        self.calls: list[dict[str, Any]] = []
        self.error: BaseException | None = None

    def __call__(self, robot: Any, plan: Any, *, progress: Any, **options: Any) -> Record:
        self.calls.append({"robot": robot, "plan": plan, **options})
        if self.error:
            raise self.error
        progress(0.5 * plan.end, plan.end)
        progress(plan.end, plan.end)
        return walk_record(len(plan.steps), plan=plan, **self.settings)

    def by_commands(self, robot: Any, commands: Any, *, progress: Any, **options: Any) -> Record:
        self.calls.append({"robot": robot, "commands": commands, **options})
        return walk_record(4, **self.settings)


@pytest.fixture
def simulation(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> Simulation:
    made = Simulation()
    monkeypatch.setattr(pw, "simulate", made)
    monkeypatch.setattr(pw, "simulate_commands", made.by_commands)
    if not request.node.get_closest_marker("real_plots"):
        monkeypatch.setattr(plots, "plot", lambda _, path: _blank(path))
        monkeypatch.setattr(plots, "save_plot", lambda _, name, path: _blank(path))
    monkeypatch.setattr(pw, "load_robot", lambda name: SimpleNamespace(name=name, step_width=0.17))
    return made


def _blank(path: Path) -> Path:
    path.write_bytes(b"a picture")
    return path


@pytest.fixture
def out(tmp_path: Path) -> Path:
    return tmp_path / "results"


def run(out: Path, *arguments: str) -> int:
    return cli.main(["--steps", "4", "--out", str(out), *arguments])


def complaint(capsys: pytest.CaptureFixture[str]) -> str:
    """Return the one sentence on stderr; a bar of the walk before it doesn't count."""
    lines = [line for line in capsys.readouterr().err.splitlines() if "walking:" not in line]
    lines = [line for line in lines if line]
    assert len(lines) == 1, lines
    return lines[0]


@pytest.mark.real_plots
def test_a_walk_leaves_the_table_and_the_folder(
    simulation: Simulation, out: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(out) == 0
    assert {path.name for path in out.iterdir()} == OUTPUTS
    printed = capsys.readouterr()
    assert "did not fall" in printed.out
    assert "record.npz, summary.json, walk.png, top_view.png" in printed.out
    assert "walking: 100%" in printed.err
    assert json.loads((out / "summary.json").read_text())["steps"] == 4
    command = Record.load(out / "record.npz").run.command
    assert command == f"preview-walk --steps 4 --out {out}"


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
    assert set(simulation.calls[0]) == {"robot", "plan", "pushes", "seed", "viewer"}


def test_rates_and_solver_reach_the_simulation(simulation: Simulation, out: Path) -> None:
    assert run(out, *["--physics-hz", "2000", "--control-hz", "500", "--solver", "daqp"]) == 0
    (call,) = simulation.calls
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


def test_a_fall_exits_with_1_and_leaves_everything(
    simulation: Simulation, out: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    simulation.settings = {"fell": True, "fall_time": 3.25, "fall_reason": "the torso tilted"}
    assert run(out) == 1
    assert {path.name for path in out.iterdir()} == OUTPUTS
    assert "FELL at 3.25 s: the torso tilted" in capsys.readouterr().out
    summary = json.loads((out / "summary.json").read_text())
    assert (summary["fell"], summary["fall_time"]) == (True, 3.25)


def test_ctrl_c_in_the_walk_leaves_the_walk_so_far(
    simulation: Simulation, out: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    simulation.settings = {"interrupted": True}
    assert run(out, "--video") == 130
    assert {path.name for path in out.iterdir()} == OUTPUTS
    assert capsys.readouterr().out.startswith("Stopped by Ctrl-C after ")


def test_ctrl_c_elsewhere_is_one_line(
    simulation: Simulation, out: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    simulation.error = KeyboardInterrupt()
    assert run(out) == 130
    assert complaint(capsys) == "preview-walk: stopped by Ctrl-C."


@pytest.mark.parametrize(
    ("error", "sentence"),
    [
        (PreviewWalkError("it cannot walk."), "--robot: it cannot walk."),
        (InvalidInput("it is slippery.", "friction"), "--friction: it is slippery."),
        (InvalidInput("a push names the body 'x'", "pushes"), "--push: a push names the body 'x'."),
        (InvalidInput("must be osqp", "solver"), "--solver: must be osqp."),
        (InvalidInput("must be 1", "physics_hz"), "--physics-hz: must be 1."),
        (
            InvalidInput("too far ahead in the air", "step_length"),
            "--step-length: too far ahead in the air.",
        ),
        (InvalidInput("too short a friction", "step_time"), "--step-time: too short a friction."),
        (
            InvalidInput("step 3 turns 0.5 rad (28.6 degrees) out", "turn"),
            "--turn: step 3 turns 28.6 degrees out.",
        ),
        (InvalidInput("friction in words alone"), "--robot: friction in words alone."),
        (InvalidInput("of nobody", "an argument of nobody"), "--robot: of nobody."),
    ],
)
def test_errors_of_the_library_name_the_option(
    error: Exception,
    sentence: str,
    simulation: Simulation,
    out: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    simulation.error = error
    assert run(out) == 2
    assert complaint(capsys) == f"preview-walk: {sentence}"


def test_an_unknown_robot_is_told_before_anything_is_written(
    out: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(out, "--robot", "nobody") == 2
    assert complaint(capsys).startswith("preview-walk: --robot: ")
    assert not out.exists()


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


def test_an_unexpected_error_is_neither_a_fall_nor_bad_input(
    simulation: Simulation, out: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    simulation.error = RuntimeError("surprise")
    assert run(out) == 3
    assert "RuntimeError: surprise" in capsys.readouterr().err


def test_a_missing_library_of_the_system_is_told(
    simulation: Simulation, out: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    simulation.error = ImportError("libgomp.so.1: cannot open shared object file: No such file")
    assert run(out) == 3
    assert complaint(capsys) == (
        "preview-walk: libgomp.so.1 is missing; on Debian or Ubuntu sudo apt install libgomp1 "
        "helps."
    )


def test_a_folder_that_cannot_be_made_is_told_before_the_walk(
    simulation: Simulation, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    taken = tmp_path / "taken"
    taken.write_text("a file")
    assert run(taken) == 2
    assert complaint(capsys) == (
        f"preview-walk: --out: cannot make the folder {taken}: File exists; "
        "choose a folder that can be written, with space left."
    )
    assert simulation.calls == []
    assert taken.read_text() == "a file"


def test_a_full_disk_leaves_whole_files_or_none_and_one_sentence(
    simulation: Simulation,
    out: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    assert run(out) == 0
    capsys.readouterr()
    calls = []

    def full(descriptor: int) -> None:
        calls.append(descriptor)
        if len(calls) == 1:  # no room for the record, but for the summary
            raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(files.os, "fsync", full)
    assert run(out) == 2
    assert complaint(capsys) == (
        f"preview-walk: --out: cannot write {out / 'record.npz'}: No space left on device; "
        "choose a folder that can be written, with space left."
    )
    assert {path.name for path in out.iterdir()} == OUTPUTS - {"record.npz"}
    assert json.loads((out / "summary.json").read_text())["steps"] == 4


def test_nothing_of_an_earlier_run_stays(simulation: Simulation, out: Path) -> None:
    out.mkdir()
    for name in ("walk.mp4", "feet.png", "notes.txt"):
        (out / name).write_text("old")
    simulation.settings = {"interrupted": True}
    assert run(out) == 130
    assert not (out / "walk.mp4").exists()
    assert (out / "feet.png").read_bytes() == b"a picture"
    assert (out / "notes.txt").read_text() == "old"


def test_the_catalogue_is_listed(out: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(out, "--list-robots") == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[0].split()[:2] == ["name", "robot"]
    assert any(line.startswith("talos ") and "90.3" in line for line in lines)
    assert not out.exists()


def test_a_model_is_inspected_and_drawn(
    out: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(
        inspection.Inspection, "write_picture", lambda _, path: path.write_bytes(b"a picture")
    )
    assert run(out, "--inspect", "humanoid-walker") == 0
    printed = capsys.readouterr().out
    assert "left leg: left_hip_yaw" in printed
    assert printed.endswith(f"stance and soles: {out / 'stance.png'}\n")
    assert [path.name for path in out.iterdir()] == ["stance.png"]


def test_a_model_that_cannot_stand_is_bad_input(
    out: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(out, "--inspect", "none.xml") == 2
    assert complaint(capsys) == "preview-walk: --inspect: the file 'none.xml' does not exist."
    assert not out.exists()


def test_video_is_written_whole_or_not_at_all(
    simulation: Simulation,
    out: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    from preview_walk.viewer import video

    def render(record: Record, robot: Any, path: Path) -> None:
        path.write_bytes(b"half a film")
        if broken:
            raise PreviewWalkError("no OpenGL to render with")

    monkeypatch.setattr(video, "render_video", render)
    broken = False
    assert run(out, "--video") == 0
    assert (out / "walk.mp4").read_bytes() == b"half a film"
    broken = True
    assert run(out, "--video") == 2
    printed = capsys.readouterr()
    assert printed.err.splitlines()[-1] == "preview-walk: --video: no OpenGL to render with."
    assert "Written to" in printed.out
    assert {path.name for path in out.iterdir()} == OUTPUTS
