"""The loop of a study: cases out to the workers, rows back as they end."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from concurrent.futures import FIRST_COMPLETED, Future, wait
from itertools import islice
from platform import node
from time import perf_counter

from preview_walk.studies.case import Case
from preview_walk.studies.pools import Pool
from preview_walk.studies.time_limit import GRACE
from preview_walk.studies.work import Row, Work

LOOK = 0.25
"""Seconds after which a wait looks whether it is to stop."""


def rows_of(
    pool: Pool, work: Work, cases: Iterable[Case], stop: Callable[[], bool] = lambda: False
) -> Iterator[Row]:
    """Yield the row of every case, as they end.

    Where a worker ends, the pool is made anew and the cases that it had are done one by one: what
    ends its worker then too is a row that says so, and nobody else's cases are lost.

    Args:
        pool: that does them.
        work: what is done with each.
        cases: taken as there is room for them.
        stop: whether to end before all are done.
    """
    left, flying = iter(cases), dict[Future[Row], Case]()
    while True:
        lost = _hand_over(pool, work, islice(left, max(0, pool.at_once - len(flying))), flying)
        if not flying and not lost:
            return
        done, _ = wait(flying, LOOK, FIRST_COMPLETED)
        for future in done:
            case, error = flying.pop(future), future.exception()
            if error is None:
                yield future.result()
            elif pool.broken_by(error):
                lost.append(case)
            else:
                yield _killed(case, error)
        if stop():
            return
        if lost:
            yield from _one_by_one(pool, work, [*lost, *_lost(flying)], stop)
            yield from (future.result() for future in flying if future.exception() is None)
            flying.clear()


def _hand_over(
    pool: Pool, work: Work, cases: Iterable[Case], flying: dict[Future[Row], Case]
) -> list[Case]:
    """Hand cases over; return that which a pool did not take because it was lost just then."""
    for case in cases:
        try:
            flying[pool.submit(work, case)] = case
        except RuntimeError as error:
            if not pool.broken_by(error):
                raise
            return [case]
    return []


def _lost(flying: Mapping[Future[Row], Case]) -> list[Case]:
    """Return the cases that a broken pool had and did not do."""
    wait(flying)
    return [case for future, case in flying.items() if future.exception() is not None]


def _one_by_one(
    pool: Pool, work: Work, lost: list[Case], stop: Callable[[], bool]
) -> Iterator[Row]:
    """Yield the rows of cases that a broken pool had."""
    pool.renew()
    for case in sorted(lost, key=lambda case: case.index):
        began = perf_counter()
        future = pool.submit(work, case)
        while not wait((future,), LOOK).done:
            if stop():
                return
        error = future.exception()
        if error is None:
            yield future.result()
            continue
        pool.renew()
        spent = perf_counter() - began
        if work.time_limit is not None and spent > work.time_limit + GRACE:
            reason = f"over the time limit of {work.time_limit:g} s, in code that did not return"
            yield Row(case, "timeout", reason, seconds=spent, host=node())
        else:
            yield _killed(case, error, spent)


def _killed(case: Case, error: BaseException, seconds: float = 0.0) -> Row:
    """Return the row of a case whose worker ended."""
    text = f"its worker ended, as by a kill, a fault or a lack of memory ({type(error).__name__})"
    return Row(case, "killed", text, seconds=seconds, host=node())
