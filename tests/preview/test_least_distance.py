"""The least x within half-spaces: against another solver, and where there is none."""

import numpy as np
import pytest
import qpsolvers

from preview_walk.preview.least_distance import least_distance


@pytest.mark.parametrize("seed", range(20))
def test_no_x_within_the_bounds_is_less(seed: int) -> None:
    rng = np.random.default_rng(seed)
    n, k = int(rng.integers(2, 30)), int(rng.integers(1, 60))
    rows = rng.normal(size=(k, n)) * 10.0 ** rng.uniform(-3, 3, size=(k, 1))
    inside = 10.0 ** rng.uniform(-3, 3) * rng.normal(size=n)
    bounds = rows @ inside + np.linalg.norm(rows, axis=1) * rng.uniform(0, 1, size=k)
    found = least_distance(rows, bounds)
    expected = qpsolvers.solve_qp(np.eye(n), np.zeros(n), rows, bounds, solver="daqp")
    assert found == pytest.approx(expected, abs=1e-6 * max(1.0, np.abs(inside).max()))
    sizes = np.linalg.norm(rows, axis=1)
    assert ((rows @ found - bounds) / sizes).max() < 1e-11 * max(1.0, np.abs(bounds / sizes).max())


def test_nothing_is_least_where_it_may_be() -> None:
    assert (least_distance(np.eye(3), np.zeros(3)) == np.zeros(3)).all()


def test_bounds_that_contradict_have_no_x() -> None:
    assert least_distance(np.array([[1.0, 0.0], [-1.0, 0.0]]), np.array([-1.0, 0.9])) is None
    assert least_distance(np.array([[0.0, 0.0], [1.0, 0.0]]), np.array([-1.0, 0.9])) is None
    assert least_distance(np.array([[1.0, 0.0], [-1.0, 0.0]]), np.array([-1.0, 1.0])) is not None
