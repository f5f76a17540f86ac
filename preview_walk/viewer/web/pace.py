"""Real time: so many pictures a second, and no hurry after a delay."""

from __future__ import annotations

from time import perf_counter, sleep

LATE = 0.2
"""Seconds behind the clock after which the lost time is let go."""


class Pace:
    """Waits for the next picture.

    Attributes:
        rate: pictures per second that were reached in the last second.
    """

    def __init__(self, pictures: int) -> None:
        """Begin now; `pictures` per second."""
        self.rate = 0.0
        self._span = 1.0 / pictures
        self._due = perf_counter()
        self._since, self._count = self._due, 0

    def wait(self) -> None:
        """Sleep until the next picture is due."""
        self._due += self._span
        left = self._due - perf_counter()
        if left > 0.0:
            sleep(left)
        elif left < -LATE:
            self._due = perf_counter()
        self._count += 1
        now = perf_counter()
        if now - self._since >= 1.0:
            self.rate = self._count / (now - self._since)
            self._since, self._count = now, 0
