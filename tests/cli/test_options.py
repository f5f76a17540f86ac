"""The command's options: what is read, and the one sentence when it can't be."""

from __future__ import annotations

import contextlib
import dataclasses
import io
import os
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from preview_walk.cli import main as cli
from preview_walk.cli import options as cli_options
from preview_walk.cli.option_table import OPTIONS, Option
from preview_walk.cli.options import parse
from preview_walk.controller.robot_limits import USUAL_LENGTH, USUAL_SHARE


def complaint(capsys: pytest.CaptureFixture[str]) -> str:
    """Return the one line on stderr."""
    (line,) = capsys.readouterr().err.splitlines()
    return line


def test_defaults() -> None:
    options = parse([])
    assert (options.robot, options.steps, options.step_length) == ("talos", 20, None)
    assert (options.step_time, options.double_support_ratio) == (None, 0.2)
    assert (options.turn, options.commands, options.random_pushes) == (0.0, (), None)
    assert (options.physics_hz, options.control_hz, options.solver) == (None, None, None)
    assert (options.list_robots, options.inspect) == (False, None)
    assert (options.web, options.port) == (False, 8080)
    assert (options.start, options.friction, options.pushes) == ((0.0, 0.0, 0.0), None, ())
    assert (options.seed, options.out, options.video, options.view) == (
        0,
        Path("walk"),
        False,
        False,
    )


def test_every_option_is_read() -> None:
    line = (
        "--robot my.xml --steps 7 --step-length -0.1 --step-time 0.62 --double-support-ratio 0.05 "
        "--turn -9 --start -100,.5,137 --friction 0.5 --push 2,0.2,-150,0,1e1 "
        "--push=3,0.1,0,-5,0 --pushes impulse=20,every=3 --seed 9 --physics-hz 2000 "
        "--control-hz 1000 --solver daqp --com-generator dcm --out there --no-plots --video "
        "--view --web --port 0 --list-robots --inspect my.urdf"
    )
    options = parse(line.split())
    assert options == cli_options.Options(
        robot="my.xml",
        steps=7,
        step_length=-0.1,
        step_time=0.62,
        double_support_ratio=0.05,
        turn=np.radians(-9),
        commands=(),
        start=(-100.0, 0.5, np.radians(137)),
        friction=0.5,
        ground=None,
        pushes=((2.0, 0.2, (-150.0, 0.0, 10.0)), (3.0, 0.1, (0.0, -5.0, 0.0))),
        random_pushes=(3.0, 20.0),
        seed=9,
        physics_hz=2000,
        control_hz=1000,
        solver="daqp",
        com_generator="dcm",
        out=Path("there"),
        video=True,
        view=True,
        web=True,
        port=0,
        list_robots=True,
        inspect="my.urdf",
        no_plots=True,
        config=options.config,
    )


PIECES = st.one_of(
    st.sampled_from([option.name for option in OPTIONS]),
    st.sampled_from(["--steps=", "--", "-", "every=1,impulse=2", "1e999", "nan,0,0", "0x1", "1_0"]),
    st.floats().map(str),
    st.integers().map(str),
    st.lists(st.floats(), max_size=6).map(lambda xs: ",".join(map(str, xs))),
    st.text(max_size=8),
)


@settings(max_examples=400)
@given(st.lists(PIECES, max_size=4))
def test_any_line_is_read_or_gets_one_sentence(line: list[str]) -> None:
    errors, options = io.StringIO(), None
    with contextlib.redirect_stderr(errors), contextlib.suppress(SystemExit):
        options = parse(line)
    if options is None:
        assert errors.getvalue().startswith("preview-walk: ")
        assert errors.getvalue().count("\n") == 1
    else:
        steps = [x for x in (options.step_length, options.step_time) if x is not None]
        numbers = [*steps, options.turn, *options.start]
        numbers += [x for command, duration in options.commands for x in (*command, duration)]
        numbers += [x for t, duration, force in options.pushes for x in (t, duration, *force)]
        assert np.abs(numbers).max() <= 1e5


