"""What a preview servo does to a whole reference, in time linear in its length.

The preview action w(k) = sum_l F(l) r(k+l) is a correlation (FFT, overlap-save). The loop
z(k+1) = A z(k) + B w(k) then runs in blocks of samples: inside a block its response is one
matrix product, from block to block it is a recursion of the same form. No eigenvectors are
needed, which nearly coincide in the cart-table's loop (a double pole at exp(-omega dt) as the
jerk gets cheap).
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import ArrayLike
from scipy.fft import irfft, next_fast_len, rfft

from preview_walk.errors import InvalidInput
from preview_walk.preview.gains import PreviewDesign
from preview_walk.types import Array

_BLOCK = 16


@dataclass(frozen=True, eq=False)
class Tracking:
    """A plant under its preview servo; sample k is the time k dt.

    Attributes:
        x: (M, n) state; x[0] is the start.
        u: (M, m) input, held from sample k to sample k + 1.
        y: (M, p) output C x.
        error: (M, p) y - r.

    """

    x: Array
    u: Array
    y: Array
    error: Array


class Recursion:
    """z(k+1) = A z(k) + B w(k) over long sequences, a block of samples per matrix product."""

    def __init__(self, a: Array, b: Array, levels: int = 2) -> None:
        """Prepare A (n, n) and B (n, m); each level shortens the loop in Python by `_BLOCK`."""
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
        """Return z (batch, M, n) for w (batch, M, m); z[:, 0] is start (batch, n)."""
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


class PreviewFilter:
    """A preview design made ready to run over references; make one, use it often."""

    def __init__(self, design: PreviewDesign) -> None:
        """Transform the gains of a design and prepare its loop, once."""
        self._horizon = design.horizon
        # About eight horizons to a block is where FFT work per sample is smallest.
        self._block = int(next_fast_len(max(8 * self._horizon, 512), real=True))
        self._gain_spectrum = np.conj(
            rfft(np.moveaxis(design.window_gain, 0, -1), self._block, axis=-1)
        )
        self._recursion = Recursion(design.closed_loop.A, design.closed_loop.B)

    def preview_action(self, reference: Array) -> Array:
        """Return w (batch, m, M) for a reference (batch, p, M) held at its last value."""
        batch, outputs, length = reference.shape
        valid = self._block - self._horizon + 1
        blocks = -(-length // valid)
        padded = np.empty((batch, outputs, (blocks - 1) * valid + self._block))
        padded[..., : length - 1] = reference[..., 1:]
        padded[..., length - 1 :] = reference[..., -1:]
        windows = sliding_window_view(padded, self._block, axis=-1)[:, :, ::valid]
        spectrum = np.einsum("mpf,bpcf->bmcf", self._gain_spectrum, rfft(windows, axis=-1))
        action = irfft(spectrum, self._block, axis=-1)[..., :valid]
        return np.asarray(action.reshape(batch, -1, blocks * valid)[..., :length])

    def run(self, reference: Array, start: Array) -> Array:
        """Return the loop's states [x(k); u(k-1)], (batch, M, n + m).

        reference is (batch, p, M), start (batch, n + m) the state at sample 0.
        """
        return self._recursion.run(np.swapaxes(self.preview_action(reference), 1, 2), start)


def track(
    design: PreviewDesign,
    reference: ArrayLike,
    x0: ArrayLike | None = None,
    u_previous: ArrayLike | None = None,
) -> Tracking:
    """Run a preview servo over a whole reference, held at its last value past its end.

    Args:
        design: The servo, from `preview_gains`.
        reference: (M, p), or (M,) when p = 1.
        x0: (n,) state at sample 0; zero when None.
        u_previous: (m,) input held up to sample 0; zero when None.

    Raises:
        InvalidInput: If a shape is wrong or a value not finite.

    """
    system = design.system
    n, m = system.nstates, system.ninputs
    r = _reference(reference, system.noutputs)
    start = _vector("x0", x0, np.zeros(n))
    before = _vector("u_previous", u_previous, np.zeros(m))
    servo = PreviewFilter(design)
    state = servo.run(r.T[None], np.append(start, before)[None])[0]
    action = servo.preview_action(r.T[None])[0].T
    x, u = state[:, :n], state[:, n:] - state @ design.feedback.T + action
    y = x @ system.C.T
    return Tracking(x=x, u=u, y=y, error=y - r)


def preview_effect(design: PreviewDesign, reference: ArrayLike, horizons: Iterable[int]) -> Array:
    """Return the largest absolute tracking error for each preview horizon, (H, p).

    The plant starts at rest with its output on the first reference sample. A horizon that
    `preview_gains` would refuse is allowed here: this is the curve that shows why.

    Args:
        design: A servo with the longest horizon of interest.
        reference: (M, p), or (M,) when p = 1.
        horizons: Numbers of samples, 1 to the design's own.

    Raises:
        InvalidInput: If a horizon is out of range, a shape wrong or a value not finite.

    """
    r = _reference(reference, design.system.noutputs)
    x0, u0 = _rest(design, r[0])
    errors = []
    for horizon in horizons:
        if not 1 <= horizon <= design.horizon:
            raise InvalidInput(
                f"expected horizons of 1 to {design.horizon} samples, got {horizon}."
            )
        shorter = replace(design, preview_gain=design.preview_gain[:horizon])
        errors.append(np.abs(track(shorter, r, x0, u0).error).max(axis=0))
    return np.array(errors).reshape(-1, r.shape[1])


def _rest(design: PreviewDesign, output: Array) -> tuple[Array, Array]:
    """Return the least x and u with x = A x + B u and C x = output."""
    a, b, c = design.system.A, design.system.B, design.system.C
    n, m = b.shape
    equations = np.block([[a - np.eye(n), b], [c, np.zeros((len(c), m))]])
    rest = np.linalg.lstsq(equations, np.append(np.zeros(n), output), rcond=None)[0]
    return rest[:n], rest[n:]


def _reference(value: ArrayLike, outputs: int) -> Array:
    reference = np.asarray(value, dtype=float)
    if outputs == 1 and reference.ndim == 1:
        reference = reference[:, None]
    if reference.ndim != 2 or reference.shape[1] != outputs or len(reference) < 1:
        raise InvalidInput(
            f"expected a reference of shape (M, {outputs}) with M >= 1, got shape "
            f"{np.shape(value)}."
        )
    if not np.isfinite(reference).all():
        raise InvalidInput("expected a finite reference, got NaN or infinity.")
    return reference


def _vector(name: str, value: ArrayLike | None, default: Array) -> Array:
    if value is None:
        return default
    vector = np.atleast_1d(np.asarray(value, dtype=float))
    if vector.shape != default.shape or not np.isfinite(vector).all():
        raise InvalidInput(f"expected {name} to be {len(default)} finite numbers, got {value!r}.")
    return vector
