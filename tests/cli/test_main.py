"""What the command returns and says, whatever becomes of the walk."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from cli_stand_in import OUTPUTS, Simulation, complaint, run

import preview_walk as pw
from preview_walk.record.record import Record


@pytest.mark.real_plots
def test_a_walk_leaves_the_table_and_the_folder(
    simulation: Simulation, out: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(out) == 0
    assert {path.name for path in out.iterdir()} == OUTPUTS
    printed = capsys.readouterr()
    assert "did not fall" in printed.out
    assert "record.npz, summary.json, run.toml, walk.png" in printed.out
    assert "walking: 100%" in printed.err
    assert json.loads((out / "summary.json").read_text())["steps"] == 4
    command = Record.load(out / "record.npz").run.command
    assert command == f"preview-walk --steps 4 --out {out}"


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


def test_an_unknown_robot_is_told_before_anything_is_written(
    out: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(out, "--robot", "nobody") == 2
    assert complaint(capsys).startswith("preview-walk: --robot: ")
    assert not out.exists()


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


def test_the_catalogue_is_listed(out: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(out, "--list-robots") == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[0].split()[:2] == ["name", "robot"]
    assert any(line.startswith("talos ") and "90.3" in line for line in lines)
    assert not out.exists()


def test_a_ground_is_read_and_walked_on(simulation: Simulation, out: Path) -> None:
    assert run(out, "--ground", "slope:degrees=5") == 0
    ground = simulation.calls[0]["ground"]
    assert ground.slabs == pw.slope(5.0).slabs
    assert "blind" not in simulation.calls[0]
    assert run(out, "--ground", "slope:depth=5") == 2


def test_a_robot_can_be_blind(simulation: Simulation, out: Path) -> None:
    assert run(out, "--ground", "blocks", "--blind") == 0
    assert simulation.calls[0]["blind"] is True
