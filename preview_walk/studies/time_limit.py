"""A time limit for a block of code, in whatever thread it runs."""

from __future__ import annotations

import ctypes
import faulthandler
import threading
from types import TracebackType

GRACE = 5.0
"""Seconds beyond its limit after which a case that does not come back to Python ends its worker."""


class OverTime(BaseException):
    """Raised in a case that has used its time; no `except Exception` of the case catches it."""


class TimeLimit:
    """Raises `OverTime` in the thread of its `with` block after some time.

    Signals reach main threads alone, and Dask's workers run their tasks in others: the exception is
    put into the thread by CPython. Code that never comes back to Python does not see it; after
    `GRACE` the process is then ended, as nothing else can.
    """

    def __init__(self, seconds: float | None) -> None:
        """Begin at the start of the block; None: no limit."""
        self.seconds = seconds
        self._lock, self._over = threading.Lock(), False
        self._timer: threading.Timer | None = None

    def __enter__(self) -> TimeLimit:
        """Start the clock."""
        if self.seconds is not None:
            thread = threading.get_ident()
            self._timer = threading.Timer(self.seconds, self._raise_in, (thread,))
            self._timer.daemon = True
            self._timer.start()
            faulthandler.dump_traceback_later(self.seconds + GRACE, exit=True)
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        """Stop it."""
        if self._timer is not None:
            with self._lock:
                self._over = True
            self._timer.cancel()
            faulthandler.cancel_dump_traceback_later()

    def _raise_in(self, thread: int) -> None:
        with self._lock:
            if not self._over:
                ctypes.pythonapi.PyThreadState_SetAsyncExc(
                    ctypes.c_ulong(thread), ctypes.py_object(OverTime)
                )
