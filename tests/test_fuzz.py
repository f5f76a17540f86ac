"""A small run of the fuzz script; `benchmarks/fuzz.py` says how to make a large one."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

HERE = Path(__file__).parents[1]


def fuzz(*arguments: str) -> subprocess.CompletedProcess[str]:
    environment = {**os.environ, "PYTHONPATH": str(HERE)}
    command = [sys.executable, str(HERE / "benchmarks" / "fuzz.py"), *arguments]
    return subprocess.run(
        command, env=environment, capture_output=True, text=True, timeout=600, check=False
    )


@pytest.mark.parametrize("kind", ["command", "api", "records", "models"])
def test_forty_odd_cases_are_accepted_or_refused_in_one_sentence(kind: str) -> None:
    run = fuzz("--cases", "40", "--seed", "1", "--what", kind)
    assert run.returncode == 0, run.stdout + run.stderr
    name, cases, accepted, refused, failed = run.stdout.splitlines()[1].split()
    assert (name, cases, failed) == (kind, "40", "0")
    assert int(accepted) + int(refused) == 40


def test_a_case_that_fails_is_found_again(tmp_path: Path) -> None:
    """Planted: an expression that nobody's table can hold makes the script itself fail."""
    good = fuzz("--what", "api", "--again", '["test_arguments/Stride", "width=nan"]')
    assert good.returncode == 0
    assert good.stdout.startswith("refused: width must be ")
    bad = fuzz("--what", "api", "--again", '["test_arguments/Stride", "width=1/0"]')
    assert bad.returncode == 1
    assert bad.stdout.startswith("failed: the process died with code 1")
