"""The cart-table model against `control.c2d` and against calculus."""

import math
import re

import control
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from preview_walk.errors import InvalidInput
from preview_walk.preview.cart_table import (
    GRAVITY,
    cart_table,
    natural_frequency,
    transition,
    zmp_output,
)


@given(z_c=st.floats(0.2, 2.0), dt=st.floats(5e-4, 0.05))
def test_sampled_model_is_the_zero_order_hold_of_the_continuous_one(z_c: float, dt: float) -> None:
    sampled = cart_table(z_c, dt)
    expected = control.c2d(cart_table(z_c), dt, "zoh")
    assert sampled.dt == dt
    for name in "ABCD":
        np.testing.assert_allclose(getattr(sampled, name), getattr(expected, name), atol=1e-15)


def test_continuous_model_is_the_cart_table_equation() -> None:
    """p = c - z_c / g c'': the transfer function jerk -> ZMP is (1 - z_c / g s^2) / s^3."""
    system = cart_table(0.814)
    assert system.dt == 0
    s = 2.0 + 3.0j
    assert system(s) == pytest.approx((1 - 0.814 / GRAVITY * s**2) / s**3)
    omega = natural_frequency(0.814)
    np.testing.assert_allclose(sorted(system.zeros().real), [-omega, omega])


@given(st.floats(-1.0, 1.0), st.floats(-1.0, 1.0))
def test_transitions_compose(first: float, second: float) -> None:
    a1, b1 = transition(first)
    a2, b2 = transition(second)
    a, b = transition(first + second)
    np.testing.assert_allclose(a2 @ a1, a, atol=1e-14)
    np.testing.assert_allclose(a2 @ b1 + b2, b, atol=1e-14)


def test_transition_follows_a_cubic() -> None:
    """c(t) = 1 + 2 t + 3 t^2 + 4 t^3 has the constant jerk 24."""
    a, b = transition(0.7)
    x = a @ [1.0, 2.0, 6.0] + b[:, 0] * 24.0
    t = 0.7
    expected = [1 + 2 * t + 3 * t**2 + 4 * t**3, 2 + 6 * t + 12 * t**2, 6 + 24 * t]
    np.testing.assert_allclose(x, expected, rtol=1e-15)


def test_a_cart_at_rest_has_its_zmp_below_it_and_names_its_signals() -> None:
    assert (zmp_output(0.8) @ [0.3, 1.0, 0.0]).item() == 0.3
    system = cart_table(0.8, 0.005)
    assert system.state_labels == ["com", "velocity", "acceleration"]
    assert (system.input_labels, system.output_labels) == (["jerk"], ["zmp"])


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        ((0.0, 0.01), "expected z_c to be a positive number of m, got 0.0."),
        ((math.nan, 0.01), "expected z_c to be a positive number of m, got nan."),
        ((0.8, 0.0), "expected dt to be a positive number of s, got 0.0."),
        ((0.8, math.inf), "expected dt to be a positive number of s, got inf."),
        ((0.8, 0.01, -9.81), "expected gravity to be a positive number of m/s^2, got -9.81."),
    ],
)
def test_refusals(arguments: tuple[float, ...], sentence: str) -> None:
    with pytest.raises(InvalidInput, match=f"^{re.escape(sentence)}$"):
        cart_table(*arguments)
