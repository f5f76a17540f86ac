"""A preview servo as systems of `control`, ready for `interconnect`, `forced_response`, `bode`.

A system cannot look ahead, so it is given the future: its inputs are r(k+N) and w(k+N-1), or w(k)
where N = 0, named `<output>_ahead` and `<disturbance>_ahead`, and a line of delays holds the window
(an FIR filter). The plant then follows its input N samples late.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from preview_walk.errors import InvalidInput
from preview_walk.preview.checks import require_type
from preview_walk.preview.design import PreviewDesign, loop_matrices
from preview_walk.types import Array

if TYPE_CHECKING:
    import control


MAX_DELAYS = 3000
"""Longest horizon that is made a system: its state matrix has the square of it as entries."""


@dataclass(frozen=True, eq=False)
class _Filter:
    """s(k+1) = a s + b v from v = [r(k+N); w(k+N-1)] to c s + d v = [action; r(k); w(k)]."""

    a: Array
    b: Array
    c: Array
    d: Array


def preview_filter(design: PreviewDesign) -> control.StateSpace:
    """Return the preview filter: from the reference ahead to the preview action.

    Args:
        design: The servo.

    Returns:
        A system with inputs `<output>_ahead` (p), `<disturbance>_ahead` (q) and outputs `w[i]`, the
        action that `design.closed_loop` takes (m), `<output>_reference`, r(k) (p), and
        `<disturbance>`, w(k) (q).

    """
    import control

    require_type("design", design, PreviewDesign)
    parts = _filter(design)
    plant = design.plant
    outputs = [f"w[{i}]" for i in range(plant.B.shape[1])]
    outputs += [f"{y}_reference" for y in plant.outputs] + list(plant.disturbances)
    return control.StateSpace(
        parts.a, parts.b, parts.c, parts.d, plant.dt, inputs=_ahead(design), outputs=outputs,
        name="preview_filter", remove_useless_states=False,
    )  # fmt: skip


def servo_system(design: PreviewDesign) -> control.StateSpace:
    """Return the controller: from the measured state and the future to the input.

    With integral action its first states are the predicted state and the input before; a plant
    that starts at x0 wants the first n of them to start there too.

    Args:
        design: The servo.

    Returns:
        A system whose inputs are named after the plant's states (n), `<output>_ahead` (p) and
        `<disturbance>_ahead` (q), and whose outputs after the plant's inputs (m).

    """
    import control

    require_type("design", design, PreviewDesign)
    plant, line = design.plant, _filter(design)
    n, m = plant.B.shape
    p, q, s = len(plant.C), plant.E.shape[1], len(line.a)
    zero = np.zeros
    # u = on_x x + on_z [prediction; u before] + action
    if design.integral:
        known = n + m
        on_x = -design.feedback[:, :n] - design.drift_gain
        on_z = np.hstack([design.drift_gain, np.eye(m) - design.feedback[:, n:]])
    else:
        known, on_x, on_z = 0, -design.feedback, zero((m, 0))
    c = np.hstack([on_z, line.c[:m]])
    d = np.hstack([on_x, line.d[:m]])
    a = zero((known + s, known + s))
    b = zero((known + s, n + p + q))
    a[known:, known:], b[known:, n:] = line.a, line.b
    if design.integral:
        # Without preview (N = 0) a disturbance is not foreseen, but found in the drift.
        e = plant.E if design.horizon > 0 else zero((n, q))
        a[:known] = np.vstack([plant.B @ c, c])
        b[:known] = np.vstack([plant.B @ d, d])
        a[:n, known:] += e @ line.c[m + p :]
        b[:n, n:] += e @ line.d[m + p :]
        b[:n, :n] += plant.A
    return control.StateSpace(
        a, b, c, d, plant.dt, inputs=[*plant.states, *_ahead(design)], outputs=list(plant.inputs),
        name="preview_servo", remove_useless_states=False,
    )  # fmt: skip


def closed_loop_system(design: PreviewDesign) -> control.StateSpace:
    """Return plant, servo and preview filter as one system.

    Its first n states are the plant's, so that `control.forced_response` can start them anywhere.

    Args:
        design: The servo.

    Returns:
        A system with inputs `<output>_ahead` (p) and `<disturbance>_ahead` (q) and outputs y (p),
        named as the plant's, u (m), and y - r as `<output>_error` (p).

    """
    import control

    require_type("design", design, PreviewDesign)
    plant, line = design.plant, _filter(design, drift=True)
    n, m = plant.B.shape
    p = len(plant.C)
    a, b, c, d = loop_matrices(design)
    z = len(a)
    on_z = -design.feedback + (np.eye(m, n + m, n) if design.integral else 0.0)
    # The loop's inputs are [action; r; w]; its outputs [y; u; y - r].
    reach = np.zeros((z, len(line.c)))
    reach[:, :m], reach[:n, m + p :] = b, plant.E
    shown = np.vstack([c, on_z, c])
    through = np.zeros((2 * p + m, len(line.c)))
    through[:, :m] = np.vstack([d, np.eye(m), d])
    through[p + m :, m : m + p] = -np.eye(p)
    system_a = np.zeros((z + len(line.a), z + len(line.a)))
    system_a[:z, :z], system_a[:z, z:], system_a[z:, z:] = a, reach @ line.c, line.a
    errors = [f"{y}_error" for y in plant.outputs]
    return control.StateSpace(
        system_a, np.vstack([reach @ line.d, line.b]), np.hstack([shown, through @ line.c]),
        through @ line.d, plant.dt, inputs=_ahead(design),
        outputs=[*plant.outputs, *plant.inputs, *errors],
        name="preview_closed_loop", remove_useless_states=False,
    )  # fmt: skip


def _ahead(design: PreviewDesign) -> list[str]:
    return [f"{name}_ahead" for name in (*design.plant.outputs, *design.plant.disturbances)]


def _filter(design: PreviewDesign, *, drift: bool = False) -> _Filter:
    """Return the lines of delays and what is read from them.

    With `drift`, a disturbance that no window shows (N = 0) acts by what it left in the state.
    """
    n_ahead, m = design.horizon, design.plant.B.shape[1]
    if n_ahead > MAX_DELAYS:
        raise InvalidInput(
            f"expected a design of at most {MAX_DELAYS} samples for a system, got {n_ahead}.",
            argument="design",
        )
    p, q = len(design.plant.C), design.plant.E.shape[1]
    gains = np.concatenate([design.present_gain[None], design.window_gain])
    of_r = _line(gains, p, n_ahead)
    if n_ahead > 0:
        of_w = _line(design.disturbance_window_gain, q, n_ahead - 1)
    elif drift and design.integral:
        found = np.vstack([-design.drift_gain @ design.plant.E, np.zeros((q, q))])
        of_w = _Filter(np.zeros((q, q)), np.eye(q), found, np.eye(m + q, q, -m))
    else:
        of_w = _Filter(np.zeros((0, 0)), np.zeros((0, q)), np.zeros((m + q, 0)),
                       np.eye(m + q, q, -m))  # fmt: skip
    r, w = len(of_r.a), len(of_w.a)
    a = np.block([[of_r.a, np.zeros((r, w))], [np.zeros((w, r)), of_w.a]])
    b = np.block([[of_r.b, np.zeros((r, q))], [np.zeros((w, p)), of_w.b]])
    c = np.block([[of_r.c[:m], of_w.c[:m]], [of_r.c[m:], np.zeros((p, w))],
                  [np.zeros((q, r)), of_w.c[m:]]])  # fmt: skip
    d = np.block([[of_r.d[:m], of_w.d[:m]], [of_r.d[m:], np.zeros((p, q))],
                  [np.zeros((q, p)), of_w.d[m:]]])  # fmt: skip
    return _Filter(a, b, c, d)


def _line(gains: Array, signals: int, delays: int) -> _Filter:
    """Return a line of delays of a signal; gains (delays + 1, m, signals), oldest sample first."""
    size = delays * signals
    a = np.eye(size, k=-signals)
    b = np.eye(size, signals)
    # The line holds the newest sample first; the whole window is [input, line].
    newest = np.concatenate(list(gains[::-1]), axis=1)
    oldest = np.zeros((signals, size + signals))
    oldest[:, size:] = np.eye(signals)
    read = np.vstack([newest, oldest])
    return _Filter(a, b, read[:, signals:], read[:, :signals])
