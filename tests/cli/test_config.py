"""Options in a file are the options typed, and a run's own file gives the run again."""

from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from preview_walk.cli.options import Options, parse

WALKS = (
    ["--steps", "3", "--turn", "-5", "--push", "1,0.1,5,0,0", "--push", "2,0.1,0,-5,0"],
    ["--velocity", "0.2,0,0", "--duration", "2", "--velocity", "-0.1,0,10", "--duration", "1.5"],
    ["--velocity", "0.2,0,0", "--duration", "2"],
    ["--robot", "g1", "--ground", "slope:degrees=8", "--blind", "--realism", "lab", "--no-plots"],
    ["--start", "-1,2,30", "--pushes", "every=4,impulse=9", "--swing-height", "0.1"],
    [],
)


def same(a: Options, b: Options) -> None:
    names = set(vars(a)) - {"out"}
    assert {n: getattr(a, n) for n in names} == {n: getattr(b, n) for n in names}


@pytest.mark.parametrize("words", WALKS, ids=" ".join)
def test_a_runs_own_file_gives_the_run_again(words: list[str], tmp_path: Path) -> None:
    options = parse(words)
    file = tmp_path / "run.toml"
    file.write_text(options.config)
    same(parse(["--config", str(file)]), options)


@given(length=st.floats(-2.0, 2.0), time=st.floats(0.05, 10.0), steps=st.integers(1, 1000))
def test_numbers_come_back_to_the_last_digit(
    tmp_path_factory: pytest.TempPathFactory, length: float, time: float, steps: int
) -> None:
    options = parse([f"--step-length={length}", f"--step-time={time}", f"--steps={steps}"])
    path = tmp_path_factory.mktemp("config") / "numbers.toml"
    path.write_text(options.config)
    same(parse(["--config", str(path)]), options)


def test_files_heights_and_what_is_printed_are_read() -> None:
    options = parse(
        ["--footsteps=a.csv", "--swing-height=.1", "--com-height=.8", "--json", "--quiet"]
    )
    assert (options.footsteps, options.swing_height, options.com_height) == ("a.csv", 0.1, 0.8)
    assert options.json
    assert options.quiet


def test_what_is_typed_comes_on_top(tmp_path: Path) -> None:
    file = tmp_path / "mine.toml"
    file.write_text('steps = 5\nstep-length = 0.2\npush = "1,0.1,5,0,0"\nblind = false\n')
    options = parse(["--config", str(file), "--steps", "7", "--push", "2,0.1,5,0,0"])
    assert (options.steps, options.step_length, options.blind) == (7, 0.2, False)
    assert [push[0] for push in options.pushes] == [1.0, 2.0]


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("speed = 3", "must have the keys blind, com-generator"),
        ("[steps]\nn = 3", "got 'steps'"),
        ("out = 'x'", "got 'out'"),
        ("steps = ", "is no TOML"),
        ("steps = 'many'", "--steps: must be a whole number from 1 to 100000, got 'many'"),
        ("blind = 3", "got 'blind'"),
    ],
)
def test_a_file_that_cannot_be_is_one_sentence(
    text: str, sentence: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "mine.toml"
    file.write_text(text)
    with pytest.raises(SystemExit) as end:
        parse(["--config", str(file)])
    assert end.value.code == 2
    said = capsys.readouterr().err
    assert sentence in said
    assert said.count("\n") == 1
