"""`preview-walk study` from the first word to the exit code."""

from __future__ import annotations

from pathlib import Path

import pytest

import preview_walk as pw
from preview_walk.cli.main import main


@pytest.fixture
def file(tmp_path: Path) -> Path:
    (tmp_path / "mine.py").write_text(
        "def f(x):\n    if x > 2:\n        raise ValueError('too much')\n    return x * 1.0\n"
    )
    path = tmp_path / "mine.toml"
    path.write_text('function = "mine.py:f"\n[factors]\nx = [1, 2]\n')
    return path


def test_a_file_is_done_shown_and_gone_on_with(
    file: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["study", str(file), "--dry-run"]) == 0
    assert "2 of 2 are left" in capsys.readouterr().out
    assert main(["study", str(file), "--jobs", "1", "--limit", "1"]) == 0
    assert "1 cases; 1 are left" in capsys.readouterr().out
    assert main(["study", str(file)]) == 2
    assert "resume it, or choose another folder" in capsys.readouterr().err
    assert main(["study", str(file), "--jobs", "1", "--resume"]) == 0
    folder = file.with_suffix("")
    assert len(pw.read_results(folder)) == 2
    assert {path.name for path in folder.iterdir()} == {
        "report.html",
        "results.parquet",
        "rows.jsonl",
        "study.json",
    }


def test_a_case_that_did_not_end_by_itself_shows_in_the_exit_code(
    file: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file.write_text(file.read_text().replace("[1, 2]", "[1, 9]"))
    assert main(["study", str(file), "--out", str(tmp_path / "out"), "--jobs", "1"]) == 1
    assert "2 cases, of these 1 error" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        ([], "study: the following arguments are required: FILE.toml"),
        (["x.toml", "--jobs", "0"], "--jobs: must be a whole number from 1 to 1024, got '0'"),
        (["x.toml", "--speed"], "unrecognized arguments: --speed"),
        (["x.toml"], "cannot read x.toml: No such file"),
    ],
)
def test_a_wrong_command_line_is_one_sentence(
    words: list[str], sentence: str, capsys: pytest.CaptureFixture[str]
) -> None:
    try:
        code = main(["study", *words])
    except SystemExit as end:
        code = int(str(end.code))
    said = capsys.readouterr().err
    assert code == 2
    assert sentence in said
    assert said.count("\n") == 1
