"""Quintics against the six conditions that make them, and numerical derivatives."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from preview_walk.geometry.quintic import Quintic

numbers = st.floats(-3.0, 3.0)
states = st.tuples(numbers, numbers, numbers)
spans = st.tuples(st.floats(-5.0, 5.0), st.floats(0.2, 2.0)).map(lambda s: (s[0], sum(s)))


@given(spans, states, states)
def test_has_the_states_at_its_ends_and_holds_them_outside(span, first, last):
    start, end = span
    path = Quintic.between(start, end, first, last)
    for t, state in ((start, first), (start - 1.0, first), (end, last), (end + 1.0, last)):
        assert path.at(t) == pytest.approx(state, abs=1e-8)


@given(spans, states, states)
def test_velocity_and_acceleration_are_derivatives(span, first, last):
    start, end = span
    path = Quintic.between(start, end, first, last)
    h = 1e-4 * (end - start)
    for t in np.linspace(start, end, 7)[1:-1].tolist():
        before, now, after = (path.at(t + k * h) for k in (-1, 0, 1))
        # Central differences of second order; third derivatives are some hundreds at most.
        scale = 1.0 + max(map(abs, (*first, *last))) / min(1.0, end - start) ** 4
        assert now[1] == pytest.approx((after[0] - before[0]) / (2 * h), abs=1e-4 * scale)
        assert now[2] == pytest.approx((after[1] - before[1]) / (2 * h), abs=1e-4 * scale)


@given(spans, states, states)
def test_many_accelerations_at_once_are_those_one_by_one(span, first, last):
    path = Quintic.between(*span, first, last)
    t = np.linspace(*span, 50)
    one_by_one = [path.at(s)[2] for s in t.tolist()]
    # At the last time rounding may put u beyond 1, where `at` holds the end.
    assert np.allclose(path.accelerations(t), one_by_one, rtol=1e-12, atol=1e-9)
