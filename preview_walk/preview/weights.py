"""Weights of a quadratic cost: a number, a diagonal or a matrix, checked and made a matrix."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from preview_walk.errors import InvalidInput
from preview_walk.preview.checks import real_array
from preview_walk.types import Array


def weight_matrix(name: str, value: ArrayLike, size: int, *, definite: bool = False) -> Array:
    """Return a weight as a symmetric (size, size) matrix.

    Args:
        name: Name of the weight, for the sentence that refuses it.
        value: A number (times the identity), (size,) the diagonal, or (size, size).
        size: Number of things weighted.
        definite: Whether it must be positive definite and not only semidefinite.

    Raises:
        InvalidInput: If the shape cannot be, or it is not finite, symmetric and positive.

    """
    weight = real_array(name, value)
    if weight.ndim == 0:
        weight = weight * np.eye(size)
    elif weight.shape == (size,):
        weight = np.diag(weight)
    if weight.shape != (size, size):
        raise InvalidInput(
            f"expected {name} to be a scalar or of shape ({size},) or ({size}, {size}), got shape "
            f"{weight.shape}.",
            argument=name,
        )
    if not np.isfinite(weight).all():
        raise InvalidInput(f"expected {name} to be finite, got NaN or infinity.", argument=name)
    largest = np.abs(weight).max()
    if np.abs(weight - weight.T).max() > 1e-12 * largest:
        raise InvalidInput(
            f"expected {name} to be symmetric, got an asymmetric matrix.", argument=name
        )
    smallest = float(np.linalg.eigvalsh(weight)[0])
    if smallest < -1e-12 * largest or (definite and smallest <= 0.0):
        kind = "definite" if definite else "semidefinite"
        raise InvalidInput(
            f"expected {name} to be positive {kind}, got a smallest eigenvalue of {smallest:.3g}.",
            argument=name,
        )
    return weight
