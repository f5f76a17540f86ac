"""Temporary files of killed processes are cleared away, those of living ones are not."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

from preview_walk.files import remove_stale_parts


def test_parts_of_processes_that_are_gone_are_removed(tmp_path: Path) -> None:
    gone = subprocess.Popen([sys.executable, "-c", ""])
    gone.wait()
    keep = {f".part-{os.getpid()}-a.npz", ".part-1-b.png", ".part-x-c.png", "part-1", ".part-"}
    lose = {f".part-{gone.pid}-record.npz", f".part-{10**30}-x", f".part-{gone.pid}-a-b.png"}
    for name in keep | lose:
        (tmp_path / name).write_bytes(b"")
    remove_stale_parts(tmp_path)
    assert {path.name for path in tmp_path.iterdir()} == keep


def test_a_part_that_cannot_be_removed_stays(tmp_path: Path) -> None:
    gone = subprocess.Popen([sys.executable, "-c", ""])
    gone.wait()
    folder = tmp_path / f".part-{gone.pid}-folder"
    folder.mkdir()
    remove_stale_parts(tmp_path)
    assert folder.is_dir()
