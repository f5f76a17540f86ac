"""Signals: raised at first, noted where something could be lost."""

from __future__ import annotations

import signal
import threading
from typing import Any

import pytest

from preview_walk.cli.interruption import IMPATIENT, Interruption


def test_a_signal_is_raised_once_and_then_noted() -> None:
    with Interruption() as stop:
        with pytest.raises(KeyboardInterrupt):
            signal.raise_signal(signal.SIGTERM)
        signal.raise_signal(signal.SIGINT)  # on the way out: noted
        with pytest.raises(KeyboardInterrupt):
            stop.check()
        stop.check()  # and heard
        assert (stop.name, stop.exit_code) == ("SIGTERM", 143)


def test_a_held_signal_waits_for_the_release() -> None:
    with Interruption() as stop:
        stop.hold()
        signal.raise_signal(signal.SIGHUP)
        with pytest.raises(KeyboardInterrupt):
            stop.release()
        assert (stop.name, stop.exit_code) == ("SIGHUP", 129)


def test_who_insists_is_heard() -> None:
    with Interruption() as stop:
        stop.hold()
        for _ in range(IMPATIENT - 1):
            signal.raise_signal(signal.SIGINT)
        with pytest.raises(KeyboardInterrupt):
            signal.raise_signal(signal.SIGINT)


def test_the_handlers_of_before_come_back_and_ignored_signals_stay_ignored() -> None:
    before = signal.signal(signal.SIGTERM, signal.SIG_IGN)
    try:
        with Interruption() as stop:
            signal.raise_signal(signal.SIGTERM)
            assert stop.received == []
            assert signal.getsignal(signal.SIGINT) == stop._receive
        assert signal.getsignal(signal.SIGINT) is signal.default_int_handler
    finally:
        signal.signal(signal.SIGTERM, before)


def test_outside_the_main_thread_signals_are_left_alone() -> None:
    seen: list[Any] = []

    def work() -> None:
        with Interruption() as stop:
            seen.append(stop.exit_code)

    thread = threading.Thread(target=work)
    thread.start()
    thread.join()
    assert seen == [130]
