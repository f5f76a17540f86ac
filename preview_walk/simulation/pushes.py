"""Pushes: forces on the robot's body for a while, as a hand would."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import cos, isfinite, pi, sin

import mujoco
import numpy as np

from preview_walk.errors import InvalidInput
from preview_walk.types import Array

ROUNDING = 1e-9
"""The simulation's clock, a sum of many steps, may be off by this much (s)."""


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
        """Check the numbers."""
        if not (isfinite(self.t) and self.t >= 0.0):
            raise InvalidInput(f"a push must begin at a time >= 0 s, got {self.t}.")
        if not (isfinite(self.duration) and self.duration > 0.0):
            raise InvalidInput(f"a push must last > 0 s, got {self.duration}.")
        for name in ("force", "point"):
            vector = getattr(self, name)
            if vector is None and name == "point":
                continue
            if len(vector) != 3 or not all(isfinite(x) for x in vector):
                raise InvalidInput(f"the {name} of a push must be three finite numbers.")


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
        InvalidInput: a number that is not finite and > 0, or pushes longer than `every`.
    """
    for name, value in (("every", every), ("impulse", impulse), ("duration", duration)):
        if not (isfinite(value) and value > 0.0):
            raise InvalidInput(f"{name} must be finite and > 0, got {value}.")
    if not isfinite(until):
        raise InvalidInput(f"until must be finite (s), got {until}.")
    if duration > every:
        raise InvalidInput(
            f"every must be at least the duration of a push, {duration} s, got {every} s."
        )
    random = np.random.default_rng(seed)
    force = impulse / duration
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

    def __init__(self, model: mujoco.MjModel, pushes: Sequence[Push]) -> None:
        self._model = model
        self._pushes = []
        for push in pushes:
            body = base_of(model)
            if push.body is not None:
                body = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_BODY, push.body)
            if body < 0:
                names = ", ".join(model.body(b).name for b in range(1, model.nbody))
                raise InvalidInput(
                    f"a push names the body '{push.body}'; the robot has {names}.",
                    argument="pushes",
                )
            self._pushes.append((push, body, np.array(push.force, dtype=float)))
        self._idle = True
        self._none = np.zeros(3)

    def apply(self, t: float, data: mujoco.MjData) -> Array:
        """Write the generalised forces of the pushes at time t (s); return their sum (3,) in N."""
        t += ROUNDING
        active = [p for p in self._pushes if p[0].t <= t < p[0].t + p[0].duration]
        if not active:
            if not self._idle:
                data.qfrc_applied[:] = 0.0
                self._idle = True
            return self._none
        self._idle = False
        data.qfrc_applied[:] = 0.0
        total = np.zeros(3)
        for push, body, force in active:
            at = data.xipos[body]
            if push.point is not None:
                at = data.xpos[body] + data.xmat[body].reshape(3, 3) @ np.array(push.point)
            mujoco.mj_applyFT(
                self._model, data, force, np.zeros(3), np.array(at), body, data.qfrc_applied
            )
            total += force
        return total
