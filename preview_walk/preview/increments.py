"""Weights on states and inputs and on their increments in one cost: the increments as outputs.

    x'(k) = [x(k); x(k-1); u(k-1)],    y'(k) = [y(k); x(k) - x(k-1); u(k) - u(k-1)]

A servo without integral action on this plant has Q_x and R for state and input, and its Q_e for the
errors and the increments, whose reference is zero.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike

from preview_walk.preview.plant import Linear, Plant, read_plant


def with_increments(
    system: Linear, dt: float | None = None, *, E: ArrayLike | None = None
) -> Plant:
    """Return a plant whose outputs are y, then the increments of its state and of its input.

    Design it with `integral=False`; a reference (M, p) is then
    `np.pad(reference, ((0, 0), (0, n + m)))`, a start x0 is [x0, x0, u before].

    Args:
        system: Plant with n states, m inputs and p outputs, as for `preview_gains`.
        dt: Sampling time (s) at which a continuous-time plant is discretised.
        E: (n, q) matrix of disturbances that are previewed too; (n,) for one.

    Returns:
        A plant with 2 n + m states, m inputs and p + n + m outputs, for `preview_gains`.

    Raises:
        InvalidInput: If a shape cannot be or a value is not finite.

    """
    plant = read_plant(system, dt, E)
    (n, m), (p, q) = plant.B.shape, (len(plant.C), plant.E.shape[1])
    a, b = np.zeros((2 * n + m, 2 * n + m)), np.zeros((2 * n + m, m))
    a[:n, :n], a[n : 2 * n, :n] = plant.A, np.eye(n)
    b[:n], b[2 * n :] = plant.B, np.eye(m)
    c, d = np.zeros((p + n + m, len(a))), np.zeros((p + n + m, m))
    c[:p, :n], d[:p] = plant.C, plant.D
    c[p : p + n, :n], c[p : p + n, n : 2 * n] = np.eye(n), -np.eye(n)
    c[p + n :, 2 * n :], d[p + n :] = -np.eye(m), np.eye(m)
    before = [f"{name}_before" for name in (*plant.states, *plant.inputs)]
    change = [f"{name}_increment" for name in (*plant.states, *plant.inputs)]
    return replace(
        plant, A=a, B=b, C=c, D=d, E=np.vstack([plant.E, np.zeros((n + m, q))]),
        states=(*plant.states, *before), outputs=(*plant.outputs, *change),
    )  # fmt: skip
