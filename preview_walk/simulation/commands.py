"""Velocity commands of a running walk: the one in force, those to come, and the plans for them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import islice

import numpy as np

from preview_walk.arguments import MOST, positive_number, shown
from preview_walk.errors import InvalidInput
from preview_walk.footsteps.limits import GaitLimits
from preview_walk.footsteps.plan import FootstepPlan
from preview_walk.footsteps.velocity import follow_velocity, saturated

FORGET = 3.0
"""A walk by command forgets footsteps older than this (s): an endless walk keeps a short plan."""

Command = tuple[float, float, float]
"""Velocity commanded: vx, vy (m/s), yaw rate (rad/s), in the frame of the walking robot."""

STOP: Command = (0.0, 0.0, 0.0)

_ROUNDING = 1e-9


class VelocityCommands:
    """Keeps commands and returns the plans that they ask for, when they do.

    Attributes:
        current: the command in force.
    """

    def __init__(self, limits: Callable[[], GaitLimits], dt: float) -> None:
        """Stand, until a command comes.

        Args:
            limits: gives the bounds of the steps, to which commands are scaled down; asked for
                when there is a command, for what motors allow takes a second to find.
            dt: time of a control tick, s.
        """
        self.current = STOP
        self._limits = limits
        self._dt = dt
        self._later: list[tuple[float, Command]] = []
        self._due = np.inf

    def require_end(self) -> None:
        """Raise `InvalidInput` where a command is in force that nothing will end."""
        if any(self.current) and not self._later:
            raise InvalidInput(
                "until must be given while a command is in force, got a walk at "
                f"{self.current} for ever; command(0, 0, 0) stops it.",
                "until",
            )

    @property
    def end(self) -> float:
        """Time (s) of the last command to come; -inf where none is."""
        return self._later[-1][0] if self._later else -np.inf

    def give(self, t: float, command: Command) -> None:
        """Put a command in force at time t (s); raises `InvalidInput` for one that cannot be."""
        saturated(command, self._limits())
        vx, vy, wz = (float(speed) for speed in command)
        self.current, self._due = (vx, vy, wz), t

    def schedule(self, t: float, commands: Sequence[tuple[Command, float]]) -> None:
        """Put these commands in force one after the other from time t (s) on, then stop.

        Args:
            t: now, s.
            commands: pairs of a command and its duration, s.

        Raises:
            InvalidInput: a command that cannot be, or a duration that is not > 0.
        """
        later = []
        for command, given in _pairs(commands):
            duration = positive_number(given, "duration", "s")
            saturated(command, self._limits())
            later.append((t, command))
            t += duration
        self._later = [*later, (t, STOP)]

    def plan(self, t: float, plan: FootstepPlan) -> FootstepPlan | None:
        """Return the plan to walk by from time t (s) on, or None while `plan` serves.

        Planned again at every lift, so that the plan of a command in force never ends.
        """
        while self._later and t >= self._later[0][0] - _ROUNDING:
            self.give(t, self._later.pop(0)[1])
        if t < self._due:
            return None
        new = follow_velocity(plan, t, self.current, self._limits())
        if new is not plan:
            new = new.since(t - FORGET)
        lift = new.next_lift(t)
        going = any(self.current)
        self._due = (t if lift is None else lift.lift) + 0.5 * self._dt if going else np.inf
        return None if new is plan else new


def _pairs(commands: Sequence[tuple[Command, float]]) -> list[tuple[Command, float]]:
    """Return the pairs of a command and its duration that somebody gives, unread."""
    try:
        pairs = [(command, duration) for command, duration in islice(commands, MOST + 1)]
    except (TypeError, ValueError):
        raise InvalidInput(
            f"commands must hold pairs ((vx, vy, yaw rate), duration), got {shown(commands)}.",
            "commands",
        ) from None
    if len(pairs) > MOST:
        raise InvalidInput(f"commands must hold at most {MOST} pairs, got more.", "commands")
    return pairs
