import daqp
import numpy as np
import pytest

from preview_walk.tracking.qp.active_set import nearest_point
from preview_walk.types import Array


def random_polyhedron(seed: int, n: int = 8, m: int = 24) -> tuple[Array, Array, Array, Array]:
    """Return gradient, rows, low, high: some rows two-sided, some equal, some nearly parallel."""
    rng = np.random.default_rng(seed)
    rows = rng.standard_normal((m, n))
    rows[1] = rows[0] + 1e-3 * rng.standard_normal(n)
    rows /= np.linalg.norm(rows, axis=1)[:, None]
    inside = rows @ rng.standard_normal(n)
    low = np.where(rng.random(m) < 0.5, -np.inf, inside - rng.exponential(0.5, m))
    high = np.where(rng.random(m) < 0.2, np.inf, inside + rng.exponential(0.5, m))
    low[2] = high[2] = inside[2]
    return 5.0 * rng.standard_normal(n), rows, low, high


@pytest.mark.parametrize("seed", range(60))
def test_against_daqp(seed: int) -> None:
    gradient, rows, low, high = random_polyhedron(seed)
    sense = np.where(low == high, 5, 0).astype(np.int32)
    exact, _, flag, _ = daqp.solve(
        np.eye(8), gradient, rows, np.minimum(high, 1e30), np.maximum(low, -1e30), sense
    )
    assert flag == 1
    found = nearest_point(gradient, rows, low, high, np.zeros(24))
    assert found is not None
    np.testing.assert_allclose(found[0], exact, atol=1e-6)


@pytest.mark.parametrize("seed", range(60))
def test_optimality_conditions_from_any_guess(seed: int) -> None:
    gradient, rows, low, high = random_polyhedron(seed)
    guess = np.random.default_rng(seed + 1).standard_normal(24)
    found = nearest_point(gradient, rows, low, high, guess)
    assert found is not None
    x, y = found
    values = rows @ x
    np.testing.assert_allclose(x + gradient + rows.T @ y, 0.0, atol=1e-7)
    assert (values <= high + 1e-8).all()
    assert (values >= low - 1e-8).all()
    np.testing.assert_allclose((values - high)[y > 0.0], 0.0, atol=1e-7)
    np.testing.assert_allclose((values - low)[y < 0.0], 0.0, atol=1e-7)


def test_its_own_multipliers_are_a_perfect_guess() -> None:
    gradient, rows, low, high = random_polyhedron(0)
    first = nearest_point(gradient, rows, low, high, np.zeros(24))
    assert first is not None
    again = nearest_point(gradient, rows, low, high, first[1])
    assert again is not None
    np.testing.assert_allclose(again[0], first[0], atol=1e-10)


def test_no_point() -> None:
    rows = np.array([[1.0, 0.0], [1.0, 0.0]])
    low, high = np.array([-np.inf, 1.0]), np.array([0.0, np.inf])
    assert nearest_point(np.zeros(2), rows, low, high, np.zeros(2)) is None
