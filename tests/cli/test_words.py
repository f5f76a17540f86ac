"""What the command does with a record or a model, by its first word."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest
from synthetic_walk import walk_record

from preview_walk.analysis.plots import PLOTS
from preview_walk.cli.main import main


@pytest.fixture
def record(tmp_path: Path) -> Path:
    return walk_record(2).save(tmp_path / "record.npz")


@pytest.mark.real_plots
def test_a_record_is_drawn_again(record: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["plot", str(record), "--out", str(record.parent)]) == 0
    assert "CoM error rms x, y, z" in capsys.readouterr().out
    for name in ("walk", *PLOTS):
        assert (record.parent / f"{name}.png").stat().st_size > 10_000


@pytest.mark.parametrize("word", ["plot", "replay", "inspect", "study", "completion"])
def test_a_word_alone_is_one_sentence(word: str, capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as end:
        main([word])
    said = capsys.readouterr().err
    assert end.value.code == 2
    assert said.startswith(f"preview-walk: {word}: the following arguments are required")
    assert said.count("\n") == 1


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        (["plot", "none.npz"], "none.npz"),
        (["replay", "none.npz"], "none.npz"),
        (["replay", "x", "--port", "99999"], "--port: must be a whole number from 0 to 65535"),
        (["inspect", "none.xml"], "none.xml"),
    ],
)
def test_what_cannot_be_is_one_sentence(
    words: list[str], sentence: str, capsys: pytest.CaptureFixture[str]
) -> None:
    try:
        code = main(words)
    except SystemExit as end:
        code = int(str(end.code))
    said = capsys.readouterr().err
    assert code == 2
    assert sentence in said
    assert said.count("\n") == 1


@pytest.mark.parametrize("shell", ["bash", "zsh", "tcsh"])
def test_a_shell_can_complete_the_options(shell: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["completion", shell]) == 0
    said = capsys.readouterr().out
    assert "swing-height" in said
    assert "com-generator" in said


def test_bash_takes_its_completion(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    main(["completion", "bash"])
    script = tmp_path / "completion"
    script.write_text(capsys.readouterr().out)
    ask = f"source {script}; complete -p preview-walk"
    found = subprocess.run(["bash", "-c", ask], capture_output=True, text=True, check=False)
    assert "preview-walk" in found.stdout


def test_a_model_is_reported_on(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["inspect", "humanoid-walker", "--out", str(tmp_path)]) == 0
    assert "65.0 kg" in capsys.readouterr().out