def test_velocities_and_durations_go_in_pairs_in_their_order() -> None:
    options = parse(
        [
            "--velocity",
            "0.3,0,0",
            "--duration",
            "4",
            "--velocity",
            "-.2,0.1,90",
            "--duration",
            "2.5",
        ]
    )
    assert options.commands == (((0.3, 0.0, 0.0), 4.0), ((-0.2, 0.1, np.pi / 2), 2.5))


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        ("--steps 0", "--steps: must be a whole number from 1 to 100000, got '0'."),
        ("--steps 2.5", "--steps: must be a whole number from 1 to 100000, got '2.5'."),
        ("--steps -3", "--steps: must be a whole number from 1 to 100000, got '-3'."),
        ("--steps", "--steps: must be a whole number from 1 to 100000, got nothing."),
        ("--step-length nan", "--step-length: must be a length in metres from -2 to 2, got 'nan'."),
        ("--step-time 0", "--step-time: must be a time in seconds above 0 and up to 10, got '0'."),
        (
            "--double-support-ratio 1",
            "--double-support-ratio: must be a share of the step time above 0 and below 1, "
            "got '1'.",
        ),
        (
            "--start 1,2",
            "--start: must be 3 numbers X,Y,YAW_DEG separated by commas (metres, metres, degrees, "
            "up to 100000 either way), got '1,2'.",
        ),
        (
            "--friction -inf",
            "--friction: must be a friction coefficient above 0 and up to 10, got '-inf'.",
        ),
        (
            "--push 1,0,5,5,5",
            "--push: must be 5 numbers T,DURATION,FX,FY,FZ separated by commas (seconds from 0 on, "
            "seconds above 0, newtons up to 10000 either way), got '1,0,5,5,5'.",
        ),
        (
            "--push 1,0.2,0,-1e5,0",
            "--push: must be 5 numbers T,DURATION,FX,FY,FZ separated by commas (seconds from 0 on, "
            "seconds above 0, newtons up to 10000 either way), got '1,0.2,0,-1e5,0'.",
        ),
        (
            "--turn 91",
            "--turn: must be an angle in degrees from -90 to 90, got '91'.",
        ),
        (
            "--velocity 1,0",
            "--velocity: must be 3 numbers VX,VY,YAWRATE_DEG separated by commas (m/s forward and "
            "m/s left, up to 10 either way, degrees per second left, up to 720), got '1,0'.",
        ),
        (
            "--velocity -1e308,0,0",
            "--velocity: must be 3 numbers VX,VY,YAWRATE_DEG separated by commas (m/s forward and "
            "m/s left, up to 10 either way, degrees per second left, up to 720), got '-1e308,0,0'.",
        ),
        (
            "--velocity 1,0,0 --duration 0",
            "--duration: must be a time in seconds above 0 and up to 100000, got '0'.",
        ),
        (
            "--velocity 1,0,0 --duration 1 --velocity 0,0,9",
            "--velocity: must come with one --duration each, got 2 of --velocity and 1 of "
            "--duration.",
        ),
        (
            "--velocity 1,0,0 --duration 1 --step-length 0.2",
            "--step-length: must be left out beside --velocity, which chooses the steps by itself.",
        ),
        (
            "--pushes every=3",
            "--pushes: must be every=S,impulse=NS (seconds, 0.2 or more; newton-seconds above 0 "
            "and up to 2000), got 'every=3'.",
        ),
        (
            "--pushes every=3,impulse=nan",
            "--pushes: must be every=S,impulse=NS (seconds, 0.2 or more; newton-seconds above 0 "
            "and up to 2000), got 'every=3,impulse=nan'.",
        ),
        ("--control-hz 0", "--control-hz: must be a whole number from 1 to 100000, got '0'."),
        (
            "--inspect",
            "--inspect: must be the name of a robot or the path of its model, got nothing.",
        ),
        ("--seed -1", "--seed: must be a whole number from 0 to 4294967295, got '-1'."),
        ("--out=", "--out: must be the name of a folder, got ''."),
    ],
)
def test_bad_values_get_one_sentence(
    arguments: str, sentence: str, capsys: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(SystemExit) as stop:
        cli.main(arguments.split())
    assert stop.value.code == 2
    assert complaint(capsys) == f"preview-walk: {sentence}"


@pytest.mark.parametrize("arguments", ["--stepz 3", "walk", "--step 3"])
def test_unknown_options_are_named_beside_the_known(
    arguments: str, capsys: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(SystemExit) as stop:
        cli.main(arguments.split())
    assert stop.value.code == 2
    text = complaint(capsys)
    guess = "did you mean --steps? " if arguments.startswith("--") else ""
    name = arguments.split()[0]
    assert text.startswith(f"preview-walk: {name}: no such option; {guess}allowed are ")
    assert "--steps" in text


def test_help_lists_every_option_and_exit_code(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as stop:
        cli.main(["--help"])
    assert stop.value.code == 0
    text = capsys.readouterr().out
    for field in dataclasses.fields(cli_options.Options):
        name = {"random_pushes": "pushes", "pushes": "push", "commands": "velocity"}.get(
            field.name, field.name
        )
        assert f"--{name.replace('_', '-')} " in text
    assert "0 walked and stood; 1 fell; 2 bad input" in text


def test_the_readme_has_every_option_and_default(capsys: pytest.CaptureFixture[str]) -> None:
    readme = (Path(__file__).parents[2] / "README.md").read_text(encoding="utf-8")
    with pytest.raises(SystemExit):
        cli.main(["--help"])
    names = set(re.findall(r"--[a-z][a-z-]+", capsys.readouterr().out)) - {"--help"}
    defaults = dict(re.findall(r"\| `(--[a-z-]+)[^`]*` \|.*\| *(.*?) *\|\n", readme))
    assert set(defaults) == names
    options = parse([])
    for name in (
        "steps",
        "double-support-ratio",
        "seed",
        "out",
        "port",
    ):
        value = getattr(options, name.replace("-", "_"))
        assert defaults[f"--{name}"].strip("`") == str(value)
    assert defaults["--step-length"] == f"{USUAL_LENGTH}, and at most {USUAL_SHARE} of the leg"
    assert defaults["--step-time"] == "by the leg: 0.9 for TALOS"


def test_python_m_is_the_same_command() -> None:
    environment = {**os.environ, "PYTHONWARNINGS": "ignore"}
    done = subprocess.run(
        [sys.executable, "-m", "preview_walk", "--steps", "x"],
        capture_output=True,
        text=True,
        env=environment,
        check=False,
    )
    assert done.returncode == 2
    assert done.stdout == ""
    assert done.stderr == (
        "preview-walk: --steps: must be a whole number from 1 to 100000, got 'x'.\n"
    )


@pytest.mark.parametrize("option", OPTIONS, ids=lambda option: option.name)
def test_dashes_are_no_value(option: Option, capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as end:
        parse([f"{option.name}=--"])
    assert end.value.code == 2
    sentence = complaint(capsys)
    assert f"{option.name}: must be" in sentence
    assert sentence.endswith("got nothing.")
