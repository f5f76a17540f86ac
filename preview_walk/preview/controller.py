"""Preview control of the ZMP: the CoM trajectory that makes a cart-table follow a ZMP reference.

One law serves the whole-trajectory call and the one-tick `PreviewController.step`. It is the
incremental form of Katayama et al. 1985 (see `preview_gains`): the jerk of the tick before takes
the place of the integral of the error, so a state holds all there is to know, the reference may
be replaced at any tick (the law is optimal for the new one from the state as it is), and
no integral needs resetting when a state is measured instead of predicted.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from preview_walk.errors import InvalidInput
from preview_walk.preview.cart_table import ComState, ComTrajectory, cart_table
from preview_walk.preview.gains import preview_gains
from preview_walk.preview.response import PreviewFilter
from preview_walk.types import Array

__all__ = ["ComState", "ComTrajectory", "PreviewController"]


class PreviewController:
    """CoM trajectories that track a ZMP reference known `preview_time` ahead (Kajita 2003).

    Attributes:
        z_c: Height of the CoM above the ground (m).
        dt: Sampling time (s).
        n_preview: Number of previewed samples N.
        design: The gains and all they were made from (`PreviewDesign`).
        window_offsets: (N,) times of a window's samples after the instant of the state (s):
            dt, 2 dt, ..., N dt.

    """

    def __init__(
        self,
        z_c: float = 0.8,
        dt: float = 0.01,
        preview_time: float = 1.0,
        *,
        q_e: float = 1.0,
        q_x: float = 0.0,
        r: float = 1e-6,
    ) -> None:
        """Design the controller.

        Args:
            z_c: Height of the CoM above the ground (m).
            dt: Sampling time (s).
            preview_time: Preview horizon (s), rounded to a whole number of samples.
            q_e: Weight of the ZMP error (1/m^2).
            q_x: Weight of the increments of [c, c', c''].
            r: Weight of the increment of the jerk; the three weights are Kajita's.

        Raises:
            InvalidInput: If a number cannot be, or if the preview time is shorter than two time
                constants sqrt(z_c / g) of the pendulum.

        """
        system = cart_table(z_c, dt)
        if not (math.isfinite(preview_time) and preview_time > 0.0):
            raise InvalidInput(
                f"expected preview_time to be a positive number of s, got {preview_time}."
            )
        self.z_c = float(z_c)
        self.dt = float(dt)
        self.n_preview = max(1, round(preview_time / dt))
        self.design = preview_gains(system, q_e, q_x, r, self.n_preview)
        self.window_offsets = self.dt * np.arange(1, self.n_preview + 1)
        self.window_offsets.flags.writeable = False

        self._filter = PreviewFilter(self.design)
        self._lever = -float(system.C[0, 2])
        self._window_gain = np.ascontiguousarray(self.design.window_gain[:, 0, 0])
        # One matrix takes the five rows of a state to the next; the ZMP row is not fed back.
        row = np.array([0.0, 0.0, 0.0, 1.0]) - self.design.feedback[0]
        step = np.zeros((5, 5))
        step[:3, :3] = system.A
        step[:3, :4] += system.B @ row[None]
        step[3, :4] = row
        step[4] = step[0] - self._lever * step[2]
        self._step = step
        b = np.append(system.B[:, 0], 1.0)
        self._step_input = np.append(b, b[0] - self._lever * b[2])[:, None]

    def initial_state(
        self,
        com: ArrayLike,
        velocity: ArrayLike = (0.0, 0.0),
        acceleration: ArrayLike = (0.0, 0.0),
        jerk: ArrayLike = (0.0, 0.0),
    ) -> ComState:
        """Return the state at which a plan starts, or one measured under way.

        Args:
            com: (2,) CoM position (m).
            velocity: (2,) CoM velocity (m/s).
            acceleration: (2,) CoM acceleration (m/s^2).
            jerk: (2,) jerk up to this instant (m/s^3); it stands for the integral of the error.

        Raises:
            InvalidInput: If one of them is not two finite numbers.

        """
        rows = []
        for name, value in (
            ("com", com),
            ("velocity", velocity),
            ("acceleration", acceleration),
            ("jerk", jerk),
        ):
            row = np.asarray(value, dtype=float)
            if row.shape != (2,) or not np.isfinite(row).all():
                raise InvalidInput(f"expected {name} to be two finite numbers, got {value!r}.")
            rows.append(row)
        return _state(np.array([*rows, rows[0] - self._lever * rows[2]]))

    def step(self, state: ComState, zmp_window: Array) -> ComState:
        """Return the state one tick (dt) later.

        Args:
            state: The state at time t.
            zmp_window: (N, 2) ZMP reference (m) at the times t + dt, t + 2 dt, ..., t + N dt,
                i.e. at t + `window_offsets`; the reference at t itself plays no part.

        Raises:
            InvalidInput: If the window has another shape or holds NaN or infinity.

        """
        try:
            action = self._window_gain @ zmp_window
            array = self._step @ state.array + self._step_input * action
            valid = action.shape == (2,) and math.isfinite(action[0] + action[1])
        except (TypeError, ValueError):
            valid = False
        if not valid:
            self._refuse_window(zmp_window)
        return _state(array)

    def interpolate(self, state: ComState, following: ComState, tau: float) -> ComState:
        """Return the exact state tau seconds after `state`, on the way to `following`.

        The jerk is constant between planning ticks, so position, velocity, acceleration and ZMP
        are polynomials; a tracker may run at any rate between the ticks.

        Args:
            state: The state at time t.
            following: The state at t + dt, from `step`.
            tau: 0 to dt (s).

        Raises:
            InvalidInput: If tau is outside [0, dt].

        """
        if not 0.0 <= tau <= self.dt * (1.0 + 1e-9):
            raise InvalidInput(f"expected tau to be 0 to {self.dt} s, got {tau}.")
        (cx, cy), (vx, vy), (ax, ay), _, _ = state.array.tolist()
        jx, jy = following.array[3].tolist()
        half, sixth = 0.5 * tau, tau / 3.0
        bx, by = ax + tau * jx, ay + tau * jy
        px = cx + tau * (vx + half * (ax + sixth * jx))
        py = cy + tau * (vy + half * (ay + sixth * jy))
        return _state(
            np.array(
                (
                    (px, py),
                    (vx + tau * (ax + half * jx), vy + tau * (ay + half * jy)),
                    (bx, by),
                    (jx, jy),
                    (px - self._lever * bx, py - self._lever * by),
                )
            )
        )

    def trajectory(
        self,
        zmp_ref: ArrayLike,
        x0: ArrayLike | ComState | None = None,
        *,
        t: ArrayLike | None = None,
    ) -> ComTrajectory:
        """Return CoM and ZMP over a whole ZMP reference: `step` run over it, vectorised.

        Args:
            zmp_ref: (N,) or (N, 2) ZMP reference (m), sampled at dt; past its end it is held at
                its last value.
            x0: Where the CoM starts. None: at rest above the first reference sample. One axis: a
                position (m) or [c, c', c'']. Two axes: (2,) positions, (2, 3) with a row
                [c, c', c''] for each axis, or a `ComState`, whose jerk then counts too.
            t: (N,) times of the reference samples (s), only to check that they are dt apart.

        Raises:
            InvalidInput: If a shape is wrong, a value not finite, or t not in steps of dt.

        """
        reference = np.asarray(zmp_ref, dtype=float)
        if (
            reference.ndim not in (1, 2)
            or len(reference) < 1
            or reference.shape[1:]
            not in (
                (),
                (2,),
            )
        ):
            raise InvalidInput(
                f"expected zmp_ref of shape (N,) or (N, 2) with N >= 1, got {reference.shape}."
            )
        if not np.isfinite(reference).all():
            raise InvalidInput("expected a finite zmp_ref, got NaN or infinity.")
        axes = reference.reshape(len(reference), -1).T
        if t is not None:
            self._check_times(np.asarray(t, dtype=float), len(reference))
        # The law does not care where the origin is; numbers near zero lose fewer digits.
        origin = axes[:, 0].copy()
        start = self._start(x0, origin)
        start[:, 0] -= origin
        states = self._filter.run((axes - origin[:, None])[:, None], start)
        com, velocity, acceleration, jerk = np.ascontiguousarray(states.T).reshape(
            (4, *reference.shape)
        )
        com += origin if len(axes) == 2 else origin[0]
        zmp = com - self._lever * acceleration
        return ComTrajectory(self.dt, com, velocity, acceleration, jerk, zmp)

    def generate_com_trajectory(
        self,
        zmp_ref: ArrayLike,
        x0: ArrayLike | ComState | None = None,
        *,
        t: ArrayLike | None = None,
    ) -> tuple[Array, Array]:
        """Return CoM position (m) and velocity (m/s), each of the shape of zmp_ref.

        The lab's call; `trajectory` takes the same arguments and also returns acceleration,
        jerk and ZMP.
        """
        result = self.trajectory(zmp_ref, x0, t=t)
        return result.com, result.velocity

    def _start(self, x0: ArrayLike | ComState | None, first: Array) -> Array:
        """Return [c, c', c'', jerk before] for each axis, (axes, 4)."""
        axes = len(first)
        if isinstance(x0, ComState):
            if axes != 2:
                raise InvalidInput(
                    "expected a ComState to start a zmp_ref of shape (N, 2), got one axis."
                )
            return np.array(x0.array[:4].T)
        start = np.zeros((axes, 4))
        values = first if x0 is None else np.asarray(x0, dtype=float)
        shapes = ((), (1,), (3,), (1, 3)) if axes == 1 else ((2,), (2, 3))
        if values.shape not in shapes or not np.isfinite(values).all():
            allowed = "a number or [c, c', c'']" if axes == 1 else "of shape (2,) or (2, 3)"
            raise InvalidInput(f"expected x0 to be finite and {allowed}, got {x0!r}.")
        if values.shape in ((), (1,), (2,)):
            start[:, 0] = values
        else:
            start[:, :3] = values
        return start

    def _check_times(self, t: Array, length: int) -> None:
        if t.shape != (length,):
            raise InvalidInput(f"expected t of shape ({length},), got {t.shape}.")
        steps = np.diff(t)
        if length > 1 and not np.abs(steps - self.dt).max() <= 1e-6 * self.dt:
            raise InvalidInput(
                f"expected zmp_ref sampled every {self.dt:g} s, the dt of the controller, got "
                f"samples {steps.min():g} to {steps.max():g} s apart."
            )

    def _refuse_window(self, window: Array) -> None:
        shape = np.shape(window)
        if shape != (self.n_preview, 2):
            raise InvalidInput(f"expected zmp_window of shape ({self.n_preview}, 2), got {shape}.")
        raise InvalidInput("expected a finite zmp_window, got NaN or infinity.")


def _state(array: Array) -> ComState:
    array.flags.writeable = False
    return ComState(array)
