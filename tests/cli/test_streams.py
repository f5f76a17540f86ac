"""Streams whose writes do not fail."""

from __future__ import annotations

import io
import sys

import pytest

from preview_walk.cli.streams import SafeStream, complain, emphasised, safe_streams, say


class Broken(io.TextIOWrapper):
    """A stream that fails as it is told."""

    def __init__(self, error: OSError) -> None:
        super().__init__(io.BytesIO(), encoding="utf-8")
        self.error = error

    def flush(self) -> None:
        raise self.error


def test_the_first_failure_is_kept_and_a_reader_that_left_is_none() -> None:
    full = OSError(28, "No space left on device")
    stream = SafeStream(Broken(full))
    print("text", file=stream, flush=True)  # type: ignore[call-overload]
    assert stream.failure is full
    gone = SafeStream(Broken(BrokenPipeError()))
    print("text", file=gone, flush=True)  # type: ignore[call-overload]
    assert gone.failure is None


def test_what_the_encoding_does_not_have_is_escaped() -> None:
    inner = io.TextIOWrapper(io.BytesIO(), encoding="ascii")
    SafeStream(inner).write("5 N·m in w\udcff")
    inner.flush()
    assert inner.buffer.getvalue() == rb"5 N\xb7m in w\udcff"  # type: ignore[attr-defined]


def test_streams_come_back_and_closed_ones_are_filled(monkeypatch: pytest.MonkeyPatch) -> None:
    before = sys.stdout
    monkeypatch.setattr(sys, "stderr", None)
    with safe_streams() as output:
        complain("to nowhere")
        say("to stdout")
        assert sys.stdout is output  # type: ignore[comparison-overlap]
    assert sys.stdout is before


@pytest.mark.parametrize(("words", "colour"), [("did not fall", "32"), ("FELL at 3 s", "1;31")])
def test_the_outcome_has_a_colour_on_a_terminal_alone(
    words: str, colour: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    table = f"robot    talos\noutcome  {words}"
    assert emphasised(table) == table
    monkeypatch.setattr("sys.stdout.isatty", lambda: True, raising=False)
    monkeypatch.delenv("NO_COLOR", raising=False)
    assert f"\x1b[{colour}m" in emphasised(table)
    monkeypatch.setenv("NO_COLOR", "1")
    assert emphasised(table) == table
