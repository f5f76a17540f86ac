"""The cart-table model of walking: a point mass at constant height; its state and its motion.

State of one axis: x = [c, c', c''], the position (m), velocity (m/s) and acceleration (m/s^2) of
the CoM. Input: jerk u = c''' (m/s^3), constant over one sample. Output: the ZMP

    p = c - (z_c / g) c''    (m)

(Kajita et al., "Biped walking pattern generation by using preview control of zero-moment point",
ICRA 2003, the cart-table model).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from preview_walk.constants import GRAVITY
from preview_walk.errors import InvalidInput
from preview_walk.preview.checks import positive, read_only
from preview_walk.preview.plant import Plant, as_state_space
from preview_walk.types import Array

if TYPE_CHECKING:
    import control

STATES, INPUTS, OUTPUTS = ("com", "velocity", "acceleration"), ("jerk",), ("zmp",)
"""Names of the cart-table's signals."""


@dataclass(frozen=True, eq=False)
class ComState:
    """The CoM of a cart-table at one instant, both axes.

    `PreviewController.initial_state` makes the first one.

    Attributes:
        array: (5, 2) read-only; rows: position, velocity, acceleration, jerk and ZMP, columns: x
            and y, in the frame of the ZMP reference. The jerk (m/s^3) is the one that led here:
            constant over the tick before this instant.

    """

    array: Array

    def __reduce__(self) -> tuple[object, ...]:
        """Pickle so that the array is read-only again afterwards."""
        return _locked, (self.array,)

    def __repr__(self) -> str:
        numbers = (f"[{row[0]:.4g}, {row[1]:.4g}]" for row in self.array[[0, 1, 4]])
        return "ComState(com {} m, velocity {} m/s, zmp {} m)".format(*numbers)

    @property
    def com(self) -> Array:
        """(2,) CoM position (m)."""
        row: Array = self.array[0]
        return row

    @property
    def velocity(self) -> Array:
        """(2,) CoM velocity (m/s)."""
        row: Array = self.array[1]
        return row

    @property
    def acceleration(self) -> Array:
        """(2,) CoM acceleration (m/s^2)."""
        row: Array = self.array[2]
        return row

    @property
    def jerk(self) -> Array:
        """(2,) CoM jerk over the tick before (m/s^3)."""
        row: Array = self.array[3]
        return row

    @property
    def zmp(self) -> Array:
        """(2,) ZMP of the model, c - (z_c / g) c'' (m)."""
        row: Array = self.array[4]
        return row


@dataclass(frozen=True, eq=False)
class ComTrajectory:
    """CoM and ZMP over a whole reference; sample k is the time k dt.

    Each array has the shape of the ZMP reference it came from, (N,) for one axis or (N, 2).

    Attributes:
        dt: Sampling time (s).
        com: CoM position (m).
        velocity: CoM velocity (m/s).
        acceleration: CoM acceleration (m/s^2).
        jerk: CoM jerk (m/s^3), constant over the tick before sample k, as in `ComState`.
        zmp: ZMP of the model (m).

    """

    dt: float
    com: Array
    velocity: Array
    acceleration: Array
    jerk: Array
    zmp: Array

    def __repr__(self) -> str:
        return f"ComTrajectory({len(self.com)} samples of {self.dt} s, {self.com.ndim} axes)"


def coasted(state: ComState, jerk: Array, tau: float, lever: float) -> ComState:
    """Return the exact state tau (s) after `state` with the jerk held: all are polynomials.

    Args:
        state: of the cart-table.
        jerk: (2,) m/s^3.
        tau: s.
        lever: z_c / g, s^2.
    """
    (cx, cy), (vx, vy), (ax, ay), _, _ = state.array.tolist()
    jx, jy = jerk.tolist()
    half, sixth = 0.5 * tau, tau / 3.0
    bx, by = ax + tau * jx, ay + tau * jy
    px = cx + tau * (vx + half * (ax + sixth * jx))
    py = cy + tau * (vy + half * (ay + sixth * jy))
    rows = (
        (px, py),
        (vx + tau * (ax + half * jx), vy + tau * (ay + half * jy)),
        (bx, by),
        (jx, jy),
        (px - lever * bx, py - lever * by),
    )
    return _locked(np.array(rows))


