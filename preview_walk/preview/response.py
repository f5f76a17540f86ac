"""What a preview servo does to a whole reference, in time linear in its length.

The preview action a(k) = sum_l F(l) r(k+l) is a correlation (FFT, overlap-save); the loop
z(k+1) = A z(k) + B a(k) then runs in blocks of samples (`recursion`).
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import ArrayLike
from scipy.fft import irfft, next_fast_len, rfft

from preview_walk.arguments import shown
from preview_walk.errors import InvalidInput
from preview_walk.preview.checks import computable, finite_vector, require_type, sequence
from preview_walk.preview.design import PreviewDesign, loop_matrices
from preview_walk.preview.recursion import Recursion
from preview_walk.types import Array


@dataclass(frozen=True, eq=False)
class Tracking:
    """A plant under its preview servo; sample k is the time k dt.

    Attributes:
        x: (M, n) state; x[0] is the start.
        u: (M, m) input, held from sample k to sample k + 1.
        y: (M, p) output C x + D u.
        error: (M, p) y - r.

    """

    x: Array
    u: Array
    y: Array
    error: Array

    def __repr__(self) -> str:
        largest = ", ".join(f"{e:.3g}" for e in np.abs(self.error).max(axis=0))
        return f"Tracking({len(self.x)} samples, largest |error| {largest})"


class Correlation:
    """sum_l G(l) s(k + l) of a signal held at its last value, for gains G(0) to G(N - 1)."""

    def __init__(self, gains: Array) -> None:
        """Transform the gains, once.

        Args:
            gains: (N, m, c) G.

        """
        self._count = len(gains)
        # About eight horizons to a block is where FFT work per sample is smallest.
        self._block = int(next_fast_len(max(8 * self._count, 512), real=True))
        self._spectrum = np.conj(rfft(np.moveaxis(gains, 0, -1), self._block, axis=-1))

    def run(self, signal: Array, ahead: int = 0) -> Array:
        """Return the sums (batch, m, M).

        Args:
            signal: (batch, c, M) s.
            ahead: The sample after k at which G(0) reads; 0 or 1.

        """
        batch, rows, length = signal.shape
        valid = self._block - self._count + 1
        blocks = -(-length // valid)
        padded = np.empty((batch, rows, (blocks - 1) * valid + self._block))
        padded[..., : length - ahead] = signal[..., ahead:]
        padded[..., length - ahead :] = signal[..., -1:]
        windows = sliding_window_view(padded, self._block, axis=-1)[:, :, ::valid]
        spectrum = np.einsum("mpf,bpcf->bmcf", self._spectrum, rfft(windows, axis=-1))
        action = irfft(spectrum, self._block, axis=-1)[..., :valid]
        return np.asarray(action.reshape(batch, -1, blocks * valid)[..., :length])


class PreviewFilter:
    """A preview design made ready to run over references; make one, use it often."""

    def __init__(self, design: PreviewDesign) -> None:
        """Transform the gains of a design and prepare its loop, once.

        Args:
            design: The design.

        """
        self._design = design
        seen = design.horizon > 0
        self._reference = Correlation(design.window_gain) if seen else None
        self._present = design.present_gain if np.any(design.present_gain) else None
        known = seen and design.plant.E.shape[1] > 0
        self._disturbance = Correlation(design.disturbance_window_gain) if known else None
        a, b = loop_matrices(design)[:2]
        e = np.zeros((len(a), design.plant.E.shape[1]))
        e[: len(design.plant.A)] = design.plant.E
        self._recursion = Recursion(a, np.hstack([b, e]))

    def preview_action(self, reference: Array, disturbance: Array | None = None) -> Array:
        """Return the action (batch, m, M).

        A disturbance that no window shows (N = 0) acts through the drift it left in the state:
        x(k) - A x(k-1) - B u(k-1) = E w(k-1).

        Args:
            reference: (batch, p, M), held at its last value.
            disturbance: (batch, q, M), held at its last value; none when None.

        """
        design = self._design
        if self._reference is not None:
            action = self._reference.run(reference, 1)
            if self._present is not None:
                action = action + design.present_gain @ reference
        else:
            action = design.present_gain @ reference
        if disturbance is not None and self._disturbance is not None:
            action = action + self._disturbance.run(disturbance)
        elif disturbance is not None:
            drift = design.drift_gain @ design.plant.E @ disturbance
            action = action - np.pad(drift[..., :-1], ((0, 0), (0, 0), (1, 0)))
        return np.asarray(action)

    def run(
        self, reference: Array, start: Array, disturbance: Array | None = None
    ) -> tuple[Array, Array]:
        """Return the loop's states (batch, M, z) and the preview action (batch, M, m).

        Args:
            reference: (batch, p, M).
            start: (batch, z) the state at sample 0, [x; u before], or x without integral action.
            disturbance: (batch, q, M); none when None.

        """
        action = np.swapaxes(self.preview_action(reference, disturbance), 1, 2)
        inputs = action
        if disturbance is not None:
            inputs = np.concatenate([action, np.swapaxes(disturbance, 1, 2)], axis=2)
        return self._recursion.run(inputs, start), action


def track(
    design: PreviewDesign,
    reference: ArrayLike,
    x0: ArrayLike | None = None,
    u_previous: ArrayLike | None = None,
    *,
    disturbance: ArrayLike | None = None,
) -> Tracking:
    """Run a preview servo over a whole reference, held at its last value past its end.

    Args:
        design: The servo, from `preview_gains`.
        reference: (M, p), or (M,) when p = 1.
        x0: (n,) state at sample 0; zero when None.
        u_previous: (m,) input held up to sample 0; zero when None.
        disturbance: (M, q), or (M,) when q = 1, that acts on the plant and is previewed like the
            reference; zero when None. It is zero before sample 0.

    Raises:
        InvalidInput: If a shape is wrong or a value not finite.

    """
    require_type("design", design, PreviewDesign)
    plant = design.plant
    n, m = plant.B.shape
    r = sequence("reference", reference, len(plant.C))
    start = finite_vector("x0", x0, np.zeros(n))
    before = finite_vector("u_previous", u_previous, np.zeros(m))
    w = read_disturbance(design, disturbance, len(r))
    if design.integral:
        start = np.append(start, before)
    batch = None if w is None else w.T[None]
    states, actions = PreviewFilter(design).run(r.T[None], start[None], batch)
    state, action = states[0], actions[0]
    x, u = state[:, :n], state[:, n:] if design.integral else 0.0
    u = u - state @ design.feedback.T + action
    y = x @ plant.C.T
    if np.any(plant.D):
        y = y + u @ plant.D.T
    return Tracking(x=x, u=u, y=y, error=y - r)


def preview_effect(
    design: PreviewDesign,
    reference: ArrayLike,
    horizons: Iterable[int],
    *,
    disturbance: ArrayLike | None = None,
) -> Array:
    """Return the largest absolute tracking error for each preview horizon, (H, p).

    The plant starts at rest with its output on the first reference sample. Short horizons bring
    no warning here: this is the curve that shows what they cost.

    Args:
        design: A servo with the longest horizon of interest and no final cost.
        reference: (M, p), or (M,) when p = 1.
        horizons: Numbers of samples, 0 to the design's own.
        disturbance: (M, q), or (M,) when q = 1; zero when None.

    Raises:
        InvalidInput: If a horizon is out of range, a shape wrong or a value not finite.

    """
    require_type("design", design, PreviewDesign)
    r = sequence("reference", reference, len(design.plant.C))
    x0, u0 = rest(design, r[0])
    try:
        # A list would take whatever has an index, transfer functions too.
        lengths = list(horizons) if isinstance(horizons, Iterable) else None
    except TypeError:
        lengths = None
    if lengths is None:
        raise InvalidInput(
            f"expected horizons to be several numbers of samples, got {shown(horizons)}.",
            argument="horizons",
        )
    errors = []
    for horizon in lengths:
        shorter = shortened(design, horizon)
        errors.append(np.abs(track(shorter, r, x0, u0, disturbance=disturbance).error).max(axis=0))
    return np.array(errors).reshape(-1, r.shape[1])


def shortened(design: PreviewDesign, horizon: int) -> PreviewDesign:
    """Return the same servo with a shorter sight; its gains are the first of the longer one.

    Raises:
        InvalidInput: If the horizon is not 0 to the design's own samples.

    """
    whole = isinstance(horizon, int | np.integer) and not isinstance(horizon, bool)
    if not (whole and 0 <= horizon <= design.horizon):
        raise InvalidInput(
            f"expected horizons of 0 to {design.horizon} samples, got {shown(horizon)}.",
            argument="horizons",
        )
    return replace(
        design,
        preview_gain=design.preview_gain[:horizon],
        disturbance_gain=design.disturbance_gain[:horizon],
    )


def rest(design: PreviewDesign, output: Array) -> tuple[Array, Array]:
    """Return the least x and u with x = A x + B u and C x + D u nearest to an output (p,)."""
    a, b, c, d = design.plant.A, design.plant.B, design.plant.C, design.plant.D
    n = len(a)
    equations = np.block([[a - np.eye(n), b], [c, d]])
    with computable("design"):
        found = np.linalg.lstsq(equations, np.append(np.zeros(n), output), rcond=None)[0]
    return found[:n], found[n:]


def read_disturbance(
    design: PreviewDesign, disturbance: ArrayLike | None, length: int
) -> Array | None:
    """Return a disturbance as (length, q): zero when not given, None where the plant has none.

    Raises:
        InvalidInput: If its shape is wrong or a value not finite.

    """
    columns = design.plant.E.shape[1]
    if columns == 0:
        if disturbance is not None:
            raise InvalidInput(
                "expected no disturbance for a design without E, got one.", argument="disturbance"
            )
        return None
    if disturbance is None:
        return np.zeros((length, columns))
    w = sequence("disturbance", disturbance, columns)
    if len(w) != length:
        raise InvalidInput(
            f"expected a disturbance of the reference's {length} samples, got {len(w)}.",
            argument="disturbance",
        )
    return w
