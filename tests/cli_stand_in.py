"""Stand-ins for robot and simulation, for tests of the command, and how to run and read it."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from synthetic_walk import walk_record

from preview_walk.cli import main as cli
from preview_walk.record.record import Record

OUTPUTS = {"record.npz", "summary.json", "run.toml", "walk.png"}


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


def blank(path: Path) -> Path:
    path.write_bytes(b"a picture")
    return path


def run(out: Path, *arguments: str) -> int:
    return cli.main(["--steps", "4", "--out", str(out), *arguments])


def complaint(capsys: pytest.CaptureFixture[str]) -> str:
    """Return the one sentence on stderr; a bar of the walk before it doesn't count."""
    lines = [line for line in capsys.readouterr().err.splitlines() if "walking:" not in line]
    lines = [line for line in lines if line]
    assert len(lines) == 1, lines
    return lines[0]
