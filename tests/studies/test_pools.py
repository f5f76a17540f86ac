"""A real Dask cluster, a scheduler and two workers in processes of their own, does the cases."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import pytest
from study_cases import drawn, trouble
from study_rows import same_rows

import preview_walk as pw

HERE = Path(__file__).parents[1]


def start(folder: Path, name: str, *words: str) -> subprocess.Popen[str]:
    """Start a part of the cluster; what it says goes into a file."""
    path = os.pathsep.join([str(HERE), *sys.path])
    with (folder / f"{name}.log").open("w") as log:
        return subprocess.Popen(
            [sys.executable, "-m", *words, "--no-dashboard"],
            env={**os.environ, "PYTHONPATH": path},
            cwd=folder,
            stderr=log,
            start_new_session=True,
            text=True,
        )


@pytest.fixture(scope="module")
def scheduler(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    """Give the address of a scheduler that has two workers."""
    folder = tmp_path_factory.mktemp("cluster")
    at = folder / "scheduler.json"
    first = ("--port=0", "--host=127.0.0.1", f"--scheduler-file={at}")
    parts = [start(folder, "scheduler", "distributed.cli.dask_scheduler", *first)]
    until = time.monotonic() + 60.0
    while not at.exists() and time.monotonic() < until:
        time.sleep(0.05)
    address = str(json.loads(at.read_text())["address"])
    for name in ("one", "two"):
        words = (address, "--nthreads=1", f"--name={name}", f"--local-directory={folder}")
        parts.append(start(folder, name, "distributed.cli.dask_worker", *words))
    yield address
    for process in parts:
        os.killpg(process.pid, signal.SIGKILL)
        process.wait(30.0)


def test_a_cluster_comes_to_what_this_machine_comes_to(scheduler: str, tmp_path: Path) -> None:
    study = pw.Study({"x": [-1.0, 0.0, 2.0]}, drawn, repeats=10)
    far = study.run(tmp_path / "far", scheduler=scheduler, progress=False)
    near = study.run(tmp_path / "near", jobs=2, progress=False)
    same_rows(far, near)


def test_errors_time_limits_and_killed_workers_are_rows_there_too(
    scheduler: str, tmp_path: Path
) -> None:
    study = pw.Study({"kind": ["raise", "loop", "kill", "last"]}, trouble, time_limit=1.0)
    table = study.run(tmp_path, scheduler=scheduler, progress=False).table
    assert [*table["outcome"]] == ["error", "timeout", "killed", "done"]


def test_a_scheduler_that_does_not_answer_is_one_sentence(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("preview_walk.studies.pools._CONNECT", 0.5)
    study = pw.Study({"x": [1.0]}, drawn)
    for address in ("tcp://127.0.0.1:9", "nonsense://"):
        with pytest.raises(pw.InvalidInput, match="address of a Dask scheduler that answers"):
            study.run(tmp_path, scheduler=address, progress=False)
