"""LQR, LQI, preview, MPC and Wieber's on one plant: errors, effort and time side by side."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from preview_walk.arguments import shown
from preview_walk.errors import InvalidInput
from preview_walk.preview.checks import finite_vector, require_type, sequence
from preview_walk.preview.design import PreviewDesign
from preview_walk.preview.gains import preview_gains
from preview_walk.preview.half_planes import HalfPlanes
from preview_walk.preview.least_input import LeastInputServo
from preview_walk.preview.limited import LimitedServo
from preview_walk.preview.limits import Limits
from preview_walk.preview.response import Tracking, read_disturbance
from preview_walk.preview.servo import PreviewServo
from preview_walk.types import Array

LAWS = ("LQR", "LQI", "preview", "MPC", "Wieber")
"""What `compare` runs: no preview and no integral action, no preview, the design, the design within
limits, and the least input within limits."""


@dataclass(frozen=True, eq=False)
class LawResult:
    """One law on the plant.

    Attributes:
        name: One of `LAWS`.
        run: The plant's motion.
        seconds: Time of one sample of the law (s), the mean over the run on this machine.
        failures: Samples at which a quadratic programme was not solved.
        outside: Largest distance of an output from its limits.

    """

    name: str
    run: Tracking
    seconds: float
    failures: int
    outside: float

    def __repr__(self) -> str:
        return f"LawResult({self.name}: {self.run!r})"


@dataclass(frozen=True, eq=False)
class Comparison:
    """Several laws on one plant; `print` shows the table, `plot_comparison` draws it.

    Attributes:
        design: The preview servo that the others were made from.
        reference: (M, p) the reference.
        limits: The limits.
        results: One for each law, in the order run.

    """

    design: PreviewDesign
    reference: Array
    limits: Limits
    results: tuple[LawResult, ...]

    def __repr__(self) -> str:
        names = ", ".join(result.name for result in self.results)
        return f"Comparison({names}: {len(self.reference)} samples)"

    def __getitem__(self, name: str) -> LawResult:
        """Return the result of a law by its name."""
        for result in self.results:
            if result.name == name:
                return result
        raise InvalidInput(
            f"expected one of {', '.join(r.name for r in self.results)}, got {shown(name)}.",
            argument="name",
        )

    def __str__(self) -> str:
        """Return the table: a row for each law."""
        outputs = self.design.plant.outputs
        errors = [f" {name}" for name in outputs] if len(outputs) > 1 else [" error"]
        titles = [f"{kind}{error}" for kind in ("rms", "max") for error in errors]
        titles += ["rms u", "max |u|", "rms du", "outside", "us/sample", "failures"]
        widths = [max(11, len(title) + 2) for title in titles]
        lines = [f"{'law':>8}" + "".join(f"{t:>{w}}" for t, w in zip(titles, widths, strict=True))]
        for result in self.results:
            error, u = result.run.error, result.run.u
            change = np.diff(u, axis=0, prepend=0.0)
            numbers = [
                *(_rms(column) for column in error.T), *np.abs(error).max(axis=0), _rms(u),
                np.abs(u).max(), _rms(change), result.outside, 1e6 * result.seconds,
                result.failures,
            ]  # fmt: skip
            cells = "".join(f"{x:>{w}.4g}" for x, w in zip(numbers, widths, strict=True))
            lines.append(f"{result.name:>8}{cells}")
        return "\n".join(lines)


def compare(
    design: PreviewDesign,
    reference: ArrayLike,
    *,
    disturbance: ArrayLike | None = None,
    x0: ArrayLike | None = None,
    limits: Limits | None = None,
    laws: Sequence[str] | None = None,
) -> Comparison:
    """Run several laws with the same weights on the same plant.

    LQR has neither preview nor integral action and weights state and input with what the others
    weight their increments with; LQI has no preview; MPC is the preview servo within limits.
    Wieber's follows no reference: it looks for the least input, weighed by R, that keeps the limits
    over the horizon. All of them measure the state, and cut their input to its limits.

    Args:
        design: A preview servo, from `preview_gains`.
        reference: (M, p), or (M,) when p = 1; held past its end.
        disturbance: (M, q), or (M,) when q = 1, acting on all; only preview and MPC foresee it.
        x0: (n,) state at the start; zero when None.
        limits: Limits of inputs and outputs; none when None. Only MPC and Wieber's know those of
            outputs.
        laws: Which of `LAWS` to run; all when None, Wieber's where there are polygons.

    Raises:
        InvalidInput: If a shape is wrong, a value not finite or a law unknown.

    """
    require_type("design", design, PreviewDesign)
    limits = Limits() if limits is None else limits
    require_type("limits", limits, Limits)
    if laws is None:
        laws = LAWS if limits.polygons is not None else LAWS[:-1]
    if (
        isinstance(laws, str)
        or not isinstance(laws, Sequence)
        or not set(map(str, laws)) <= set(LAWS)
    ):
        raise InvalidInput(
            f"expected laws out of {', '.join(LAWS)}, got {shown(laws)}.", argument="laws"
        )
    r = sequence("reference", reference, len(design.plant.C))
    w = read_disturbance(design, disturbance, len(r))
    start = finite_vector("x0", x0, np.zeros(len(design.plant.A)))
    planes = limits.of_outputs(*r.shape)
    results = []
    for name in laws:
        servo = _servo(name, design, limits)
        run, seconds = _simulate(servo, r, np.zeros((len(r), 0)) if w is None else w, start, planes)
        failures = servo.failures if isinstance(servo, LimitedServo) else 0
        results.append(LawResult(name, run, seconds, failures, planes.outside(run.y)))
    return Comparison(design, r, limits, tuple(results))


def _servo(name: str, design: PreviewDesign, limits: Limits) -> PreviewServo:
    """Return the servo of a law."""
    weights = design.Q_e, design.Q_x, design.R
    if name == "MPC":
        from preview_walk.preview.mpc import PredictiveServo

        return PredictiveServo(design, limits)
    if name == "Wieber":
        return LeastInputServo(design, limits)
    if name == "LQR":
        design = preview_gains(design.plant, *weights, 0, integral=False)
    elif name == "LQI":
        design = preview_gains(design.plant, *weights, 0)
    return PreviewServo(design, u_min=limits.u_min, u_max=limits.u_max)


def _simulate(
    servo: PreviewServo, r: Array, w: Array, start: Array, limits: HalfPlanes
) -> tuple[Tracking, float]:
    """Return the run of a servo on its plant, and the mean time of a step (s)."""
    plant, ahead = servo.design.plant, servo.design.horizon
    r_held, w_held = (np.concatenate([v, np.repeat(v[-1:], ahead, axis=0)]) for v in (r, w))
    state, x, spent = servo.start(start), start, 0.0
    xs, us = np.empty((len(r), len(start))), np.empty((len(r), plant.B.shape[1]))
    for k in range(len(r)):
        known = r_held[k : k + ahead + 1], w_held[k : k + ahead]
        begin = time.perf_counter()
        if isinstance(servo, LimitedServo):
            state = servo.step(state, *known, y_limits=limits.window(k, ahead + 1))
        else:
            state = servo.step(state, *known)
        spent += time.perf_counter() - begin
        xs[k], us[k] = x, state.u
        x = plant.A @ x + plant.B @ state.u + plant.E @ w[k]
        state = servo.measured(state, x)
    y = xs @ plant.C.T + us @ plant.D.T
    return Tracking(x=xs, u=us, y=y, error=y - r), spent / len(r)


def _rms(values: Array) -> float:
    return float(np.sqrt(np.mean(values**2)))
