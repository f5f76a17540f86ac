"""A linear plant as plain matrices, read from whatever `control` or a paper calls a system.

    x(k+1) = A x(k) + B u(k) + E w(k),    y(k) = C x(k) + D u(k)

with n states, m inputs, p outputs and q disturbances w that are known ahead.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from preview_walk.arguments import shown
from preview_walk.errors import InvalidInput
from preview_walk.preview.checks import Value, positive, real_array
from preview_walk.types import Array

if TYPE_CHECKING:
    import control


@dataclass(frozen=True, eq=False)
class Plant(Value):
    """A discrete-time plant; all arrays are read-only and belong to nobody else.

    Attributes:
        A: (n, n) state matrix.
        B: (n, m) input matrix.
        C: (p, n) output matrix.
        D: (p, m) direct feedthrough.
        E: (n, q) disturbance matrix; q = 0 where no disturbance is previewed.
        dt: Sampling time (s); True where it is not specified and time counts in samples.
        states: Names of the states.
        inputs: Names of the inputs.
        outputs: Names of the outputs.
        disturbances: Names of the disturbances.
        name: Name of the system.

    """

    A: Array
    B: Array
    C: Array
    D: Array
    E: Array
    dt: float | bool
    states: tuple[str, ...]
    inputs: tuple[str, ...]
    outputs: tuple[str, ...]
    disturbances: tuple[str, ...]
    name: str

    def __repr__(self) -> str:
        n, m = self.B.shape
        sizes = f"{n} states, {m} inputs, {len(self.C)} outputs, {self.E.shape[1]} disturbances"
        return f"Plant({self.name}: {sizes}, dt = {self.dt})"


Linear = Any
"""A `control.StateSpace`, a `control.TransferFunction`, (A, B, C, D) or (A, B, C, D, dt)."""


def read_plant(system: Linear, dt: float | None = None, E: ArrayLike | None = None) -> Plant:
    """Return the discrete-time plant that a description of a linear system means.

    Args:
        system: A `control.StateSpace`, a `control.TransferFunction` or a `Plant`; or matrices (A,
            B, C, D) of a discrete-time plant; or (A, B, C, D, dt) as `control.ss` takes them, with
            dt = 0 for a continuous-time one.
        dt: Sampling time (s) at which a continuous-time plant is discretised by `control.c2d`, u
            and w held over a sample; or the sampling time of (A, B, C, D), not specified when
            None or True.
        E: (n, q) disturbance matrix, or (n,) for one disturbance; none when None.

    Raises:
        InvalidInput: If it is none of these, not finite, or its sampling time cannot be.

    """
    if dt is not None and dt is not True:
        dt = positive("dt", dt, "s")
    if isinstance(system, Plant) and dt is None and E is None:
        return system
    space = _state_space(system, dt)
    if not all(np.isfinite(part).all() for part in (space.A, space.B, space.C, space.D)):
        raise InvalidInput(
            "expected finite system matrices, got NaN or infinity in A, B, C or D.",
            argument="system",
        )
    e = _disturbance_matrix(E, space.nstates)
    if space.dt == 0:
        space, e = _discretised(space, e, dt)
    elif dt is not None and space.dt is not True and abs(space.dt - dt) > 1e-12 * dt:
        raise InvalidInput(
            f"expected dt to be the system's own, {space.dt} s, or None, got {dt} s.",
            argument="dt",
        )
    a, b, c, d, e = (
        np.array(part, dtype=float) for part in (space.A, space.B, space.C, space.D, e)
    )
    return Plant(
        a, b, c, d, e, dt if dt is not None and space.dt is True else space.dt,
        tuple(space.state_labels), tuple(space.input_labels), tuple(space.output_labels),
        tuple(f"disturbance[{i}]" for i in range(e.shape[1])), space.name,
    )  # fmt: skip


def as_state_space(plant: Plant) -> control.StateSpace:
    """Return the plant from u to y as a `control.StateSpace`, with its names."""
    import control

    space = control.StateSpace(
        plant.A,
        plant.B,
        plant.C,
        plant.D,
        plant.dt,
        states=list(plant.states),
        inputs=list(plant.inputs),
        outputs=list(plant.outputs),
        name=plant.name,
        remove_useless_states=False,
    )
    space.A, space.B, space.C, space.D = plant.A, plant.B, plant.C, plant.D
    return space


def _state_space(system: Linear, dt: float | None) -> control.StateSpace:
    """Return the system as a state space with a time base."""
    import control

    if isinstance(system, control.StateSpace):
        space = system
    elif isinstance(system, control.TransferFunction):
        try:
            space = _realised(system)
        except ValueError as error:
            raise InvalidInput(
                "expected a transfer function with a state space, got one with more zeros than "
                "poles.",
                argument="system",
            ) from error
    elif isinstance(system, tuple | list) and len(system) in (4, 5):
        base = _time_base(system[4]) if len(system) == 5 else (True if dt is None else dt)
        parts = [real_array("system", part, "matrices A, B, C, D") for part in system[:4]]
        try:
            # Useless states are the caller's own: a state without effect keeps its place.
            space = control.StateSpace(*parts, base, remove_useless_states=False)
        except (ValueError, TypeError, IndexError) as error:
            raise InvalidInput(
                "expected system matrices A (n, n), B (n, m), C (p, n), D (p, m) that fit, got "
                f"shapes {', '.join(str(part.shape) for part in parts)}.",
                argument="system",
            ) from error
    else:
        raise InvalidInput(
            f"expected a control.StateSpace, got a {type(system).__name__}; a TransferFunction or "
            "(A, B, C, D) is allowed too.",
            argument="system",
        )
    if min(space.nstates, space.ninputs, space.noutputs) < 1:
        raise InvalidInput(
            f"expected a plant with a state, an input and an output, got {space.nstates} states, "
            f"{space.ninputs} inputs and {space.noutputs} outputs.",
            argument="system",
        )
    if space.dt is None:
        raise InvalidInput(
            "expected a discrete-time system with a sampling time in seconds, got dt = None; "
            "control.ss(A, B, C, D, dt) gives it one.",
            argument="system",
        )
    return space


def _time_base(value: object) -> float | bool:
    """Return a sampling time as `control` has it: s, 0 for continuous time, True for samples."""
    if value is True or (isinstance(value, int | float) and value == 0 and value is not False):
        return value
    try:
        return positive("dt", value, "s")
    except InvalidInput:
        raise InvalidInput(
            f"expected dt in (A, B, C, D, dt) to be a number of s, 0 or True, got {shown(value)}.",
            argument="system",
        ) from None


def _realised(system: control.TransferFunction) -> control.StateSpace:
    """Return a realisation, controllable column by column; `control` has MIMO by slycot only."""
    import control
    from scipy.linalg import block_diag

    columns = []
    for j in range(system.ninputs):
        rows = [control.ss(control.tf(system.num[i][j], system.den[i][j], system.dt))
                for i in range(system.noutputs)]  # fmt: skip
        first = rows[0]
        shared = all(np.array_equal(system.den[0][j], den[j]) for den in system.den)
        if shared and all(np.array_equal(row.A, first.A) for row in rows):
            c, d = np.vstack([row.C for row in rows]), np.vstack([row.D for row in rows])
            columns.append((first.A, first.B, c, d))
        else:
            columns.append((
                block_diag(*(row.A for row in rows)), np.vstack([row.B for row in rows]),
                block_diag(*(row.C for row in rows)), np.vstack([row.D for row in rows]),
            ))  # fmt: skip
    a, b = block_diag(*(c[0] for c in columns)), block_diag(*(c[1] for c in columns))
    c, d = np.hstack([c[2] for c in columns]), np.hstack([c[3] for c in columns])
    return control.StateSpace(
        a, b, c, d, system.dt, inputs=system.input_labels, outputs=system.output_labels,
        name=system.name, remove_useless_states=False,
    )  # fmt: skip


def _disturbance_matrix(value: ArrayLike | None, states: int) -> Array:
    if value is None:
        return np.zeros((states, 0))
    e = real_array("E", value)
    e = e[:, None] if e.ndim == 1 else e
    if e.ndim != 2 or e.shape[0] != states or not np.isfinite(e).all():
        raise InvalidInput(
            f"expected E to be finite and of shape ({states}, q), got shape {np.shape(value)}.",
            argument="E",
        )
    return e


def _discretised(
    space: control.StateSpace, e: Array, dt: float | None
) -> tuple[control.StateSpace, Array]:
    """Return the zero-order hold of plant and disturbance at dt."""
    import control

    if dt is None or dt is True:
        raise InvalidInput(
            "expected a discrete-time system with a sampling time in seconds, got dt = 0; "
            "the argument dt discretises a continuous-time one, as control.c2d(system, dt) does.",
            argument="system",
        )
    m = space.ninputs
    both = control.StateSpace(
        space.A, np.hstack([space.B, e]), space.C,
        np.hstack([space.D, np.zeros((space.noutputs, e.shape[1]))]),
        0, remove_useless_states=False,
    )  # fmt: skip
    with np.errstate(all="ignore"):
        sampled = control.c2d(both, dt, "zoh")
    if not all(np.isfinite(part).all() for part in (sampled.A, sampled.B)):
        raise InvalidInput(
            f"expected dt at which the plant stays finite, got {dt} s.", argument="dt"
        )
    held = control.StateSpace(
        sampled.A, sampled.B[:, :m], space.C, space.D, float(dt),
        states=space.state_labels, inputs=space.input_labels, outputs=space.output_labels,
        name=space.name, remove_useless_states=False,
    )  # fmt: skip
    return held, sampled.B[:, m:]
