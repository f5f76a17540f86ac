"""Ctrl-C, SIGTERM and SIGHUP: the first ends the walk, a later one the writing of its plots."""

from __future__ import annotations

import signal
import threading
from types import FrameType, TracebackType
from typing import Any

_NAMES = {signal.SIGINT: "Ctrl-C", signal.SIGTERM: "SIGTERM"}
if hasattr(signal, "SIGHUP"):
    _NAMES[signal.SIGHUP] = "SIGHUP"

IMPATIENT = 3
"""So many signals that were only noted are raised."""


class Interruption:
    """Receives the signals of its `with` block.

    At first a signal raises `KeyboardInterrupt` at once. After `hold` it is only noted, so that a
    walk that is ready is not lost, and raised by `check` or `release`, where it does no harm. Who
    sends `IMPATIENT` of them before that is heard at once all the same.
    """

    def __init__(self) -> None:
        self.received: list[signal.Signals] = []
        self._held = False
        self._owed = 0
        self._before: dict[signal.Signals, Any] = {}

    @property
    def name(self) -> str:
        """What stopped the command: the first signal received, in words."""
        return _NAMES[self.received[0]] if self.received else "Ctrl-C"

    @property
    def exit_code(self) -> int:
        """128 and the number of the first signal received, as shells have it: 130 for Ctrl-C."""
        return 128 + int(self.received[0] if self.received else signal.SIGINT)

    def hold(self) -> None:
        """Note signals from now on, and raise none."""
        self._held = True

    def release(self) -> None:
        """Raise signals from now on; one that came in the meantime at once."""
        self._held = False
        self.check()

    def check(self) -> None:
        """Raise `KeyboardInterrupt` if a signal was noted and has not been raised."""
        if self._owed:
            self._owed = 0
            raise KeyboardInterrupt

    def _receive(self, number: int, frame: FrameType | None) -> None:
        self.received.append(signal.Signals(number))
        self._owed += 1
        if not self._held or self._owed >= IMPATIENT:
            self._owed = 0
            self._held = True  # what follows is the way out, on which nothing is to be lost
            raise KeyboardInterrupt

    def __enter__(self) -> Interruption:
        """Take the signals over, but for those that are ignored, as under nohup."""
        if threading.current_thread() is threading.main_thread():
            for number in _NAMES:
                if signal.getsignal(number) not in (signal.SIG_IGN, None):
                    self._before[number] = signal.signal(number, self._receive)
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        """Give the signals back."""
        for number, handler in self._before.items():
            signal.signal(number, handler)
