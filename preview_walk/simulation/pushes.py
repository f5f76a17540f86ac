"""Pushes: forces on the robot's body for a while, as a hand would."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import cos, pi, sin

import mujoco
import numpy as np

from preview_walk.arguments import (
    LARGEST,
    LARGEST_SEED,
    MOST,
    count_of,
    finite_number,
    items_of,
    number_from_zero,
    positive_number,
    real_array,
    shown,
)
from preview_walk.errors import InvalidInput
from preview_walk.types import Array

ROUNDING = 1e-9
"""The simulation's clock, a sum of many steps, may be off by this much (s)."""

LARGEST_FORCE = 1e5
"""Newtons along each axis: ten tonnes, which throw any robot; what is more is a slip, and beyond
1e8 N MuJoCo's numbers end."""


@dataclass(frozen=True)
class Push:
    """A constant force on a body.

    Attributes:
        t: when it begins (s).
        duration: how long it lasts (s); the impulse is force times duration.
        force: (x, y, z) in newtons, world axes.
        body: name of the body pushed; where it is None the base, a humanoid's pelvis: nearest to
            the CoM, so that the push moves the robot and hardly tips it. On the chest the same
            force is harder to stand up to: it has a lever about the CoM.
        point: where, in the body's own axes (m); the body's centre of mass where it is None.
    """

    t: float
    duration: float
    force: tuple[float, float, float]
    body: str | None = None
    point: tuple[float, float, float] | None = None

    def __post_init__(self) -> None:
        """Check the values, and take them as plain numbers."""
        taken: dict[str, object] = {
            "t": number_from_zero(self.t, "t", "s"),
            "duration": positive_number(self.duration, "duration", "s"),
            "force": _three(self.force, "force", LARGEST_FORCE, "N"),
        }
        if self.point is not None:
            taken["point"] = _three(self.point, "point", LARGEST, "m")
        if self.body is not None and not isinstance(self.body, str):
            raise InvalidInput(
                f"body must be the name of one or None, got {shown(self.body)}.", argument="body"
            )
        for name, value in taken.items():
            object.__setattr__(self, name, value)


def _three(value: object, name: str, most: float, unit: str) -> tuple[float, float, float]:
    """Return the three numbers of a vector, each within `most`."""
    form = f"three numbers between {-most:g} and {most:g} {unit}"
    numbers = real_array(value, name, form)
    if numbers.shape != (3,) or not np.abs(numbers).max() <= most:
        raise InvalidInput(f"{name} must be {form}, got {shown(value)}.", argument=name)
    x, y, z = numbers.tolist()
    return x, y, z


def random_pushes(
    every: float, impulse: float, duration: float, until: float, seed: int
) -> tuple[Push, ...]:
    """Return pushes on the base at regular times, horizontal, in uniformly random directions.

    Args:
        every: a push begins at each multiple of this time (s), not at 0.
        impulse: of each push (N·s).
        duration: of each push (s), at most `every`.
        until: all pushes begin before this time (s).
        seed: the same seed gives the same pushes.

    Raises:
        InvalidInput: a number that is not finite and > 0, pushes longer than `every`, a force
            beyond `LARGEST_FORCE`, or more than `MOST` pushes.
    """
    every, impulse = (
        positive_number(every, "every", "s"),
        positive_number(impulse, "impulse", "N·s"),
    )
    duration, until = positive_number(duration, "duration", "s"), finite_number(until, "until", "s")
    if duration > every:
        raise InvalidInput(
            f"every must be at least the duration of a push, {duration} s, got {every} s.",
            argument="every",
        )
    if until > MOST * every:
        raise InvalidInput(
            f"every must be at least {until / MOST:g} s, for {MOST} pushes at most, got {every} s.",
            argument="every",
        )
    force = impulse / duration
    if force > LARGEST_FORCE:
        raise InvalidInput(
            f"impulse must be at most {LARGEST_FORCE * duration:g} N·s in {duration} s, "
            f"got {impulse}.",
            argument="impulse",
        )
    random = np.random.default_rng(count_of(seed, "seed", LARGEST_SEED))
    pushes = []
    number = 1
    while number * every < until:
        angle = 2.0 * pi * random.random()
        along = (force * cos(angle), force * sin(angle), 0.0)
        pushes.append(Push(number * every, duration, along))
        number += 1
    return tuple(pushes)


def base_of(model: mujoco.MjModel) -> int:
    """Return the id of the body that floats: all others hang on it."""
    return int(model.jnt_bodyid[0])


class Pusher:
    """Applies pushes to a running simulation."""

    def __init__(
        self, model: mujoco.MjModel, pushes: Sequence[Push], base: int | None = None
    ) -> None:
        """Find the bodies that are pushed.

        Args:
            model: the world.
            pushes: forces on its bodies.
            base: id of the body that a push without a body is on; None takes the one that floats.
        """
        self._model = model
        self._base = base_of(model) if base is None else base
        self._pushes: list[tuple[Push, int, Array]] = []
        for push in items_of(pushes, Push, "pushes"):
            self.add(push)
        self._applied: Array = np.zeros(model.nv)
        self._none = np.zeros(3)

    @property
    def pushes(self) -> tuple[Push, ...]:
        """All that are applied."""
        return tuple(push for push, _, _ in self._pushes)

    def add(self, push: Push) -> None:
        """Apply one more push; raises `InvalidInput` for an unknown body."""
        model, body = self._model, self._base
        if push.body is not None:
            body = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_BODY, push.body)
        if body < 0:
            names = ", ".join(model.body(b).name for b in range(1, model.nbody))
            raise InvalidInput(
                f"a push names the body '{push.body}'; the robot has {names}.", "pushes"
            )
        self._pushes.append((push, body, np.array(push.force, dtype=float)))

    def apply(self, t: float, data: mujoco.MjData) -> Array:
        """Add the generalised forces of the pushes at time t (s); return their sum (3,) in N.

        What else is in `qfrc_applied` stays.
        """
        t += ROUNDING
        active = [p for p in self._pushes if p[0].t <= t < p[0].t + p[0].duration]
        if self._applied.any():
            data.qfrc_applied -= self._applied
            self._applied[:] = 0.0
        if not active:
            return self._none
        total = np.zeros(3)
        for push, body, force in active:
            at = data.xipos[body]
            if push.point is not None:
                at = data.xpos[body] + data.xmat[body].reshape(3, 3) @ np.array(push.point)
            mujoco.mj_applyFT(
                self._model, data, force, np.zeros(3), np.array(at), body, self._applied
            )
            total += force
        data.qfrc_applied += self._applied
        return total
