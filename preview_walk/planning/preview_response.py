"""What a preview servo does to a whole reference, in time linear in its length.

The preview action w(k) = sum_l F(l) r(k+l) is a correlation (FFT, overlap-save); the loop
xi(k+1) = A xi(k) + B w(k) is then a cascade of first-order filters in the Schur basis of A. The
basis is unitary, so the cascade stays exact where eigenvectors nearly coincide, as they do in
the cart-table's loop (a double pole at exp(-omega dt) as the jerk gets cheap).
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import ArrayLike, NDArray
from scipy.fft import irfft, next_fast_len, rfft
from scipy.linalg import matrix_balance, schur
from scipy.signal import lfilter

from preview_walk.errors import InvalidInput
from preview_walk.planning.preview_gains import PreviewDesign
from preview_walk.types import Array


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


class PreviewFilter:
    """A preview design made ready to run over references; make one, use it often."""

    def __init__(self, design: PreviewDesign) -> None:
        """Factor the closed loop of a design and transform its gains, once."""
        loop, system = design.closed_loop, design.system
        horizon = design.horizon
        self._horizon = horizon
        self._n = system.nstates
        # About eight horizons to a block is where FFT work per sample is smallest.
        self._block = int(next_fast_len(max(8 * horizon, 512), real=True))
        self._gain_spectrum = np.conj(
            rfft(np.moveaxis(design.window_gain, 0, -1), self._block, axis=-1)
        )
        # Balanced first: x and u differ in size by orders of magnitude.
        balanced, (scale, _) = matrix_balance(loop.A, permute=False, separate=True)
        triangle, basis = schur(balanced, output="complex")
        self._triangle = triangle
        self._to_modes = basis.conj().T / scale
        self._from_modes = basis * scale[:, None]
        self._input = self._to_modes @ loop.B
        self._feedback = design.feedback

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

    def run(self, reference: Array, x0: Array, u_previous: Array) -> tuple[Array, Array]:
        """Return x (batch, n, M) and u (batch, m, M) for reference (batch, p, M).

        x0 (batch, n) is the state at sample 0, u_previous (batch, m) the input held up to it;
        u[..., k] is held from sample k to k + 1.
        """
        action = self.preview_action(reference)
        modes = self._modes(action, np.concatenate([x0, u_previous], axis=1))
        state = np.real(self._from_modes @ modes)
        u = state[:, self._n :] - self._feedback @ state + action
        return state[:, : self._n], u

    def _modes(self, action: Array, start: Array) -> NDArray[np.complex128]:
        """Return xi in the Schur basis, (batch, n + m, M), last mode first."""
        triangle = self._triangle
        batch, _, length = action.shape
        modes = np.empty((batch, len(triangle), length), dtype=complex)
        source = np.empty((batch, length), dtype=complex)
        first = start @ self._to_modes.T
        for i in range(len(triangle) - 1, -1, -1):
            source[:, 0] = first[:, i]
            source[:, 1:] = (self._input[i] @ action)[:, :-1]
            for j in range(i + 1, len(triangle)):
                source[:, 1:] += triangle[i, j] * modes[:, j, :-1]
            modes[:, i] = lfilter([1.0], [1.0, -triangle[i, i]], source, axis=-1)
        return modes


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
    x, u = PreviewFilter(design).run(r.T[None], start[None], before[None])
    y = x[0].T @ system.C.T
    return Tracking(x=x[0].T, u=u[0].T, y=y, error=y - r)


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
