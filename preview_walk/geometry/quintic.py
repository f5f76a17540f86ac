"""Quintic polynomials: one coordinate between two states, its acceleration continuous."""

from __future__ import annotations

from dataclasses import dataclass

from preview_walk.types import Array

State = tuple[float, float, float]
"""Position, velocity and acceleration of one coordinate."""


@dataclass(frozen=True)
class Quintic:
    """A quintic polynomial of one coordinate over [start, end], held outside.

    Attributes:
        start: beginning of the time span, s.
        end: end of the time span, s.
        coefficients: of the powers of u from 0 to 5, with u going from 0 to 1 over the span.
    """

    start: float
    end: float
    coefficients: tuple[float, float, float, float, float, float]

    @classmethod
    def between(cls, start: float, end: float, first: State, last: State) -> Quintic:
        """Return the quintic with the given states at its two ends.

        Args:
            start: time of the first state, s.
            end: time of the last state, s, after `start`.
            first: position, velocity and acceleration at `start`.
            last: the same at `end`.
        """
        h = end - start
        p0, v0, a0 = first[0], first[1] * h, 0.5 * first[2] * h * h
        dp = last[0] - p0 - v0 - a0
        dv = last[1] * h - v0 - 2.0 * a0
        da = last[2] * h * h - 2.0 * a0
        c3 = 10.0 * dp - 4.0 * dv + 0.5 * da
        c4 = -15.0 * dp + 7.0 * dv - da
        c5 = 6.0 * dp - 3.0 * dv + 0.5 * da
        return cls(start, end, (p0, v0, a0, c3, c4, c5))

    def at(self, t: float) -> State:
        """Return position, velocity and acceleration at time t (s)."""
        h = self.end - self.start
        u = (t - self.start) / h
        if u < 0.0:
            u = 0.0
        elif u > 1.0:
            u = 1.0
        a, b, c, d, e, f = self.coefficients
        return (
            a + u * (b + u * (c + u * (d + u * (e + u * f)))),
            (b + u * (2.0 * c + u * (3.0 * d + u * (4.0 * e + u * 5.0 * f)))) / h,
            (2.0 * c + u * (6.0 * d + u * (12.0 * e + u * 20.0 * f))) / (h * h),
        )

    def accelerations(self, t: Array) -> Array:
        """Return the acceleration (N,) at times (N,) in s: the last of `at`, 0 outside the span."""
        h = self.end - self.start
        u = (t - self.start) / h
        _, _, c, d, e, f = self.coefficients
        result: Array = (2.0 * c + u * (6.0 * d + u * (12.0 * e + u * 20.0 * f))) / (h * h)
        result[(u < 0.0) | (u > 1.0)] = 0.0
        return result
