"""The walk of a study is the walk of the library with the same settings."""

from __future__ import annotations

from pathlib import Path

import numpy as np

import preview_walk as pw


def test_a_pushed_walk_is_that_of_the_same_settings_in_full(talos: pw.Robot) -> None:
    record = pw.walk_case(
        "talos", (0.2, 0.0, 0.1), 1.2, impulse=20.0, direction=90.0, push_at=0.5, friction=0.7
    )
    whole = pw.simulate_commands(
        talos,
        [((0.2, 0.0, 0.1), 1.2)],
        pushes=[pw.Push(0.5, 0.2, (20.0 / 0.2 * np.cos(np.radians(90.0)), 100.0, 0.0))],
        friction=0.7,
    )
    assert record.differences(whole) == ()


def test_the_record_of_a_case_that_failed_is_kept(tmp_path: Path) -> None:
    study = pw.Study(
        {"robot": "talos", "impulse": [0.0, 400.0], "duration": 1.0, "push_at": 0.5}, keep="failed"
    )
    results = study.run(tmp_path, jobs=1, progress=False)
    assert [*results.table["success"]] == [True, False]
    (path,) = (tmp_path / "records").iterdir()
    assert path.stem == results.table["key"][1]
    assert pw.Record.load(path).run.fall_time == results.table["fall_time"][1]