def _locked(array: Array) -> ComState:
    """Return the state of an array, made read-only."""
    return ComState(read_only(array))


def natural_frequency(z_c: float, gravity: float = GRAVITY) -> float:
    """Return omega = sqrt(g / z_c) in rad/s, the rate at which a cart-table falls.

    The slowest mode of a preview controller of the cart-table with a cheap jerk is
    exp(-omega dt): 1 / omega is the time constant that a preview horizon has to cover.

    Args:
        z_c: Height of the CoM above the ZMP (m).
        gravity: Acceleration of gravity (m/s^2).

    Raises:
        InvalidInput: If one of them is not a positive, finite number.

    """
    return math.sqrt(positive("gravity", gravity, "m/s^2") / positive("z_c", z_c, "m"))


def transition(tau: float) -> tuple[Array, Array]:
    """Return (A, B) of x(t + tau) = A x(t) + B u for a jerk u that is constant in between.

    Args:
        tau: Time (s); the matrices are exact for every tau, negative ones included.

    Returns:
        A (3, 3) and B (3, 1).

    """
    a = np.array([[1.0, tau, tau * tau / 2.0], [0.0, 1.0, tau], [0.0, 0.0, 1.0]])
    b = np.array([[tau**3 / 6.0], [tau * tau / 2.0], [tau]])
    return a, b


def zmp_output(z_c: float, gravity: float = GRAVITY) -> Array:
    """Return C = [1, 0, -z_c / g], (1, 3), the row that reads the ZMP (m) from x.

    Args:
        z_c: Height of the CoM above the ZMP (m).
        gravity: Acceleration of gravity (m/s^2).

    Raises:
        InvalidInput: If one of them is not a positive, finite number.

    """
    lever = positive("z_c", z_c, "m") / positive("gravity", gravity, "m/s^2")
    return np.array([[1.0, 0.0, -lever]])


def sampled_cart_table(z_c: float, dt: float, gravity: float = GRAVITY) -> Plant:
    """Return the cart-table of one axis as a `Plant`.

    Args:
        z_c: Height of the CoM above the ZMP (m).
        dt: Sampling time (s) of the exact zero-order hold of the jerk.
        gravity: Acceleration of gravity (m/s^2).

    Returns:
        A plant with states [c, c', c''], input jerk and output ZMP, sampled at dt.

    Raises:
        InvalidInput: If z_c, dt or gravity is not a positive, finite number.

    """
    dt = positive("dt", dt, "s")
    try:
        a, b = transition(dt)
    except OverflowError:
        raise InvalidInput(
            f"expected dt whose third power is a number, got {dt:g} s.", argument="dt"
        ) from None
    output = zmp_output(z_c, gravity)
    return Plant(
        a, b, output, np.zeros((1, 1)), np.zeros((3, 0)), dt, STATES, INPUTS, OUTPUTS, (),
        "cart_table",
    )  # fmt: skip


def cart_table(
    z_c: float = 0.8, dt: float | None = None, gravity: float = GRAVITY
) -> control.StateSpace:
    """Return the cart-table of one axis as a `control.StateSpace`.

    Args:
        z_c: Height of the CoM above the ZMP (m).
        dt: Sampling time (s) of the exact zero-order hold of the jerk; None for the
            continuous-time model.
        gravity: Acceleration of gravity (m/s^2).

    Returns:
        A system with states [c, c', c''], input jerk and output ZMP, sampled at dt.

    Raises:
        InvalidInput: If z_c, dt or gravity is not a positive, finite number.

    """
    import control

    if dt is not None:
        return as_state_space(sampled_cart_table(z_c, dt, gravity))
    return control.StateSpace(
        np.eye(3, k=1),
        np.array([[0.0], [0.0], [1.0]]),
        zmp_output(z_c, gravity),
        np.zeros((1, 1)),
        0.0,
        states=list(STATES),
        inputs=list(INPUTS),
        outputs=list(OUTPUTS),
        name="cart_table",
    )
