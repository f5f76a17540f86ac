"""A contact-aided invariant Kalman filter for the pose and velocity of a legged robot's base.

The right-invariant extended Kalman filter of Hartley, Ghaffari, Eustice and Grizzle (IJRR 2020).
The state is a rotation R, a velocity v, a position p and the places d of both soles, all in the
world, on the group SE_4(3), and the biases of gyro and accelerometer beside it. With the error

    X = exp(e) X^,   b = b^ + e_b

the linearised dynamics (eq. 52) and the contact's measurement do not depend on the state but
through the biases, so that a wrong start converges. Order of e: rotation, velocity, position, left
and right sole, gyro bias, accelerometer bias, three numbers each.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import cos, sin, sqrt

import numpy as np
from scipy.linalg.lapack import dposv

from preview_walk.constants import GRAVITY
from preview_walk.types import Array

SIZE = 21
"""Numbers of the error."""

_R, _V, _P, _LEFT, _RIGHT, _G, _A = (slice(3 * k, 3 * k + 3) for k in range(7))
_SOLES = (_LEFT, _RIGHT)
_I3 = np.eye(3)

# Four vectors become four matrices of the cross product, one below the other: entry _SKEW of the
# (12, 3) is _SKEW_SIGN times entry _SKEW_OF of the (4, 3).
_ONE = ((1, 2, -1.0), (2, 1, 1.0), (3, 2, 1.0), (5, 0, -1.0), (6, 1, -1.0), (7, 0, 1.0))
_SKEW = np.array([9 * k + at for k in range(4) for at, _, _ in _ONE])
_SKEW_OF = np.array([3 * k + of for k in range(4) for _, of, _ in _ONE])
_SKEW_SIGN = np.array([sign for _ in range(4) for _, _, sign in _ONE])

ROWS = 11
"""Numbers of a measurement: both soles' places, the ground's heights under them, a turning rate."""

UNSEEN = 1e6
"""Variance of what was not measured."""

BEARS = 0.3
"""Below this share of the weight a sole rolls and slides, the more the less it bears."""

FREE = 1.0
"""A sole without load moves as it likes: standard deviation of its place, m per square root of a
second."""

OUTLIER = 4.0
"""A sole that is further than so many standard deviations from where it stood has slipped."""


@dataclass(frozen=True)
class FilterNoise:
    """What the filter takes its signals for; standard deviations.

    Attributes:
        gyro: of the mean of a tick's turning rate, rad/s.
        accelerometer: of the mean of a tick's specific force, m/s^2.
        gyro_walk, accelerometer_walk: of the biases, rad/s and m/s^2 per square root of a second.
        gyro_bias, accelerometer_bias: of the biases at first, rad/s, m/s^2.
        contact: of the place of a sole that stands, m per square root of a second.
        turn: of the base's turning rate as the standing leg has it, rad/s.
        leg: of a sole's place as encoders and leg give it, m.
        ground: of the height of known ground under a sole, m.
    """

    gyro: float
    accelerometer: float
    gyro_walk: float
    accelerometer_walk: float
    gyro_bias: float
    accelerometer_bias: float
    contact: float
    turn: float
    leg: float
    ground: float


def rotation_of(angle: Array) -> tuple[Array, Array]:
    """Return exp of a rotation vector (3,), rad, and its left Jacobian (3, 3)."""
    x, y, z = angle.tolist()
    square = x * x + y * y + z * z
    k = np.array(((0.0, -z, y), (z, 0.0, -x), (-y, x, 0.0)))
    if square < 1e-10:
        return _I3 + k + 0.5 * (k @ k), _I3 + 0.5 * k
    norm = sqrt(square)
    s, c = sin(norm) / norm, (1.0 - cos(norm)) / square
    kk = k @ k
    return _I3 + s * k + c * kk, _I3 + c * k + ((1.0 - s) / square) * kk


class BaseFilter:
    """The filter; what it believes is in its attributes.

    Attributes:
        noise: what it takes its signals for.
        rotation: (3, 3) from the base's axes to the world's.
        vectors: (4, 3) velocity (m/s) and position (m) of the base, places of the left and the
            right sole (m), in the world.
        gyro_bias, accelerometer_bias: (3,) in the base's axes, rad/s, m/s^2.
        covariance: (21, 21) of the error.
    """

    def __init__(
        self, noise: FilterNoise, rotation: Array, position: Array, soles: Array, tilt: float
    ) -> None:
        """Begin at rest in a place that is known.

        Args:
            noise: of the signals.
            rotation: (3, 3) of the base.
            position: (3,) of the base, world, m.
            soles: (2, 3) places of the soles, world, m.
            tilt: standard deviation of roll and pitch (rad), and of the velocity (m/s).
        """
        self.noise = noise
        self.rotation = np.array(rotation, dtype=float)
        self.vectors = np.vstack((np.zeros(3), position, soles))
        self.gyro_bias, self.accelerometer_bias = np.zeros(3), np.zeros(3)
        spread = np.full(SIZE, 1e-6)
        spread[:2], spread[2], spread[_V] = tilt**2, 1e-8, tilt**2
        spread[_G], spread[_A] = noise.gyro_bias**2, noise.accelerometer_bias**2
        self.covariance = np.diag(spread)
        self._flow, self._skews = np.eye(SIZE), np.zeros((12, 3))
        self._look = np.zeros((ROWS, SIZE))
        for k, sole in enumerate(_SOLES):
            self._look[3 * k : 3 * k + 3, sole] = _I3
            self._look[3 * k : 3 * k + 3, _P] = -_I3
            self._look[6 + k, sole.start + 2] = 1.0
        self._look[8:, _G] = _I3
        self._unseen = np.full(ROWS, UNSEEN)

    @property
    def velocity(self) -> Array:
        """(3,) of the base's origin, world, m/s."""
        value: Array = self.vectors[0]
        return value

    @property
    def position(self) -> Array:
        """(3,) of the base's origin, world, m."""
        value: Array = self.vectors[1]
        return value

    def predict(self, gyro: Array, accelerometer: Array, dt: float) -> None:
        """Go on by a time dt (s); `spread` tells by how much less is known then.

        Args:
            gyro: (3,) mean turning rate measured meanwhile, base axes, rad/s.
            accelerometer: (3,) mean specific force, base axes, m/s^2.
            dt: s.
        """
        turn, bend = rotation_of((gyro - self.gyro_bias) * dt)
        # The specific force turns with the base meanwhile: `bend` is the mean of that turn.
        change = self.rotation @ (bend @ (accelerometer - self.accelerometer_bias)) * dt
        change[2] -= GRAVITY * dt
        self.vectors[1] += dt * (self.vectors[0] + 0.5 * change)
        self.vectors[0] += change
        self.rotation = self.rotation @ turn

    def spread(self, dt: float, steps: int, loads: Sequence[float]) -> None:
        """Carry the covariance on by dt (s): F P F' + Q, to first order in dt.

        Args:
            dt: of all steps since the last time, s.
            steps: of `predict` in that time, each with noise of its own.
            loads: share of the weight on each sole: what bears nothing may move.
        """
        noise, f = self.noise, self._flow
        # e_v' = g x e_R and e_p' = e_v; the biases come in through the adjoint.
        f[3, 1], f[4, 0] = GRAVITY * dt, -GRAVITY * dt
        f[6, 3] = f[7, 4] = f[8, 5] = dt
        turn = -dt * self.rotation
        f[_R, _G] = f[_V, _A] = turn
        self._skews.reshape(-1)[_SKEW] = self.vectors.reshape(-1)[_SKEW_OF] * _SKEW_SIGN
        f[3:15, _G] = self._skews @ turn
        p = f @ self.covariance @ f.T
        gyro = f[:15, _G]
        p[:15, :15] += (noise.gyro**2 / steps) * (gyro @ gyro.T)
        more = np.zeros(SIZE)
        more[_V] = (noise.accelerometer * dt) ** 2 / steps
        for sole, load in zip(_SOLES, loads, strict=True):
            more[sole] = self._wander(load) ** 2 * dt
        more[_G], more[_A] = noise.gyro_walk**2 * dt, noise.accelerometer_walk**2 * dt
        p.reshape(-1)[:: SIZE + 1] += more
        self.covariance = p

    def _wander(self, load: float) -> float:
        """Return how far a sole wanders that bears this share of the weight, m/sqrt(s)."""
        if load >= BEARS:
            return self.noise.contact
        return min(FREE, self.noise.contact * (BEARS / max(load, 1e-3)) ** 2)

    def correct(
        self,
        legs: Array,
        heights: Sequence[float | None],
        turns: Sequence[Array] = (),
    ) -> None:
        """Take in where the legs say that the soles are, and how the base turns over them.

        A sole is no point: it does not turn where it stands, so that the base turns as the leg's
        joints say, and the gyro's bias shows. Without this the bias about the vertical shows only
        while both soles stand.

        Args:
            legs: (2, 3) places of the soles from the base's origin, base axes, m.
            heights: of the ground under each sole where it is known and stood on, m, or None.
            turns: (3,) each: by how much the gyro measured more than the base's turning rate as
                the joints of a standing leg have it, base axes, rad/s, at each tick since the last
                correction at which one leg stood alone.
        """
        p, vectors, look = self.covariance, self.vectors, self._look
        innovation, spread = np.zeros(ROWS), self._unseen.copy()
        innovation[:6] = (legs @ self.rotation.T - vectors[2:] + vectors[1]).reshape(6)
        spread[:6] = self.noise.leg**2
        for k, sole in enumerate(_SOLES):
            self._let_go(sole, innovation[3 * k : 3 * k + 3])
            x, y, z = vectors[2 + k].tolist()
            look[6 + k, 0], look[6 + k, 1] = y, -x
            height = heights[k]
            if height is not None:
                innovation[6 + k], spread[6 + k] = height - z, self.noise.ground**2
        if turns:
            innovation[8:] = np.mean(turns, axis=0) - self.gyro_bias
            spread[8:] = self.noise.turn**2 / len(turns)
        seen = p @ look.T
        s = look @ seen
        s.reshape(-1)[:: ROWS + 1] += spread
        _, gain, failed = dposv(s, seen.T)
        if failed:  # s is positive definite but for rounding, which this solver does not mind
            gain = np.linalg.solve(s, seen.T)
        p = p - seen @ gain
        self.covariance = 0.5 * (p + p.T)
        self._move(innovation @ gain)

    def _let_go(self, sole: slice, innovation: Array) -> None:
        """Let a sole's place be free where it is too far from where it stood: it has slipped."""
        p = self.covariance
        d = p.reshape(-1)[:: SIZE + 1]
        square = float(innovation @ innovation)
        cross = float(p[sole, _P].trace())
        if square > OUTLIER**2 * (
            float(d[sole].sum() + d[_P].sum()) - 2.0 * cross + 3.0 * self.noise.leg**2
        ):
            d[sole] += square

    def _move(self, step: Array) -> None:
        """Apply a correction (21,) of the error."""
        turn, bend = rotation_of(step[_R])
        self.rotation = turn @ self.rotation
        self.vectors = self.vectors @ turn.T + step[3:15].reshape(4, 3) @ bend.T
        self.gyro_bias = self.gyro_bias + step[_G]
        self.accelerometer_bias = self.accelerometer_bias + step[_A]

    def error(self, rotation: Array, velocity: Array, position: Array) -> Array:
        """Return the error (9,) of rotation, velocity and position against the truth.

        It is that whose covariance is `covariance[:9, :9]`, to first order.
        """
        turn = rotation @ self.rotation.T
        angle = 0.5 * np.array(
            (turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0], turn[1, 0] - turn[0, 1])
        )
        moved = np.array((velocity, position)) - self.vectors[:2] @ turn.T
        return np.concatenate((angle, moved.reshape(6)))
