"""The loop over a pool that is told when to break: no case is lost, none is done twice."""

from __future__ import annotations

from concurrent.futures import Future
from concurrent.futures.process import BrokenProcessPool

import pytest
from study_cases import drawn

import preview_walk as pw
from preview_walk.studies.case import Case
from preview_walk.studies.engine import rows_of
from preview_walk.studies.work import Row, Work, run_case


class BreakingPool:
    """Does cases at once; breaks at given submissions, as they are handed over or under way."""

    at_once = 3

    def __init__(self, breaks: set[int], *, at_submit: bool) -> None:
        self.breaks, self.at_submit = breaks, at_submit
        self.count, self.broken, self.renewed = 0, False, 0
        self.flying: list[Future[Row]] = []

    def submit(self, work: Work, case: Case) -> Future[Row]:
        self.count += 1
        if self.count in self.breaks:
            self.broken = True
            if self.at_submit:
                raise BrokenProcessPool("a worker ended")
        future: Future[Row] = Future()
        if self.broken:
            future.set_exception(BrokenProcessPool("a worker ended"))
        else:
            future.set_result(run_case(work, case))
        return future

    def broken_by(self, error: BaseException) -> bool:
        return isinstance(error, BrokenProcessPool)

    def renew(self) -> None:
        self.broken, self.renewed = False, self.renewed + 1

    def close(self) -> None:
        """Do nothing."""


STUDY = pw.Study({"x": [0.0, 1.0, 2.0]}, drawn, repeats=4)


@pytest.mark.parametrize("at_submit", [False, True])
@pytest.mark.parametrize("breaks", [{1}, {2}, {7}, {12}, {3, 9}, set()])
def test_a_pool_that_breaks_loses_no_case(breaks: set[int], at_submit: bool) -> None:
    pool = BreakingPool(breaks, at_submit=at_submit)
    rows = list(rows_of(pool, Work(drawn), STUDY.cases()))
    assert sorted(row.case.index for row in rows) == list(range(12))
    assert {row.outcome for row in rows} == {"done"}
    assert pool.renewed == len(breaks)


def test_it_ends_when_it_is_told_to() -> None:
    pool = BreakingPool(set(), at_submit=False)
    seen: list[Row] = []
    for row in rows_of(pool, Work(drawn), STUDY.cases(), lambda: len(seen) >= 3):
        seen.append(row)
    assert 3 <= len(seen) < 12
    assert pool.count <= 9
