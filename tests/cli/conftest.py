"""Signals as a terminal gives them, for every test of the command."""

from __future__ import annotations

import signal
from collections.abc import Iterator

import pytest


@pytest.fixture(autouse=True)
def signals_are_not_ignored() -> Iterator[None]:
    """Undo `nohup` for the tests: the command leaves a signal alone that was ignored before it."""
    before = {
        number: signal.signal(number, signal.SIG_DFL)
        for number in (signal.SIGHUP, signal.SIGTERM)
        if signal.getsignal(number) is signal.SIG_IGN
    }
    yield
    for number, handler in before.items():
        signal.signal(number, handler)
