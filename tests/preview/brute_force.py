"""The optimum of a servo's cost by least squares over a long run: no Riccati equation in it."""

from __future__ import annotations

import numpy as np
from scipy.linalg import solve_triangular

from preview_walk.preview.plant import Plant
from preview_walk.threads import one_thread
from preview_walk.types import Array

Weights = tuple[Array, Array, Array]


def optimal_input(
    plant: Plant,
    weights: Weights,
    future: tuple[Array, Array],
    x0: Array,
    *,
    integral: bool = True,
    final: Array | None = None,
) -> Array:
    """Return u (H, m) that minimises the cost of H samples for a known r (H + 1, p), w (H, q).

    Without a final cost sample H counts by its state's increment alone; the run must be long.
    u(-1) = 0, w(-1) = 0.
    """
    matrix, right = least_squares(plant, weights, future, x0, integral=integral, final=final)
    return solution(matrix, right).reshape(-1, plant.B.shape[1])


def solution(matrix: Array, right: Array) -> Array:
    """Return the u with the least |matrix u - right|."""
    with one_thread():  # on a busy machine the threads wait for each other
        q, upper = np.linalg.qr(matrix)
        return np.asarray(solve_triangular(upper, q.T @ right))


def motion(plant: Plant, w: Array, x0: Array) -> tuple[Array, Array]:
    """Return x(0) to x(H) as free (H + 1, n) + forced (H + 1, n, H m) times all inputs."""
    h, (n, m) = len(w), plant.B.shape
    free, forced = np.zeros((h + 1, n)), np.zeros((h + 1, n, h * m))
    free[0] = x0
    for k in range(h):
        free[k + 1] = plant.A @ free[k] + plant.E @ w[k]
        forced[k + 1] = plant.A @ forced[k]
        forced[k + 1, :, k * m : (k + 1) * m] += plant.B
    return free, forced


def least_squares(
    plant: Plant,
    weights: Weights,
    future: tuple[Array, Array],
    x0: Array,
    *,
    integral: bool = True,
    final: Array | None = None,
) -> tuple[Array, Array]:
    """Return M and b of the cost |M u - b|^2 that `optimal_input` minimises."""
    (r, w), h, m = future, len(future[1]), plant.B.shape[1]
    free, forced = motion(plant, w, x0)
    held = np.eye(h * m).reshape(h, m, h * m)
    before = np.concatenate([np.zeros((1, m, h * m)), held[:-1]])
    roots = [np.linalg.cholesky(q + 1e-300 * np.eye(len(q))).T for q in weights]
    error = np.einsum("pn,knu->kpu", plant.C, forced[:h]) + np.einsum("pm,kmu->kpu", plant.D, held)
    rows = [(roots[0] @ error, (free[:h] @ plant.C.T - r[:h]) @ roots[0].T)]
    if integral:
        rows.append((roots[1] @ np.diff(forced, axis=0), np.diff(free, axis=0) @ roots[1].T))
        rows.append((roots[2] @ (held - before), np.zeros((h, m))))
    else:
        rows.append((roots[1] @ forced[:h], free[:h] @ roots[1].T))
        rows.append((roots[2] @ held, np.zeros((h, m))))
    if final is not None:
        # X(H) = [e; dx] with the error just before the input changes.
        last = plant.C @ forced[h] + plant.D @ held[h - 1]
        rows[1] = tuple(part[:-1] for part in rows[1])  # type: ignore[assignment]
        root = np.linalg.cholesky(final + 1e-300 * np.eye(len(final))).T
        end = np.concatenate([plant.C @ free[h] - r[h], free[h] - free[h - 1]])
        rows.append((root @ np.vstack([last, forced[h] - forced[h - 1]]), root @ end))
    matrix = np.vstack([part.reshape(-1, h * m) for part, _ in rows])
    right = -np.concatenate([np.asarray(part).ravel() for _, part in rows])
    return matrix, right
