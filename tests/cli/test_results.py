"""The folder of results: whole files, none of an earlier run, the most precious first."""

from __future__ import annotations

import dataclasses
import errno
import json
from pathlib import Path
from typing import Any

import pytest
from cli_stand_in import OUTPUTS, Simulation, complaint, run
from synthetic_walk import walk_record

import preview_walk as pw
from preview_walk import files
from preview_walk.errors import PreviewWalkError
from preview_walk.record.record import Record


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
    assert not (out / "feet.png").exists()
    assert (out / "notes.txt").read_text() == "old"


def test_video_is_written_whole_or_not_at_all(
    simulation: Simulation,
    out: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    from preview_walk.viewer import video

    def render(record: Record, robot: Any, path: Path, *, progress: Any) -> None:
        progress(0.5, 1.0)
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


def test_a_name_taken_by_a_folder_is_told_before_the_walk(
    simulation: Simulation, out: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    for name in sorted(OUTPUTS | {"walk.mp4", "feet.png"}):
        (out / name).mkdir(parents=True)
        assert run(out) == 2
        assert complaint(capsys) == (
            f"preview-walk: --out: cannot write {out / name}: Is a directory; "
            "choose a folder that can be written, with space left."
        )
        (out / name).rmdir()
    assert simulation.calls == []


def test_no_plots_leaves_record_and_figures_alone(simulation: Simulation, out: Path) -> None:
    assert run(out) == 0
    assert run(out, "--no-plots") == 0
    assert {path.name for path in out.iterdir()} == {"record.npz", "summary.json", "run.toml"}


def test_an_empty_record_has_no_pictures(
    simulation: Simulation, out: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    record = walk_record(4)
    none = {name: array[:0] for name, array in record.arrays().items()}
    empty = dataclasses.replace(record, **none)
    monkeypatch.setattr(pw, "simulate", lambda *_, **__: empty)
    assert run(out) == 0
    assert {path.name for path in out.iterdir()} == {"record.npz", "summary.json", "run.toml"}
