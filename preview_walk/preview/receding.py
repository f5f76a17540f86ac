"""A servo of finite sight and a final cost: the first step of an N-step optimum, taken anew.

With P(N) the final cost and P(i) from P(i+1) by the Riccati recursion,

    W_i = (R + G' P(i+1) G)^-1,  K_i = W_i (G' P(i+1) Phi + S'),  A_i = Phi - G K_i,
    P(i) = Phi' P(i+1) A_i + Q - S K_i,

the law of the first step is

    du = -K_0 X - sum_{l=1..N} W_0 G' A_1' ... A_(l-1)' P(l) Gamma d(k+l-1).
"""

from __future__ import annotations

import numpy as np

from preview_walk.errors import InvalidInput
from preview_walk.preview.design import PreviewDesign
from preview_walk.preview.horizon import slow_mode
from preview_walk.preview.plant import Plant
from preview_walk.preview.problem import Problem, Weights, error_augmented
from preview_walk.preview.riccati import Law, law_of
from preview_walk.types import Array

MAX_ENTRIES = 20_000_000
"""Entries of all Riccati matrices of a horizon together that are kept (160 MB)."""


def receding_horizon(plant: Plant, weights: Weights, final: Array, horizon: float) -> PreviewDesign:
    """Return the servo with integral action that takes the first step of an N-step optimum.

    Args:
        plant: The plant.
        weights: The weights of error, increments of the state and increments of the input.
        final: (p + n, p + n) weight of [e; dx] at the end of the horizon.
        horizon: N >= 1 in samples.

    Raises:
        InvalidInput: If the horizon cannot be, or the loop of the law is unstable.

    """
    problem, p = error_augmented(plant, weights), len(plant.C)
    most = MAX_ENTRIES // problem.phi.size
    if not 1 <= horizon <= most:
        raise InvalidInput(
            f"expected a horizon N of 1 to {most} samples with a final cost, got {horizon}.",
            argument="N",
        )
    laws = _backwards(problem, final, int(horizon))
    first = laws[0]
    radius = float(np.abs(np.linalg.eigvals(first.closed)).max())
    fixed = 1.0 if len(plant.C) > plant.B.shape[1] else 0.0
    if not radius < 1.0 + fixed * 1e-9:
        raise InvalidInput(
            "expected a final cost and a horizon N whose loop is stable, got a spectral radius of "
            f"{radius:.6f}.",
            argument="final_cost",
        )
    reach = np.vstack([plant.C @ plant.E, plant.E])
    known = np.hstack([np.eye(len(problem.phi), p) * -1.0, reach])
    gains = np.empty((len(laws), len(first.left), known.shape[1]))
    ahead = first.left
    for row, law, following in zip(gains, laws, [*laws[1:], None], strict=True):
        row[:] = ahead @ law.riccati @ known
        if following is not None:
            ahead = ahead @ following.closed.T
    slow = slow_mode(first.closed, first.left, first.riccati @ known)
    return PreviewDesign(
        plant, weights.Q_e, weights.Q_x, weights.R,
        first.gain[:, :p].copy(), first.gain[:, p:].copy(), gains[..., :p].copy(),
        first.riccati, first.closed, first.residual, slow, gains[..., p:].copy(), True,
    )  # fmt: skip


def _backwards(problem: Problem, final: Array, horizon: int) -> list[Law]:
    """Return the laws of the samples 0 to N - 1; the last one looks at the final cost alone."""
    try:
        laws = [law_of(problem, final)]
        for _ in range(horizon - 1):
            law = laws[-1]
            before = problem.phi.T @ law.riccati @ law.closed + problem.q
            if problem.s is not None:
                before = before - problem.s @ law.gain
            laws.append(law_of(problem, (before + before.T) / 2.0))
    except np.linalg.LinAlgError as error:
        raise InvalidInput(
            f"expected a final cost and weights whose recursion can be solved, got: {error}.",
            argument="final_cost",
        ) from error
    if not np.isfinite(laws[-1].closed).all():
        raise InvalidInput(
            "expected a final cost and weights whose recursion stays finite, got an overflow.",
            argument="final_cost",
        )
    return laws[::-1]
