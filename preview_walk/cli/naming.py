"""Which option an error of the library speaks of, and in the option's units."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import contextmanager
from math import degrees

from preview_walk.errors import InvalidInput, PreviewWalkError
from preview_walk.files import OutputError

OPTION_OF = {
    "n_steps": "--steps",
    "step_length": "--step-length",
    "step_time": "--step-time",
    "double_support_ratio": "--double-support-ratio",
    "turn": "--turn",
    "step_width": "--robot",
    "robot": "--robot",
    "command": "--velocity",
    "duration": "--duration",
    "start": "--start",
    "start_pos": "--start",
    "friction": "--friction",
    "ground": "--ground",
    "pushes": "--push",
    "every": "--pushes",
    "impulse": "--pushes",
    "seed": "--seed",
    "physics_hz": "--physics-hz",
    "control_hz": "--control-hz",
    "record_hz": "--record-hz",
    "solver": "--solver",
    "com_generator": "--com-generator",
    "realism": "--realism",
    "port": "--port",
    "resume": "--resume",
    "footsteps": "--footsteps",
    "swing_height": "--swing-height",
    "com_height": "--com-height",
}
"""The option that sets an argument of the library; `InvalidInput.argument` names the argument."""

WHOLE = ("--push",)
"""Options whose value holds arguments that have the names of other options' ones: an error under
them is theirs (the duration of a push is not `--duration`)."""

_RADIANS = re.compile(
    r"(-?\d+(?:\.\d*)?(?:e[-+]?\d+)?) rad\b(/s)?(?: \(-?[\d.]+ degrees(?:/s)?\))?"
)


@contextmanager
def naming(option: str) -> Iterator[None]:
    """Put the option at fault before the sentence of an error, in one line and in its units.

    Args:
        option: the one to name where an error has no argument in `OPTION_OF`.

    Raises:
        InvalidInput: in place of every error of the package, but for files that cannot be written.
    """
    try:
        yield
    except OutputError:
        raise
    except PreviewWalkError as error:
        argument = error.argument if isinstance(error, InvalidInput) else None
        name = option if option in WHOLE else OPTION_OF.get(argument or "", option)
        sentence = in_degrees(str(error)).rstrip(".")
        raise InvalidInput(f"{name}: {sentence}.", argument=argument) from error


def in_degrees(sentence: str) -> str:
    """Return a sentence with its angles in degrees, as the options have them."""
    return _RADIANS.sub(
        lambda found: f"{degrees(float(found[1])):.1f} degrees{found[2] or ''}", sentence
    )
