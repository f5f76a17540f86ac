"""A record written as the walk goes: what a killed process leaves, and rows at a chosen rate."""

from __future__ import annotations

import copy
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

import preview_walk as pw
from preview_walk.errors import InvalidInput
from preview_walk.files import OutputError
from preview_walk.record import blocks, recorder
from preview_walk.record.fields import FIELDS
from preview_walk.robots.robot import Robot

SECOND = 500
"""Rows of a second."""


@pytest.fixture(autouse=True)
def short_blocks(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let a block be of 0.2 s."""
    monkeypatch.setattr(recorder, "EVERY", 0.2)


def walked(robot: Robot, seconds: float = 1.1, **settings: object) -> pw.Walk:
    walk = pw.Walk.standing(robot, **settings)
    walk.command(0.3, 0.0, 0.2)
    walk.run(until=min(0.45, seconds))
    walk.command(0.3, 0.05, 0.2)
    return walk.run(until=seconds)


def same_rows(part: pw.Record, whole: pw.Record) -> None:
    """Check that a record is the beginning of another one, bit for bit but for timings."""
    mine, theirs = part.arrays(), whole.arrays()
    assert set(mine) == set(theirs)
    for name, array in mine.items():
        if not (name in FIELDS and FIELDS[name].timing):
            assert array.tobytes() == theirs[name][: len(part)].tobytes(), name


@pytest.mark.parametrize("realism", [None, pw.Realism.lab()])
def test_the_blocks_are_the_rows_but_for_the_last_ones(
    talos: Robot, tmp_path: Path, realism: pw.Realism | None
) -> None:
    record = walked(talos, realism=realism, blocks=tmp_path / "blocks").record()
    left = pw.Record.load(tmp_path / "blocks")
    assert len(left) == SECOND
    assert left.run.interrupted
    same_rows(left, record)
    revisions = len(left.plans)
    assert revisions >= 2
    for revision in range(revisions):
        mine, theirs = left.plans[revision], record.plans[revision]
        assert (mine.time, mine.end) == (theirs.time, theirs.end)
        assert np.array_equal(mine.pose, theirs.pose)


def test_a_killed_process_leaves_what_it_walked(talos: Robot, tmp_path: Path) -> None:
    script = (
        "import preview_walk as pw\n"
        "from preview_walk.record import recorder\n"
        "recorder.EVERY = 0.2\n"
        "walk = pw.Walk.standing(pw.load_robot('talos'), blocks='blocks')\n"
        "walk.command(0.3, 0.0, 0.2)\n"
        "walk.run(until=0.45)\n"
        "walk.command(0.3, 0.05, 0.2)\n"
        "walk.run(until=1000.0)\n"
    )
    process = subprocess.Popen([sys.executable, "-c", script], cwd=tmp_path)
    until = time.monotonic() + 120.0
    while not (tmp_path / "blocks" / "000003.npz").exists() and time.monotonic() < until:
        time.sleep(0.02)
    os.kill(process.pid, signal.SIGKILL)
    process.wait()
    left = pw.Record.load(tmp_path / "blocks")
    assert len(left) >= 0.8 * SECOND
    same_rows(left, walked(talos, len(left) / SECOND + 0.001).record())
    assert left.summary().duration == pytest.approx(len(left) / SECOND)


def test_a_disk_that_is_full_ends_the_blocks_and_not_the_walk(
    talos: Robot, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(*given: object, **how: object) -> None:
        raise OutputError("cannot write: No space left on device.")

    monkeypatch.setattr(blocks, "write_file", full)
    walk = walked(talos, 0.5, blocks=tmp_path / "blocks")
    assert not walk.fallen
    assert len(walk.record()) == 0.5 * SECOND


def test_a_copied_walk_leaves_the_folder_to_the_first(talos: Robot, tmp_path: Path) -> None:
    walk = walked(talos, 0.3, blocks=tmp_path / "blocks")
    copy.deepcopy(walk).run(until=1.1)
    assert len(pw.Record.load(tmp_path / "blocks")) == 0.2 * SECOND


def test_a_folder_is_used_anew_and_what_is_not_a_block_stays(talos: Robot, tmp_path: Path) -> None:
    folder = tmp_path / "blocks"
    walked(talos, 1.1, blocks=folder)
    (folder / "mine.txt").write_text("mine")
    walked(talos, 0.5, blocks=folder)
    assert sorted(file.name for file in folder.iterdir()) == [
        "000000.npz",
        "000001.npz",
        "mine.txt",
    ]
    blocks.remove_blocks(folder)
    assert [file.name for file in folder.iterdir()] == ["mine.txt"]
    (folder / "mine.txt").unlink()
    blocks.remove_blocks(folder)
    assert not folder.exists()


def test_a_folder_without_blocks_is_no_record(tmp_path: Path) -> None:
    with pytest.raises(InvalidInput, match=r"^the folder .* holds no record's blocks\.$"):
        pw.Record.load(tmp_path)


def test_a_rate_of_rows_keeps_every_tenth(talos: Robot, tmp_path: Path) -> None:
    whole, few = walked(talos).record(), walked(talos, record_hz=50.0).record()
    assert len(few) == 55
    assert (few.q == whole.q[::10]).all()
    assert (few.time == whole.time[::10]).all()
    assert few.dt == pytest.approx(0.02)
    assert few.run.control_hz == SECOND
    assert len(few.plans) == len(whole.plans)
    summary, all_of_it = few.summary(), whole.summary()
    assert summary.duration == pytest.approx(all_of_it.duration)
    assert summary.steps == all_of_it.steps
    few.save(tmp_path / "few.npz")
    assert pw.Record.load(tmp_path / "few.npz").dt == pytest.approx(0.02)


@pytest.mark.parametrize("rate", [0.0, -50.0, 30.0, 1000.0, float("nan"), "fast"])
def test_a_rate_that_does_not_fit_is_refused(talos: Robot, rate: object) -> None:
    with pytest.raises(InvalidInput) as told:
        pw.Walk.standing(talos, record_hz=rate)
    assert told.value.argument == "record_hz"
