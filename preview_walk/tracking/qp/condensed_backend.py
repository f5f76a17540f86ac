"""A tick by its condensed QP: the working set of limits, and the multipliers kept between ticks."""

from __future__ import annotations

from typing import Any, NamedTuple, Protocol

import numpy as np

from preview_walk.tracking.qp.condensing import CondensedQP, NearestPoint, NotSolvable
from preview_walk.tracking.qp.problem import TickProblem
from preview_walk.tracking.qp.solution import Solution, unsolved
from preview_walk.types import Array, Foot

ROUNDS = 8
"""How often a tick may be solved again because its solution crossed further limits of joints."""

FORGET_TICKS = 10
"""A limit leaves the working set after so many ticks in which it was not reached."""

KEEP = 64
"""Condensed QPs kept, each for one set of contacts and one working set of limits."""


class Found(NamedTuple):
    """A nearest point, its multipliers, the iterations, and whether the exact method finished."""

    x: Array
    multipliers: Array
    iterations: int
    finished: bool = False


class Method(Protocol):
    """A solver of the condensed QP.

    `every_tick`: whether it solves those QPs too whose minimiser without constraints obeys all.
    """

    every_tick: bool

    def solve(
        self, qp: NearestPoint, contacts: tuple[Foot, ...], guess: Array | None
    ) -> Found | None:
        """Return the solution, or None.

        Args:
            qp: the condensed QP.
            contacts: feet in contact, whose constraints come first.
            guess: multipliers to start from, one per constraint; None for zeros.
        """


class CondensedBackend:
    """Accelerations eliminated exactly, the rest solved by a `Method`.

    A limit of a joint joins the working set, the constraints of the QP, in the tick in which a
    solution without it crosses it. Multipliers are kept by sole and by joint, so that a solve
    starts warm also when contacts or the working set have changed.
    """

    def __init__(self, method: Method) -> None:
        self.method = method
        self._qps: dict[tuple[TickProblem, tuple[int, ...]], CondensedQP] = {}
        self._working_set: dict[int, int] = {}  # limit -> ticks since it was reached
        self._multipliers: dict[object, Array] = {}

    def __getstate__(self) -> dict[str, Any]:
        """Leave out the condensed QPs, which are made again when needed."""
        return {**vars(self), "_qps": {}}

    def solve(self, problem: TickProblem) -> Solution:
        """See `Backend.solve`."""
        iterations, finished = 0, False
        for _ in range(ROUNDS):
            qp = self._qp(problem)
            qp.reduce()
            w = qp.free() if not (self.method.every_tick and qp.size) else None
            if w is not None:
                self._multipliers.clear()
            else:
                found = self._nearest(qp)
                if found is None:
                    return unsolved(problem, iterations, "not converged")
                iterations += found.iterations
                finished = found.finished
                w = qp.original(found.x)
            qp.expand(w)
            crossed = qp.crossed()
            if not crossed:
                self._forget()
                return Solution(
                    qp.acceleration,
                    w[: problem.nf],
                    qp.torques.copy(),
                    True,
                    iterations,
                    finished=finished,
                )
            self._working_set.update(dict.fromkeys(crossed, 0))
        return unsolved(problem, iterations, "joint limits still crossed")

    def _qp(self, problem: TickProblem) -> CondensedQP:
        key = (problem, tuple(sorted(self._working_set)))
        qp = self._qps.get(key)
        if qp is None:
            if len(self._qps) >= KEEP:
                del self._qps[next(iter(self._qps))]
            qp = self._qps[key] = CondensedQP(*key)
        return qp

    def _nearest(self, qp: CondensedQP) -> Found | None:
        """Return what the method finds from the multipliers of a tick ago, and keep its own."""
        nearest = qp.normalise()
        if not nearest.gradient @ nearest.gradient < np.inf:
            raise NotSolvable("the values of the QP are not finite")
        found = self.method.solve(nearest, qp.problem.contacts, self._guess(qp))
        if found is None:
            return None
        self._multipliers = {}
        if found.multipliers.any():
            kept = found.multipliers / nearest.length
            self._multipliers = {label: kept[span] for label, span in _labels(qp)}
        return found

    def _guess(self, qp: CondensedQP) -> Array | None:
        """Return the multipliers of a tick ago, or None where no constraint was active."""
        if not self._multipliers:
            return None
        guess = np.zeros(len(qp.low))
        for label, span in _labels(qp):
            if label in self._multipliers:
                guess[span] = self._multipliers[label]
        guess *= qp.nearest.length
        return guess

    def _forget(self) -> None:
        """Drop the limits that have not been reached for a while."""
        for limit, age in list(self._working_set.items()):
            reached = limit in self._multipliers and self._multipliers[limit].any()
            self._working_set[limit] = 0 if reached else age + 1
            if self._working_set[limit] > FORGET_TICKS:
                del self._working_set[limit]


def _labels(qp: CondensedQP) -> list[tuple[object, slice]]:
    """Return what each group of constraints belongs to: a sole, then a limit each."""
    contacts, count = qp.problem.contacts, len(qp.problem.contact_rows)
    size = count // max(1, len(contacts))
    labels: list[tuple[object, slice]] = [
        (foot, slice(size * k, size * k + size)) for k, foot in enumerate(contacts)
    ]
    labels += [(i, slice(count + k, count + k + 1)) for k, i in enumerate(qp.working_set)]
    return labels
