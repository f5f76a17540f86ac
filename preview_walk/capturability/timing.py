"""The times of the steps that answer a push: given, or searched for the largest push.

For given times the largest push is one programme (`program`); in the times the problem
is smooth in pieces only, so they are searched without derivatives.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from math import hypot, inf

import numpy as np

from preview_walk.capturability.gait import PushGait
from preview_walk.capturability.program import Capture, CaptureStep, largest_jump
from preview_walk.types import Array

MOST_STEPS = 6
"""Steps within which the DCM must come to rest."""

_DELAYS = tuple(0.05 * i for i in range(7))
"""Times (s) in which who stands shifts the weight before the first foot lifts: the grid that the
reference figures agree with. They matter to narrow soles in a wide stance, which must shift before
they lift: there a delay tuned to the millisecond adds about 3 %."""

_FINEST = 3e-5
"""Swing times are found to this (s): the best are often at a kink, where 1 ms is worth 0.3 %."""

_DETOUR = 1.01
"""The disc that limits a swing is a polygon inside it, so the whole way takes a little longer."""


@dataclass(frozen=True, eq=False)
class TimedCapture:
    """A capture and the times it needs.

    Attributes:
        capture: the largest jump of the DCM and the strides.
        delay: from the push until the first foot lifts (s); infinite for one who only stands.
        singles: (n,) how long each foot is in the air from then or from the push on (s).
        pause: how long both feet stand between two steps (s).
    """

    capture: Capture
    delay: float
    singles: tuple[float, ...]
    pause: float


def best_of(found: Iterable[TimedCapture | None]) -> TimedCapture | None:
    """Return the capture of the largest jump, or None if there is none."""
    return max(
        (timed for timed in found if timed is not None),
        key=lambda timed: timed.capture.jump,
        default=None,
    )


@dataclass(frozen=True, eq=False)
class PushCase:
    """A push whose size is sought.

    Attributes:
        gait: the robot and its walk.
        share: of single support that is over; None: standing.
        direction: (2,) unit vector of the push.
    """

    gait: PushGait
    share: float | None
    direction: Array

    def at(self, delay: float, singles: Sequence[float], kept: bool = False) -> TimedCapture | None:
        """Return the largest capture with strides at these times, or None if there is none.

        Args:
            delay: from the push until the first foot lifts (s).
            singles: (n,) how long each foot is in the air (s).
            kept: whether the footholds stay those of the plan.
        """
        strides = self.gait.strides(self.share, delay, singles, kept)
        return self._largest(delay, singles, strides, self.gait.double_support)

    def in_free_times(
        self, delay: float, singles: Sequence[float], refine: bool = True
    ) -> TimedCapture | None:
        """Return the same with the double supports of an answer whose times are free.

        Args:
            delay: from the push until the first foot lifts (s).
            singles: (n,) how long each foot is in the air (s).
            refine: as of `largest_jump`.
        """
        gait = self.gait
        pause = gait.short_double_support
        pause = gait.double_support if pause is None else pause
        strides = gait.strides(self.share, delay, singles, pause=pause)
        return self._largest(delay, singles, strides, pause, refine)

    def _largest(
        self,
        delay: float,
        singles: Sequence[float],
        strides: Sequence[CaptureStep],
        pause: float,
        refine: bool = True,
    ) -> TimedCapture | None:
        """Return the largest capture with these strides, or None if there is none."""
        gait = self.gait
        capture = largest_jump(gait.dcm(self.share), self.direction, gait.sole, strides, refine)
        return None if capture is None else TimedCapture(capture, delay, tuple(singles), pause)

    def by_cop(self) -> TimedCapture | None:
        """Return the best answer that keeps the plan; standing, that stands still."""
        if self.share is None:
            return self.at(inf, ())
        return self.at(0.0, self._nominal(), kept=True)

    def by_steps(self) -> TimedCapture | None:
        """Return the best answer by up to six steps in the nominal times."""
        return best_of(
            self.at(delay, self._nominal()[:count])
            for delay in self._delays()
            for count in range(1, MOST_STEPS + 1)
        )

    def by_steps_and_timing(self) -> TimedCapture | None:
        """Return the best answer found by up to six steps whose times are free.

        One or two steps are tried on a grid of times. Then six, with three times searched by
        coordinates from the best of these: the first swing, the second, and the later ones.
        """
        start = best_of(self._few_steps())
        if start is None:
            return None
        low, high = self._swing_times()
        later = float(low[1]) if len(start.singles) == 1 else start.singles[1]
        times = np.array([start.singles[0], later, later])

        def with_steps(times: Array, count: int, refine: bool) -> TimedCapture | None:
            """Return the best answer by so many steps at these times."""
            singles = [*times.tolist(), *[float(times[2])] * (MOST_STEPS - 3)]
            return self.in_free_times(start.delay, singles[:count], refine)

        best, step = with_steps(times, MOST_STEPS, False), 0.02
        axes = np.array([[1, 0, 0], [0, 1, 0], [0, 0, 1], [0, 1, 1]])
        while step > _FINEST:
            tries = np.clip(times + step * np.vstack([axes, -axes]), low, high)
            moves = ((with_steps(trial, MOST_STEPS, False), trial) for trial in tries)
            found = [(timed, trial) for timed, trial in moves if timed is not None]
            top, trial = max(found, key=lambda pair: pair[0].capture.jump, default=(None, times))
            if top is not None and best_of((best, top)) is not best:
                best, times = top, trial
            else:
                step /= 2.0
        return best_of(
            [start, best, *(with_steps(times, n, True) for n in range(1, MOST_STEPS + 1))]
        )

    def _few_steps(self) -> Iterable[TimedCapture | None]:
        """Yield answers by one or two steps on a grid of times.

        Later swings last as short as may be, or until the foot gets to an end of its reach.
        """
        gait = self.gait
        low, high = self._swing_times()
        ways = [2.0 * gait.forward, 2.0 * gait.backward]
        ways.append(hypot(max(ways), gait.max_width - gait.min_width))
        lasting = np.clip([0.0, *(_DETOUR / gait.swing_speed * np.array(ways))], low[1], high[1])
        tails = [(), *((single,) for single in sorted(set(lasting.tolist())))]
        delays = self._delays()
        firsts = np.linspace(low[0], high[0], 25 if len(delays) == 1 else 13).tolist()
        for delay in delays:
            for first in firsts:
                for tail in tails:
                    yield self.in_free_times(delay, (first, *tail), refine=False)

    def _nominal(self) -> tuple[float, ...]:
        """Return the six swing times of the plan (s); the first is what is left of it."""
        single = self.gait.single_support
        return (single * (1.0 - (self.share or 0.0)), *[single] * (MOST_STEPS - 1))

    def _swing_times(self) -> tuple[Array, Array]:
        """Return the shortest and the longest first swing, second and later ones, (3,) s."""
        gait = self.gait
        over = gait.single_support * (self.share or 0.0)
        low, high = gait.min_swing_time, gait.max_swing_time
        return np.array([max(0.0, low - over), low, low]), np.array([high - over, high, high])

    def _delays(self) -> tuple[float, ...]:
        """Return the delays of the first lift to try (s)."""
        return _DELAYS if self.share is None else (0.0,)
