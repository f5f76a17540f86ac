"""Ctrl-C where it must not strike at any moment: noted at once, obeyed where it does no harm."""

from __future__ import annotations

import signal
import threading
from types import FrameType, TracebackType
from typing import Any

_SIGNALS = [
    getattr(signal, name) for name in ("SIGINT", "SIGTERM", "SIGHUP") if hasattr(signal, name)
]


class Stop:
    """Whether a signal asked to stop, in a `with` block of the main thread.

    A handler that was there before hears the signal too; the `KeyboardInterrupt` that it raises is
    kept back the first time, for it could be raised while a pool of processes holds its locks, or
    a window is half open. A second signal is raised.

    Attributes:
        asked: whether a signal came.
    """

    def __init__(self) -> None:
        self.asked = False
        self._before: dict[int, Any] = {}

    def __call__(self) -> bool:
        """Return whether a signal came."""
        return self.asked

    def __enter__(self) -> Stop:
        """Take over the signals that somebody handles."""
        if threading.current_thread() is threading.main_thread():
            for number in _SIGNALS:
                handler = signal.getsignal(number)
                if callable(handler):
                    self._before[number] = handler
                    signal.signal(number, self._receive)
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        """Give them back."""
        for number, handler in self._before.items():
            signal.signal(number, handler)

    def _receive(self, number: int, frame: FrameType | None) -> None:
        again, self.asked = self.asked, True
        try:
            self._before[number](number, frame)
        except KeyboardInterrupt:
            if again:
                raise
