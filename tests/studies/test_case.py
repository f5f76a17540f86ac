"""A case's seed and key are its own: they do not move when the study around it does."""

from __future__ import annotations

import numpy as np
import pytest
from scipy import stats
from study_cases import drawn

import preview_walk as pw


def keys(study: pw.Study) -> dict[str, tuple[object, int]]:
    return {case.key: (tuple(sorted(case.values.items())), case.seed) for case in study.cases()}


def test_a_study_that_grows_keeps_the_cases_it_has() -> None:
    small = keys(pw.Study({"x": [1.0, 2.0]}, drawn, repeats=3))
    larger = keys(pw.Study({"x": [0.0, 1.0, 2.0, 5.0]}, drawn, repeats=7))
    assert len(small) == 6
    assert len(larger) == 28
    assert small.items() <= larger.items()


def test_every_case_has_another_seed_and_another_study_seed_others() -> None:
    study = pw.Study({"x": list(range(40))}, drawn, repeats=25)
    seeds = [case.seed for case in study.cases()]
    others = [case.seed for case in pw.Study(study.factors, drawn, repeats=25, seed=1).cases()]
    assert len(set(seeds)) == len(seeds) == 1000
    assert not set(seeds) & set(others)
    # Uniform over 32 bits: the mean of 1,000 is within four of its deviations.
    assert np.mean(seeds) / 2**32 == pytest.approx(0.5, abs=4 * 12**-0.5 / 1000**0.5)


def test_random_factors_are_drawn_from_their_distribution_and_again_the_same() -> None:
    study = pw.Study({"x": stats.uniform(10.0, 5.0)}, drawn, repeats=2000)
    values = [case.values["x"] for case in study.cases()]
    assert values == [case.values["x"] for case in study.cases()]
    assert stats.kstest(values, "uniform", (10.0, 5.0)).pvalue > 0.01
    seeds = [case.seed for case in study.cases()]
    assert abs(np.corrcoef(values, seeds)[0, 1]) < 0.1


def test_the_grid_is_the_product_with_the_last_factor_first_to_change() -> None:
    study = pw.Study({"a": [1, 2], "b": ["x", "y"], "c": 7}, lambda a, b, c: a, repeats=2)
    found = [(*case.values.values(), case.repeat) for case in study.cases()]
    assert found == [(a, b, 7, k) for a in (1, 2) for b in ("x", "y") for k in (0, 1)]
    assert [case.index for case in study.cases()] == list(range(8)) == list(range(len(study)))


def test_rows_that_are_listed_are_the_cells() -> None:
    study = pw.Study([{"a": 1, "b": 2}, {"a": 3, "b": 5}], lambda a, b: a + b)
    assert [dict(case.values) for case in study.cases()] == [{"a": 1, "b": 2}, {"a": 3, "b": 5}]


def test_a_value_that_has_no_text_of_its_own_is_refused() -> None:
    study = pw.Study({"x": [object()]}, lambda x: 0.0)
    with pytest.raises(pw.InvalidInput, match="must be plain, or have a text of their own"):
        list(study.cases())
