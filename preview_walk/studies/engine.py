"""The loop of a study: cases out to the workers, rows back as they end."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from concurrent.futures import FIRST_COMPLETED, Future, wait
from itertools import islice
from platform import node
from time import perf_counter

from preview_walk.studies.case import Case
from preview_walk.studies.pools import Pool
from preview_walk.studies.work import Row, Work


def rows_of(pool: Pool, work: Work, cases: Iterable[Case]) -> Iterator[Row]:
    """Yield the row of every case, as they end.

    Where a worker ends, the pool is made anew and the cases that it had are done one by one: what
    ends its worker then too is a row that says so, and nobody else's cases are lost.

    Args:
        pool: that does them.
        work: what is done with each.
        cases: taken as there is room for them.
    """
    left, flying = iter(cases), dict[Future[Row], Case]()
    while True:
        for case in islice(left, max(0, pool.at_once - len(flying))):
            flying[pool.submit(work, case)] = case
        if not flying:
            return
        done, _ = wait(flying, return_when=FIRST_COMPLETED)
        lost: list[Case] = []
        for future in done:
            case, error = flying.pop(future), future.exception()
            if error is None:
                yield future.result()
            elif pool.broken_by(error):
                lost.append(case)
            else:
                yield _killed(case, error)
        if lost:
            yield from _one_by_one(pool, work, lost, flying)
            flying.clear()


def _one_by_one(
    pool: Pool, work: Work, lost: list[Case], flying: dict[Future[Row], Case]
) -> Iterator[Row]:
    """Yield the rows of all cases that a broken pool had."""
    wait(flying)
    suspects = list(lost)
    for future, case in flying.items():
        if future.exception() is None:
            yield future.result()
        else:
            suspects.append(case)
    pool.renew()
    for case in sorted(suspects, key=lambda case: case.index):
        began = perf_counter()
        future = pool.submit(work, case)
        error = future.exception()
        if error is None:
            yield future.result()
            continue
        pool.renew()
        spent = perf_counter() - began
        if work.time_limit is not None and spent > work.time_limit:
            reason = f"over the time limit of {work.time_limit:g} s, in code that did not return"
            yield Row(case, "timeout", reason, seconds=spent, host=node())
        else:
            yield _killed(case, error, spent)


def _killed(case: Case, error: BaseException, seconds: float = 0.0) -> Row:
    """Return the row of a case whose worker ended."""
    text = f"its worker ended, as by a kill, a fault or a lack of memory ({type(error).__name__})"
    return Row(case, "killed", text, seconds=seconds, host=node())
