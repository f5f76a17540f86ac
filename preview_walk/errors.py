"""The errors that `preview_walk` raises on purpose; each message is one sentence."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import contextmanager

_LONG_WORD = re.compile(r"(\S{60})\S{440,}(\S\S)")
"""Names and values that nobody would read in a sentence."""


def in_short(sentence: str) -> str:
    """Return a sentence with its endless words cut."""
    return _LONG_WORD.sub(r"\1 (and more)\2", sentence)


class PreviewWalkError(Exception):
    """Base of every error raised by this package."""


class InvalidInput(PreviewWalkError, ValueError):
    """An argument that cannot be: says what was expected, what came and what is allowed.

    Attributes:
        argument: name of the argument at fault ("step_time"), where one is.
    """

    def __init__(self, message: str, argument: str | None = None) -> None:
        super().__init__(in_short(message))
        self.argument = argument

    def __reduce__(self) -> tuple[type[InvalidInput], tuple[str, str | None]]:
        """Keep the argument through pickling, as from a worker process."""
        return type(self), (str(self), self.argument)


class RobotError(InvalidInput):
    """A robot file or description that cannot walk; names the offending body, joint or frame."""


@contextmanager
def about(argument: str) -> Iterator[None]:
    """Give the errors of this block the name of the argument at fault, where they have none."""
    try:
        yield
    except InvalidInput as error:
        error.argument = error.argument or argument
        raise
