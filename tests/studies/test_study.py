"""A study over real worker processes: the same rows however it is run, stopped and gone on with."""

from __future__ import annotations

import json
import os
import resource
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import pandas as pd
import pytest
from study_cases import drawn, killed_once, pushed, slow, stands, trouble
from study_rows import same_rows

import preview_walk as pw


def run(study: pw.Study, folder: Path, **settings: Any) -> pw.Results:
    return study.run(folder, **{"jobs": 2, "progress": False, **settings})


def test_one_worker_and_two_come_to_the_same(tmp_path: Path) -> None:
    study = pw.Study({"x": [-1.0, 0.0, 2.0]}, drawn, repeats=10)
    one, two = run(study, tmp_path / "1", jobs=1), run(study, tmp_path / "2")
    same_rows(one, two)
    assert [*one.table["value"]] == [drawn(**c.values, seed=c.seed)["value"] for c in study.cases()]
    assert [*one.table["seed"]] == [case.seed for case in study.cases()]
    assert len(pd.read_parquet(tmp_path / "1" / "results.parquet")) == 30
    same_rows(pw.read_results(tmp_path / "1"), two)


def children_of(pid: int) -> list[str]:
    return Path(f"/proc/{pid}/task/{pid}/children").read_text().split()


@pytest.mark.parametrize("stop", [signal.SIGKILL, signal.SIGINT])
def test_a_study_that_is_stopped_goes_on_and_nothing_is_done_twice(
    tmp_path: Path, stop: signal.Signals
) -> None:
    study = pw.Study({"x": [0.0, 1.0, 2.0], "folder": str(tmp_path)}, slow, repeats=12)
    code = (
        "import signal, preview_walk as pw, study_cases\n"
        # Whoever started the tests in the background may have told all to ignore Ctrl-C.
        "signal.signal(signal.SIGINT, signal.default_int_handler)\n"
        f"pw.Study({study.factors!r}, study_cases.slow, repeats=12)"
        f".run({str(tmp_path / 'out')!r}, jobs=2, progress=False)"
    )
    path = os.pathsep.join([str(Path(__file__).parents[1]), *sys.path])
    process = subprocess.Popen(
        [sys.executable, "-c", code], env={**os.environ, "PYTHONPATH": path}, cwd=tmp_path
    )
    rows = tmp_path / "out" / "rows.jsonl"
    until = time.monotonic() + 60.0
    while time.monotonic() < until and not (rows.exists() and rows.read_bytes().count(b"\n") >= 5):
        time.sleep(0.02)
    workers = [int(pid) for pid in children_of(process.pid)]
    process.send_signal(stop)
    process.wait(30.0)
    assert len(workers) >= 2
    while any(Path(f"/proc/{pid}").exists() for pid in workers):  # none outlives the study
        assert time.monotonic() < until + 30.0
        time.sleep(0.05)
    done = rows.read_bytes().count(b"\n")
    assert 5 <= done <= 10
    (tmp_path / "go").touch()
    resumed = run(study, tmp_path / "out", resume=True)
    calls = (tmp_path / "calls").read_text().splitlines()
    # What was under way when it stopped is done again: two workers' cases, no row's.
    assert 36 <= len(calls) <= 36 + 4
    same_rows(resumed, run(study, tmp_path / "undisturbed"))
    assert resumed.missing == 0


def test_half_a_line_of_a_power_cut_is_done_again(tmp_path: Path) -> None:
    study = pw.Study({"x": [0.0, 1.0, 2.0]}, drawn)
    whole = run(study, tmp_path / "out")
    rows = tmp_path / "out" / "rows.jsonl"
    rows.write_bytes(rows.read_bytes()[:-20])
    assert len(pw.read_results(tmp_path / "out")) == 2
    same_rows(run(study, tmp_path / "out", resume=True), whole)
    assert all(json.loads(line) for line in rows.read_text().splitlines())


def test_every_case_ends_in_a_row_whatever_becomes_of_it(tmp_path: Path) -> None:
    kinds = ["fine", "raise", "exit", "loop", "kill", "text", "last"]
    results = run(pw.Study({"kind": kinds}, trouble, time_limit=1.0), tmp_path)
    outcome = dict(zip(results.table["kind"], results.table["outcome"], strict=True))
    assert outcome == {
        "fine": "done",
        "raise": "error",
        "exit": "error",
        "loop": "timeout",
        "kill": "killed",
        "text": "error",
        "last": "done",
    }
    reason = dict(zip(results.table["kind"], results.table["reason"], strict=True))
    assert reason["raise"].startswith("ValueError: no such luck (line ")
    assert reason["loop"] == "over the time limit of 1 s"
    assert "must return figures by name" in reason["text"]
    assert list(results.table["success"]) == [name in ("fine", "last") for name in kinds]
    assert "2 of" not in str(results)
    assert "3 error" in str(results)


def test_a_worker_killed_from_outside_costs_no_case(tmp_path: Path) -> None:
    study = pw.Study({"x": list(range(10)), "folder": str(tmp_path)}, killed_once)
    results = run(study, tmp_path / "out")
    assert [*results.table["outcome"]] == ["done"] * 10
    assert [*results.table["square"]] == [x * x for x in range(10)]


