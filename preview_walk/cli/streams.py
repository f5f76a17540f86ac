"""Standard output and error that may be closed, full, or not able to spell a name."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from typing import Any, TextIO

from preview_walk.errors import in_short

_GREEN, _RED = "32", "1;31"
"""Colours of a terminal (SGR)."""


class SafeStream:
    """A text stream whose writes do not fail.

    Attributes:
        failure: the first reason why something could not be written; a reader that has gone (as in
            `preview-walk | head -1`) is none.
    """

    def __init__(self, stream: TextIO) -> None:
        self._stream = stream
        self.failure: OSError | None = None

    def write(self, text: str) -> int:
        """Write all of the text, with escapes for what the stream's encoding does not have."""
        encoding = self._stream.encoding or "utf-8"
        try:
            self._stream.write(text.encode(encoding, "backslashreplace").decode(encoding))
        except OSError as error:
            self._drop(error)
        return len(text)

    def flush(self) -> None:
        """Send on what was written."""
        try:
            self._stream.flush()
        except OSError as error:
            self._drop(error)

    def __getattr__(self, name: str) -> Any:
        return getattr(self._stream, name)

    def _drop(self, error: OSError) -> None:
        """Note the failure and let the rest, and what is still buffered, go nowhere."""
        if self.failure is None and not isinstance(error, BrokenPipeError):
            self.failure = error
        with suppress(OSError, ValueError):
            nowhere = os.open(os.devnull, os.O_WRONLY)
            os.dup2(nowhere, self._stream.fileno())
            os.close(nowhere)


@contextmanager
def safe_streams() -> Iterator[SafeStream]:
    """Make `sys.stdout` and `sys.stderr` safe in this block; gives the first."""
    _fill_closed()
    before = sys.stdout, sys.stderr
    output, errors = SafeStream(before[0]), SafeStream(before[1])
    sys.stdout, sys.stderr = output, errors
    try:
        yield output
    finally:
        output.flush()
        errors.flush()
        sys.stdout, sys.stderr = before


def _fill_closed() -> None:
    """Open the null device where a standard stream is closed.

    Otherwise the next file opened, the record perhaps, takes its number, and whatever a library
    prints goes into that file.
    """
    for number, name in enumerate(("stdin", "stdout", "stderr")):
        try:
            os.fstat(number)
        except OSError:
            os.open(os.devnull, os.O_RDWR)  # takes the lowest number that is free: this one
        if getattr(sys, name) is None:
            mode = "r" if number == 0 else "w"
            setattr(sys, name, open(number, mode, encoding="utf-8", closefd=False))  # noqa: SIM115


def complain(sentence: str) -> None:
    """Print one line on stderr."""
    print(f"preview-walk: {in_short(' '.join(sentence.split()))}", file=sys.stderr, flush=True)


def say(text: str) -> None:
    """Print to stdout."""
    print(text, flush=True)


def emphasised(table: str) -> str:
    """Return a table of figures whose outcome has a colour where a terminal shows it.

    Who sets NO_COLOR has none, as everywhere.
    """
    if not sys.stdout.isatty() or os.environ.get("NO_COLOR"):
        return table
    for words, colour in (("did not fall", _GREEN), ("FELL", _RED)):
        table = table.replace(words, f"\x1b[{colour}m{words}\x1b[0m", 1)
    return table
