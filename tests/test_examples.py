"""Every example runs without a screen, as the README says."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

ELSEWHERE = ("video", "preview_horizon", "walking_laws", "active_suspension", "servo", "crane")
"""A film renders for minutes without a graphics card; `test_video.py` tests what it does. The
others' output is compared with their pages by `test_documents.py`."""

SHORTER = {
    "com_generators": ("--steps", "6"),
    "pushes_study": ("2",),
    "ground": ("--ground", "stairs:rise=0.15,tread=0.28,count=2", "--steps", "6"),
}
"""Arguments of examples that do the same several times over."""

EXAMPLES = sorted(
    path
    for path in (Path(__file__).parents[1] / "examples").glob("*.py")
    if path.stem not in ELSEWHERE
)


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda path: path.stem)
def test_an_example_runs(example: Path, tmp_path: Path) -> None:
    """In an empty folder; it says something on the way."""
    environment = {k: v for k, v in os.environ.items() if k != "DISPLAY"}
    run = subprocess.run(
        [sys.executable, str(example), *SHORTER.get(example.stem, ())],
        cwd=tmp_path,
        env=environment,
        capture_output=True,
        text=True,
        timeout=300,
        check=False,
    )
    assert run.returncode == 0, run.stderr
    assert run.stdout.strip()