def test_a_full_disk_is_one_sentence_and_the_study_goes_on_after_it(tmp_path: Path) -> None:
    (tmp_path / "go").touch()
    study = pw.Study({"x": list(range(20)), "folder": str(tmp_path)}, slow)
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    handler = signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (3000, before[1]))
    try:
        with pytest.raises(pw.OutputError, match=r"cannot write .*rows.jsonl"):
            run(study, tmp_path / "out")
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)
        signal.signal(signal.SIGXFSZ, handler)
    same_rows(run(study, tmp_path / "out", resume=True), run(study, tmp_path / "undisturbed"))


def test_margins_are_found_for_each_cell(tmp_path: Path) -> None:
    margin = pw.Margin("push", 0.0, 100.0, 0.5)
    results = run(pw.Study({"gain": [1.0, 2.0, 3.0]}, pushed, margin=margin), tmp_path)
    for gain, found in zip((1.0, 2.0, 3.0), results.table.itertuples(), strict=True):
        assert 0.0 < 10.0 * gain - found.margin <= 0.5
        assert all(stands(gain, push) == stood for push, stood in json.loads(found.tried))
    assert [*results.margins("gain")["median"]] == [*results.table["margin"]]


def test_rows_of_another_study_are_refused_and_a_larger_grid_goes_on(tmp_path: Path) -> None:
    study = pw.Study({"x": [0.0, 1.0]}, drawn)
    run(study, tmp_path)
    with pytest.raises(pw.InvalidInput, match="holds 2 cases of a study: resume it"):
        run(study, tmp_path)
    with pytest.raises(pw.InvalidInput, match="another study, whose seed differ"):
        run(pw.Study({"x": [0.0, 1.0]}, drawn, seed=1), tmp_path, resume=True)
    with pytest.raises(pw.InvalidInput, match="whose function and source differ"):
        run(pw.Study({"x": [0.0]}, lambda x: x), tmp_path, resume=True)
    larger = run(pw.Study({"x": [0.0, 1.0, 2.0]}, drawn), tmp_path, resume=True, limit=1)
    assert len(larger) == 3
    smaller = run(pw.Study({"x": [1.0]}, drawn), tmp_path, resume=True)
    assert len(smaller) == 1


def test_other_versions_are_told(tmp_path: Path) -> None:
    study = pw.Study({"x": [0.0, 1.0]}, drawn)
    run(study, tmp_path)
    rows = tmp_path / "rows.jsonl"
    rows.write_text(rows.read_text().replace("mujoco ", "mujoco 0."))
    with pytest.warns(pw.VersionsWarning, match=r"2 cases in .* were done with .*mujoco 0\."):
        run(study, tmp_path, resume=True)


def test_two_processes_do_not_share_a_folder(tmp_path: Path) -> None:
    from preview_walk.files import claimed

    with claimed(tmp_path), pytest.raises(pw.OutputError, match="another run"):
        run(pw.Study({"x": [0.0]}, drawn), tmp_path)


@pytest.mark.parametrize(
    ("given", "sentence"),
    [
        ({"factors": {"y": [1]}}, "which takes seed, x; got y"),
        ({"factors": {}}, "must give drawn its x too"),
        ({"factors": {"x": []}}, "'x' must have a value"),
        ({"factors": 3}, "levels by name, or a list of rows"),
        ({"factors": [{"x": 1}, {"z": 1}]}, "row 2 of factors must have the names x, got z"),
        ({"factors": {"x": [1]}, "repeats": 0}, "repeats must be at least 1"),
        ({"factors": {"x": [1]}, "keep": "some"}, "keep must be one of none, failed, all"),
        ({"factors": {"x": [1]}, "time_limit": -1.0}, "time_limit must be > 0 s"),
        ({"factors": {"x": range(10**6)}, "repeats": 1000}, "at most 10000000 cases"),
        ({"factors": {"x": [1]}, "metrics": len}, "metrics must be functions by name"),
    ],
)
def test_a_study_that_cannot_be_is_refused(given: dict[str, Any], sentence: str) -> None:
    with pytest.raises(pw.InvalidInput, match=sentence):
        pw.Study(**{"function": drawn, **given})


def test_what_does_not_pickle_is_refused_before_a_worker_starts(tmp_path: Path) -> None:
    with (tmp_path / "open").open("w") as file, pytest.raises(pw.InvalidInput, match="must pickle"):
        run(pw.Study({"x": [1]}, lambda x: file.closed), tmp_path / "out")


def test_a_function_that_the_workers_cannot_read_is_told_at_once(tmp_path: Path) -> None:
    """A cache is sent by its name, in a module that no worker has: every case would be "killed"."""
    script = tmp_path / "cached.py"
    script.write_text(
        "from functools import lru_cache\n"
        "import preview_walk as pw\n"
        "@lru_cache\n"
        "def helper(x): return x\n"
        "def f(x): return {'y': helper(x)}\n"
        "if __name__ == '__main__':\n"
        "    pw.Study({'x': [1.0, 2.0]}, f).run('out', jobs=1, progress=False)\n"
    )
    done = subprocess.run(
        [sys.executable, str(script)], cwd=tmp_path, capture_output=True, text=True, check=False
    )
    assert done.stderr.strip().splitlines()[-1] == (
        "preview_walk.errors.InvalidInput: the workers cannot read the study's function: "
        "AttributeError: Can't get attribute 'helper'; what it calls must be importable, or "
        "defined beside it without a cache or another wrapper."
    )
    assert not [*pw.read_results(tmp_path / "out").table.index]
