import itertools

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.optimize import linprog

from preview_walk.robots.robot import Robot
from preview_walk.tracking.contacts import (
    MIN_SHARE,
    contact_rows,
    load_shares,
    sole_cone,
    wrench_cone,
)
from preview_walk.types import Array

X, Y, MU = 0.1, 0.06, 0.7
CORNERS = [np.array([a * X, b * Y, 0.0]) for a, b in itertools.product((1, -1), (1, -1))]
EDGES = [
    np.array([a * MU / np.sqrt(2), b * MU / np.sqrt(2), 1.0])
    for a, b in itertools.product((1, -1), (1, -1))
]
"""The edges of the friction pyramid inscribed in the cone."""
SPAN = np.array([np.concatenate([f, np.cross(p, f)]) for p in CORNERS for f in EDGES]).T
"""(6, 16): wrenches of one edge force at one corner; their cone is all that a sole can carry."""


@given(st.lists(st.floats(0.0, 100.0), min_size=16, max_size=16))
def test_forces_at_the_corners_are_inside(weights: list[float]) -> None:
    assert (wrench_cone(X, Y, MU) @ SPAN @ np.array(weights) <= 1e-9).all()


@pytest.mark.parametrize("seed", range(300))
def test_brute_force_agrees_on_inside_and_outside(seed: int) -> None:
    # Near the boundary, where it is hard: random combinations of corner forces, then a nudge.
    rng = np.random.default_rng(seed)
    weights = rng.exponential(1.0, 16) * (rng.random(16) < 0.4)
    wrench = SPAN @ weights + rng.standard_normal(6) * np.array([0.3, 0.3, 0.3, 0.03, 0.03, 0.03])
    margin = float((wrench_cone(X, Y, MU) @ wrench).max())
    if abs(margin) < 1e-6:
        return
    possible = linprog(np.zeros(16), A_eq=SPAN, b_eq=wrench, bounds=(0, None)).status == 0
    assert possible == (margin < 0.0)


def test_the_cone_keeps_the_centre_of_pressure_off_the_edges(talos: Robot) -> None:
    sole = talos.soles["left"]
    cone = sole_cone(sole, 0.8)

    def pushed_at(x: float, y: float) -> Array:
        return np.array([0.0, 0.0, 500.0, 500.0 * y, -500.0 * x, 0.0])

    keep = 0.95  # a twentieth of the half size from each edge (docs/theory.md, section 8)
    for a, b in itertools.product((1, -1), (1, -1)):
        x, y = a * keep * sole.half_length, b * keep * sole.half_width
        assert (cone @ pushed_at(0.999 * x, 0.999 * y) <= 0.0).all()
        assert (cone @ pushed_at(1.01 * x, 0.5 * y)).max() > 0.0
        assert (cone @ pushed_at(0.5 * x, 1.01 * y)).max() > 0.0


def test_contact_rows_of_two_soles_are_blocks(talos: Robot) -> None:
    soles = [talos.soles["left"], talos.soles["right"]]
    rows, low, high = contact_rows(soles, 0.8)
    assert rows.shape == (34, 12)
    np.testing.assert_array_equal(rows[:16, :6], sole_cone(soles[0], 0.8))
    np.testing.assert_array_equal(rows[17:33, 6:], sole_cone(soles[1], 0.8))
    assert not rows[:17, 6:].any()
    assert not rows[17:, :6].any()
    np.testing.assert_array_equal(rows[[16, 33]], np.eye(12)[[2, 8]])
    np.testing.assert_array_equal(low[[16, 33]], 0.0)
    assert np.isposinf(high[[16, 33]]).all()
    assert np.isneginf(np.delete(low, [16, 33])).all()


@given(st.floats(-1.0, 1.0), st.floats(-1.0, 1.0), st.floats(-0.5, 1.5))
def test_load_shares_follow_the_lever_rule(x: float, y: float, along: float) -> None:
    first, second = (x, y), (x + 0.2, y - 0.15)
    shares = load_shares((x + along * 0.2, y - along * 0.15), first, second)
    assert sum(shares) == pytest.approx(1.0)
    assert min(shares) >= MIN_SHARE
    if MIN_SHARE < along < 1.0 - MIN_SHARE:
        assert shares[1] == pytest.approx(along)


def test_load_shares_of_soles_at_one_place() -> None:
    assert load_shares((1.0, 1.0), (0.0, 0.0), (0.0, 0.0)) == (0.5, 0.5)
