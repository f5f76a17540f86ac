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

from preview_walk.arguments import shown
from preview_walk.errors import InvalidInput
from preview_walk.preview.cart_table import ComState, ComTrajectory, coasted, sampled_cart_table
from preview_walk.preview.checks import positive, read_only, real_array, require_type
from preview_walk.preview.design import PreviewDesign
from preview_walk.preview.gains import preview_gains
from preview_walk.preview.horizon import MAX_HORIZON
from preview_walk.preview.lab_names import LabNames
from preview_walk.preview.response import PreviewFilter
from preview_walk.preview.zmp_input import check_times, read_zmp_reference, start_rows, two_numbers
from preview_walk.types import Array

__all__ = ["ComState", "ComTrajectory", "PreviewController"]


class PreviewController(LabNames):
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
            InvalidInput: If a number cannot be.

        Warns:
            ShortHorizonWarning: If the preview time is shorter than two time constants
                sqrt(z_c / g) of the pendulum.

        """
        dt = positive("dt", dt, "s")
        plant = sampled_cart_table(z_c, dt)
        preview_time = positive("preview_time", preview_time, "s")
        if not preview_time / dt <= MAX_HORIZON:
            raise InvalidInput(
                f"expected preview_time to be at most {MAX_HORIZON} samples of dt = {dt:g} s, got "
                f"{preview_time:g} s.",
                argument="preview_time",
            )
        self.z_c = float(z_c)
        self.dt = dt
        self.n_preview = max(1, round(preview_time / dt))
        try:
            design = preview_gains(plant, q_e, q_x, r, self.n_preview)
        except InvalidInput as error:
            names = {"Q_e": "q_e", "Q_x": "q_x", "R": "r"}
            argument = names.get(error.argument or "", error.argument)
            raise InvalidInput(str(error), argument=argument) from error
        self._prepare(design)

    def __repr__(self) -> str:
        return f"PreviewController(z_c={self.z_c}, dt={self.dt}, n_preview={self.n_preview})"

    def __reduce__(self) -> tuple[object, ...]:
        """Pickle the design; the filter and the matrices of a tick follow from it."""
        return _restored, (type(self), self.z_c, self.dt, self.design)

    def _prepare(self, design: PreviewDesign) -> None:
        """Make ready what a tick and a whole trajectory need of a design."""
        self.design = design
        self.window_offsets = read_only(
            self.dt * np.arange(1, self.n_preview + 1, dtype=np.float64)
        )
        plant = design.plant
        self._filter = PreviewFilter(self.design)
        self._lever = -float(plant.C[0, 2])
        self._window_gain = np.ascontiguousarray(self.design.window_gain[:, 0, 0])
        # One matrix takes the five rows of a state to the next; the ZMP row is not fed back.
        row = np.array([0.0, 0.0, 0.0, 1.0]) - self.design.feedback[0]
        step = np.zeros((5, 5))
        step[:3, :3] = plant.A
        step[:3, :4] += plant.B @ row[None]
        step[3, :4] = row
        step[4] = step[0] - self._lever * step[2]
        self._step = step
        b = np.append(plant.B[:, 0], 1.0)
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
        parts = (
            ("com", com),
            ("velocity", velocity),
            ("acceleration", acceleration),
            ("jerk", jerk),
        )
        rows = [two_numbers(name, value) for name, value in parts]
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
        except (AttributeError, TypeError, ValueError, OverflowError):
            valid = False
        if not valid:
            self._refuse_step(state, zmp_window)
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
        try:
            inside = 0.0 <= tau <= self.dt * (1.0 + 1e-9)
            jerk = following.array[3]
            between = coasted(state, jerk, tau, self._lever) if inside else state
        except (AttributeError, TypeError, ValueError):
            require_type("state", state, ComState)
            require_type("following", following, ComState)
            inside = False
        if not inside:
            raise InvalidInput(
                f"expected tau to be 0 to {self.dt} s, got {shown(tau)}.", argument="tau"
            )
        return between

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
        reference = read_zmp_reference(zmp_ref)
        axes = reference.reshape(len(reference), -1).T
        if t is not None:
            check_times(t, len(reference), self.dt)
        # The law does not care where the origin is; numbers near zero lose fewer digits.
        origin = axes[:, 0].copy()
        start = start_rows(x0, origin)
        start[:, 0] -= origin
        states, _ = self._filter.run((axes - origin[:, None])[:, None], start)
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

        The lab's call; `trajectory` also returns acceleration, jerk and ZMP.

        Args:
            zmp_ref: (N,) or (N, 2) ZMP reference (m), as for `trajectory`.
            x0: Where the CoM starts, as for `trajectory`.
            t: (N,) times of the reference samples (s), as for `trajectory`.

        Raises:
            InvalidInput: If a shape is wrong, a value not finite, or t not in steps of dt.

        """
        result = self.trajectory(zmp_ref, x0, t=t)
        return result.com, result.velocity

    def _refuse_step(self, state: ComState, window: Array) -> None:
        require_type("state", state, ComState)
        shape = real_array("zmp_window", window).shape
        if shape != (self.n_preview, 2):
            raise InvalidInput(
                f"expected zmp_window of shape ({self.n_preview}, 2), got {shape}.",
                argument="zmp_window",
            )
        raise InvalidInput(
            "expected a finite zmp_window, got NaN or infinity.", argument="zmp_window"
        )


def _state(array: Array) -> ComState:
    array.flags.writeable = False
    return ComState(array)


def _restored(
    cls: type[PreviewController], z_c: float, dt: float, design: PreviewDesign
) -> PreviewController:
    """Return a pickled controller as it was."""
    controller = cls.__new__(cls)
    controller.z_c, controller.dt, controller.n_preview = z_c, dt, design.horizon
    controller._prepare(design)
    return controller
