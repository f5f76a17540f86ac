"""What is asked of a running walk from outside its loop, by any thread."""

from __future__ import annotations

import warnings
from collections import deque
from collections.abc import Callable
from threading import RLock
from types import TracebackType
from typing import Any

from preview_walk.errors import InvalidInput


class Requests:
    """Requests are done at once, or at the next tick where one is under way in another thread.

    As a context it marks a tick that is under way; what waits is done as it begins.
    """

    def __init__(self) -> None:
        self._waiting: deque[Callable[[], None]] = deque()
        self._lock = RLock()

    def do(self, request: Callable[[], None]) -> None:
        """Do a request now or at the next tick; raises what it raises if it is done now."""
        if not self._lock.acquire(blocking=False):
            self._waiting.append(request)
            return
        try:
            request()
        finally:
            self._lock.release()

    def __enter__(self) -> None:
        self._lock.acquire()
        while self._waiting:
            try:
                self._waiting.popleft()()
            except InvalidInput as refusal:  # whoever asked is no longer there to be told
                warnings.warn(f"what another thread asked for is refused: {refusal}", stacklevel=3)

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._lock.release()

    def __getstate__(self) -> dict[str, Any]:
        """Leave out the lock, which belongs to this process."""
        return {"_waiting": self._waiting}

    def __setstate__(self, state: dict[str, Any]) -> None:
        """Take what waits, with a lock of its own."""
        self._waiting, self._lock = state["_waiting"], RLock()
