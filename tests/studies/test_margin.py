"""The bisection finds the largest value survived, and no lucky island."""

from __future__ import annotations

from math import inf

import pytest
from hypothesis import given
from hypothesis import strategies as st

from preview_walk.errors import InvalidInput
from preview_walk.studies.margin import Margin, largest


@given(st.floats(0.5, 99.5), st.floats(0.1, 5.0))
def test_it_ends_within_its_precision_below_the_limit(limit: float, precision: float) -> None:
    found = largest(Margin("x", 0.0, 100.0, precision), lambda value: value < limit)
    assert found.margin < limit <= found.fatal
    assert found.fatal - found.margin <= precision
    assert found.islands == 0


def test_what_survives_everything_has_the_highest_value_and_no_fatal_one() -> None:
    found = largest(Margin("x", 0.0, 100.0, 1.0), lambda value: True)
    assert (found.margin, found.fatal) == (100.0, inf)


def test_what_survives_nothing_has_the_lowest() -> None:
    found = largest(Margin("x", 5.0, 100.0, 1.0), lambda value: False)
    assert found.margin == 5.0
    assert 5.0 < found.fatal <= 6.0


def test_an_island_above_the_smallest_fatal_value_does_not_count() -> None:
    """Survived but between 30 and 40, and up to 60: the strides step over the gap."""
    margin = Margin("x", 0.0, 100.0, 1.0, smaller=12)
    found = largest(margin, lambda value: value < 60.0 and not 30.0 < value < 40.0)
    assert found.margin <= 30.0 < found.fatal < 40.0
    assert found.islands > 0
    assert found.tried == tuple(sorted(found.tried))


@pytest.mark.parametrize("values", [(1.0, 1.0, 0.1), (0.0, 1.0, 0.0), (0.0, float("nan"), 0.1)])
def test_a_margin_that_cannot_be_is_refused(values: tuple[float, float, float]) -> None:
    with pytest.raises(InvalidInput):
        Margin("x", *values)
