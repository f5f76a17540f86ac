"""Studies from files: every form that a level may have, and every mistake one sentence."""

from __future__ import annotations

from pathlib import Path

import pytest

import preview_walk as pw

FILE = """
repeats = 2
seed = 5
time_limit = 30
keep = "failed"
[factors]
robot = ["talos", "g1"]
velocity = [[0.2, 0.0, 0.0], [0.3, 0.0, 0.1]]
direction = { from = 0, to = 270, count = 4 }
push_at = { uniform = [2, 4] }
duration = 6
[margin]
factor = "impulse"
low = 0
high = 200
precision = 5
"""


def test_a_file_says_all_that_a_study_can_be(tmp_path: Path) -> None:
    path = tmp_path / "pushes.toml"
    path.write_text(FILE)
    study = pw.read_study(path)
    assert study.function is pw.walk_case
    assert (study.name, study.repeats, study.seed, study.keep) == ("pushes", 2, 5, "failed")
    assert study.margin == pw.Margin("impulse", 0, 200, 5)
    assert len(study) == 2 * 2 * 4 * 2
    first = next(iter(study.cases())).values
    assert first["velocity"] == [0.2, 0.0, 0.0]
    assert 2.0 <= first["push_at"] <= 4.0
    directions = {case.values["direction"] for case in study.cases()}
    assert directions == {0.0, 90.0, 180.0, 270.0}


def test_a_function_beside_the_file_runs_in_workers(tmp_path: Path) -> None:
    (tmp_path / "mine.py").write_text("K = 3\ndef f(x, seed):\n    return {'v': K * x}\n")
    path = tmp_path / "mine.toml"
    path.write_text('function = "mine.py:f"\n[factors]\nx = [1, 2]\n')
    results = pw.read_study(path).run(tmp_path / "out", jobs=1, progress=False)
    assert [*results.table["v"]] == [3, 6]


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("factors = 3", "levels by name"),
        ("[factor]\nx = 1", "must have the keys factors, function"),
        ("x = [", "is no TOML"),
        ("repeats = 2", "must have factors"),
        ("[factors]\nrobot = { normal = [1] }", "factor 'robot' must be values, or one of"),
        ("[factors]\nrobot = { from = 0, to = 1, count = 'x' }", "factor 'robot' must be values"),
        ("[factors]\nspeed = 1", "which takes .*; got speed"),
        ('function = "os"\n[factors]\nx = 1', "must be 'module:name' or 'file.py:name'"),
        ('function = "os:nothing"\n[factors]\nx = 1', "os has no function 'nothing'"),
        ('function = "none.py:f"\n[factors]\nx = 1', "cannot load none.py"),
        (
            "[factors]\nrobot = 'g1'\n[margin]\nfactor = 'impulse'",
            "factor, low, high and precision",
        ),
        ("[factors]\nrobot = 'g1'\n[margin]\nlow = 'x'\nmore = 1", "margin must have the keys"),
        ("repeats = 'x'\n[factors]\nrobot = 'g1'", "repeats must be an integer"),
        ("name = 3\n[factors]\nrobot = 'g1'", "name must be a str"),
    ],
)
def test_a_file_that_describes_no_study_is_one_sentence(
    tmp_path: Path, text: str, sentence: str
) -> None:
    path = tmp_path / "study.toml"
    path.write_text(text)
    with pytest.raises(pw.InvalidInput, match=sentence):
        pw.read_study(path)


def test_what_is_no_file_is_one_sentence(tmp_path: Path) -> None:
    with pytest.raises(pw.InvalidInput, match="Is a directory"):
        pw.read_study(tmp_path)
    (tmp_path / "bytes.toml").write_bytes(b"\xff\xfe\x00")
    with pytest.raises(pw.InvalidInput, match="is no TOML"):
        pw.read_study(tmp_path / "bytes.toml")
