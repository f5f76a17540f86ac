"""The option that an error names, and its units."""

from __future__ import annotations

from pathlib import Path

import pytest
from cli_stand_in import Simulation, complaint, run

from preview_walk.cli.naming import OPTION_OF, in_degrees, naming
from preview_walk.cli.option_table import OPTIONS
from preview_walk.errors import InvalidInput, PreviewWalkError
from preview_walk.files import OutputError


@pytest.mark.parametrize(
    ("error", "sentence"),
    [
        (PreviewWalkError("it cannot walk."), "--robot: it cannot walk."),
        (InvalidInput("it is slippery.", "friction"), "--friction: it is slippery."),
        (InvalidInput("a push names the body 'x'", "pushes"), "--push: a push names the body 'x'."),
        (InvalidInput("must be osqp", "solver"), "--solver: must be osqp."),
        (InvalidInput("must be dcm", "com_generator"), "--com-generator: must be dcm."),
        (InvalidInput("must be 1", "physics_hz"), "--physics-hz: must be 1."),
        (
            InvalidInput("too far ahead in the air", "step_length"),
            "--step-length: too far ahead in the air.",
        ),
        (InvalidInput("too short a friction", "step_time"), "--step-time: too short a friction."),
        (
            InvalidInput("step 3 turns 0.5 rad (28.6 degrees) out", "turn"),
            "--turn: step 3 turns 28.6 degrees out.",
        ),
        (InvalidInput("friction in words alone"), "--robot: friction in words alone."),
        (InvalidInput("of nobody", "an argument of nobody"), "--robot: of nobody."),
    ],
)
def test_errors_of_the_library_name_the_option(
    error: Exception,
    sentence: str,
    simulation: Simulation,
    out: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    simulation.error = error
    assert run(out) == 2
    assert complaint(capsys) == f"preview-walk: {sentence}"


def test_every_option_of_the_table_exists() -> None:
    of_studies = {"--resume"}
    assert set(OPTION_OF.values()) <= {option.name for option in OPTIONS} | of_studies


@pytest.mark.parametrize(
    ("sentence", "expected"),
    [
        ("turns 0.600 rad (34.4 degrees) out", "turns 34.4 degrees out"),
        ("from -1.5708 rad to 1e-1 rad", "from -90.0 degrees to 5.7 degrees"),
        ("at most 0.5 rad/s (28.6 degrees/s)", "at most 28.6 degrees/s"),
        ("2 radii and 3 rads", "2 radii and 3 rads"),
        ("0.5 m ahead", "0.5 m ahead"),
    ],
)
def test_angles_are_told_in_degrees(sentence: str, expected: str) -> None:
    assert in_degrees(sentence) == expected


def test_a_file_that_cannot_be_written_keeps_its_own_sentence() -> None:
    with pytest.raises(OutputError, match=r"^cannot write"), naming("--video"):
        raise OutputError("cannot write it.")


@pytest.mark.parametrize("argument", ["t", "duration", "force", "start", None])
def test_what_is_wrong_of_a_push_is_told_of_push(argument: str | None) -> None:
    """The duration of a push is not `--duration`, which may not have been given at all."""
    with pytest.raises(InvalidInput, match=r"^--push: it cannot be\.$"), naming("--push"):
        raise InvalidInput("it cannot be.", argument)
