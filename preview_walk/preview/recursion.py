"""A linear recursion over long sequences, a block of samples per matrix product.

Inside a block the response is one matrix product, from block to block it is a recursion of the
same form. No eigenvectors are needed, which nearly coincide in the cart-table's loop (a double
pole at exp(-omega dt) as the jerk gets cheap).
"""

from __future__ import annotations

import numpy as np

from preview_walk.types import Array

_BLOCK = 16


class Recursion:
    """z(k+1) = A z(k) + B w(k) over long sequences, a block of samples per matrix product."""

    def __init__(self, a: Array, b: Array, levels: int = 2) -> None:
        """Prepare the products of a block.

        Args:
            a: (n, n) A.
            b: (n, m) B.
            levels: How often the loop in Python is shortened by `_BLOCK`.

        """
        n, m = b.shape
        self._a, self._b = a, b
        self._inner: Recursion | None = None
        if levels == 0:
            return
        powers = [np.eye(n)]
        for _ in range(_BLOCK):
            powers.append(a @ powers[-1])
        impulse = [power @ b for power in powers]
        response = np.zeros((_BLOCK, n, _BLOCK, m))
        for row in range(_BLOCK):
            for column in range(row):
                response[row, :, column] = impulse[row - 1 - column]
        self._from_start = np.concatenate(powers[:-1]).T.copy()
        self._from_input = response.reshape(_BLOCK * n, _BLOCK * m).T.copy()
        self._to_next = np.concatenate([block.T for block in impulse[-2::-1]])
        self._inner = Recursion(powers[-1], np.eye(n), levels - 1)

    def run(self, w: Array, start: Array) -> Array:
        """Return z (batch, M, n); z[:, 0] is the start.

        Args:
            w: (batch, M, m) inputs.
            start: (batch, n) z at sample 0.

        """
        batch, length, inputs = w.shape
        if self._inner is None:
            z = np.empty((batch, length, start.shape[1]))
            source = w @ self._b.T
            for k in range(length):
                z[:, k] = start
                start = start @ self._a.T + source[:, k]
            return z
        blocks = -(-length // _BLOCK)
        padded = np.zeros((batch, blocks * _BLOCK, inputs))
        padded[:, :length] = w
        rows = padded.reshape(batch, blocks, _BLOCK * inputs)
        starts = self._inner.run(rows @ self._to_next, start)
        z = rows @ self._from_input
        z += starts @ self._from_start
        sequence: Array = z.reshape(batch, blocks * _BLOCK, -1)[:, :length]
        return sequence
