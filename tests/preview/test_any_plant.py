"""Any plant: feedthrough, disturbance, more and fewer outputs, against brute-force optima."""

import math
import warnings
from contextlib import suppress

import control
import numpy as np
import pytest
from preview.brute_force import optimal_input

from preview_walk.errors import InvalidInput
from preview_walk.preview.cart_table import cart_table
from preview_walk.preview.gains import preview_gains
from preview_walk.preview.response import track
from preview_walk.types import Array

H, COMPARED = 220, 40


def plant(outputs: int, inputs: int, feedthrough: bool) -> tuple[Array, Array, Array, Array]:
    """Return a plant of 4 states, one of them unstable."""
    rng = np.random.default_rng(10 * outputs + inputs)
    a = np.diag([1.03, 0.8, 0.6, 0.7]) + 0.1 * np.triu(rng.normal(size=(4, 4)), 1)
    d = 0.5 * rng.normal(size=(outputs, inputs)) * feedthrough
    return a, rng.normal(size=(4, inputs)), rng.normal(size=(outputs, 4)), d


def future(outputs: int, disturbances: int = 2) -> tuple[Array, Array]:
    """Return r and w that change for 60 samples and then hold."""
    rng = np.random.default_rng(5)
    r = np.repeat(rng.normal(size=(12, outputs)), 5, axis=0)
    w = 0.3 * np.repeat(rng.normal(size=(15, disturbances)), 4, axis=0)
    tail = ((0, H - 60), (0, 0))
    return np.pad(r, ((0, H - 59), (0, 0)), "edge"), np.pad(w, tail, "edge")


@pytest.mark.parametrize("feedthrough", [False, True])
@pytest.mark.parametrize("integral", [True, False])
@pytest.mark.parametrize(("outputs", "inputs"), [(2, 2), (1, 2), (3, 2), (3, 1)])
def test_the_servo_is_the_optimum(
    outputs: int, inputs: int, integral: bool, feedthrough: bool
) -> None:
    """MIMO with disturbance preview; more outputs than inputs by weight."""
    system = plant(outputs, inputs, feedthrough)
    rng = np.random.default_rng(1)
    root = rng.normal(size=(4, 4))
    weights = (
        np.diag([2.0, 0.5, 1.0][:outputs]) + 0.2,
        0.05 * root @ root.T,
        np.array([[0.3, 0.1], [0.1, 0.2]])[:inputs, :inputs],
    )
    e, x0 = rng.normal(size=(4, 2)), rng.normal(size=4)
    design = preview_gains(system, *weights, 190, E=e, integral=integral)
    r, w = future(outputs)
    expected = optimal_input(design.plant, weights, (r, w), x0, integral=integral)
    run = track(design, r[:-1], x0, disturbance=w)
    np.testing.assert_allclose(run.u[:COMPARED], expected[:COMPARED], atol=1e-8)


def test_an_output_without_weight_is_left_alone() -> None:
    a, b, c, d = plant(2, 1, False)
    both = preview_gains((a, b, c, d), [1.0, 0.0], 0.1, 0.2, 60)
    alone = preview_gains((a, b, c[:1], d[:1]), 1.0, 0.1, 0.2, 60)
    np.testing.assert_allclose(both.feedback, alone.feedback, rtol=1e-9, atol=1e-12)
    np.testing.assert_allclose(both.window_gain[..., :1], alone.window_gain, atol=1e-12)
    assert np.abs(both.window_gain[..., 1:]).max() < 1e-12


@pytest.mark.parametrize("feedthrough", [False, True])
def test_a_final_cost_gives_the_first_step_of_the_n_step_optimum(feedthrough: bool) -> None:
    system, n = plant(2, 2, feedthrough), 12
    rng = np.random.default_rng(2)
    root = rng.normal(size=(6, 6))
    weights, final = (np.eye(2), 0.1 * np.eye(4), 0.2 * np.eye(2)), root @ root.T
    e, x0 = rng.normal(size=(4, 1)), rng.normal(size=4)
    design = preview_gains(system, *weights, n, E=e, final_cost=final)
    r, w = rng.normal(size=(n + 1, 2)), rng.normal(size=(n, 1))
    expected = optimal_input(design.plant, weights, (r, w), x0, final=final)
    first = track(design, r, x0, disturbance=np.append(w, w[-1:], axis=0)).u[0]
    np.testing.assert_allclose(first, expected[0], atol=1e-10)


def test_the_riccati_solution_as_final_cost_changes_nothing() -> None:
    system = plant(2, 2, True)
    whole = preview_gains(system, 1.0, 0.1, 0.2, 30, E=np.ones(4))
    finite = preview_gains(system, 1.0, 0.1, 0.2, 30, E=np.ones(4), final_cost=whole.riccati)
    for name in ("integral_gain", "state_gain", "preview_gain", "disturbance_gain", "feedback"):
        np.testing.assert_allclose(getattr(finite, name), getattr(whole, name), atol=1e-9)


@pytest.mark.parametrize("feedthrough", [False, True])
def test_no_preview_is_the_loop_of_dlqr(feedthrough: bool) -> None:
    """N = 0: LQR of the error-augmented system [e; dx], written out, and `control.dlqr`."""
    a, b, c, d = plant(2, 2, feedthrough)
    phi = np.block([[np.eye(2), c @ a], [np.zeros((4, 2)), a]])
    g = np.vstack([c @ b + d, b])
    q, cross = np.diag([1.0, 1.0, *[0.1] * 4]), np.vstack([d, np.zeros((4, 2))])
    gain = control.dlqr(phi, g, q, 0.2 * np.eye(2) + d.T @ d, cross)[0]
    design = preview_gains((a, b, c, d), 1.0, 0.1, 0.2, 0, E=np.ones(4))
    np.testing.assert_allclose(design.integral_gain, gain[:, :2], atol=1e-9)
    np.testing.assert_allclose(design.state_gain, gain[:, 2:], atol=1e-9)
    rng = np.random.default_rng(0)
    r, w = np.repeat(rng.normal(size=(10, 2)), 10, axis=0), np.repeat(rng.normal(size=10), 10)
    x = before = np.zeros(4)
    u, inputs = np.zeros(2), []
    for target, push in zip(r, w, strict=True):
        u = u - gain @ np.append(c @ x + d @ u - target, x - before)
        inputs.append(u)
        before, x = x, a @ x + b @ u + push
    run = track(design, r, disturbance=w)
    np.testing.assert_allclose(run.u, inputs, atol=1e-10)


def test_without_integral_action_no_preview_is_dlqr_about_the_target() -> None:
    a, b, c, d = plant(2, 2, False)
    gain = control.dlqr(a, b, c.T @ c + 0.1 * np.eye(4), 0.2 * np.eye(2))[0]
    design = preview_gains((a, b, c, d), 1.0, 0.1, 0.2, 0, integral=False)
    np.testing.assert_allclose(design.feedback, gain, atol=1e-9)


def test_an_endless_horizon_is_the_analytic_limit() -> None:
    """Frequency by frequency, y / r = q |G|^2 / (q |G|^2 + r |1 - 1/z|^2): no phase at all.

    It is what minimises q |G u - r|^2 + rho |(1 - 1/z) u|^2 over all inputs, past and future.
    """
    tf = control.tf([0.2, 0.1], [1.0, -1.5, 0.7], 0.1)
    design = preview_gains(tf, 3.0, 0.0, 0.4, math.inf)
    z = np.exp(1j * np.linspace(0.05, 3.0, 40))
    delays = z[:, None] ** np.arange(1, design.horizon + 1)
    action = delays @ design.window_gain[:, 0, 0]
    response = action * design.closed_loop(z)
    power = 3.0 * np.abs(tf(z)) ** 2
    limit = power / (power + 0.4 * np.abs(1.0 - 1.0 / z) ** 2)
    np.testing.assert_allclose(response, limit, atol=1e-8)


def test_jrl_walkgens_printed_gains() -> None:
    """T = 5 ms, z_c = 0.814 m, 320 samples: the gain file begins 618.7, 72719, 21550, 177.01."""
    design = preview_gains(cart_table(0.814, 0.005), 1.0, 0.0, 1e-6, 320)
    printed = [f"{design.integral_gain.item():.1f}"]
    printed += [f"{g:.5g}" for g in design.state_gain[0]]
    assert printed == ["618.7", "72719", "21550", "177.01"]


def test_a_continuous_plant_is_held_over_a_sample_with_its_disturbance() -> None:
    a, b = np.array([[0.0, 1.0], [-3.0, -0.4]]), np.array([[0.0], [1.0]])
    design = preview_gains(control.ss(a, b, [[1.0, 0.0]], 0), 1.0, 0.0, 0.1, 80, E=2.0 * b, dt=0.05)
    expected = control.c2d(control.ss(a, b, [[1.0, 0.0]], 0), 0.05)
    np.testing.assert_allclose(design.plant.A, expected.A, atol=1e-14)
    np.testing.assert_allclose(design.plant.E, 2.0 * expected.B, atol=1e-14)
    assert design.dt == design.system.dt == 0.05


def test_a_transfer_matrix_without_slycot() -> None:
    g = control.tf([[[1.0], [0.5]], [[0.2], [1.0]]], [[[1.0, -0.9], [1.0, -0.5]]] * 2, 0.1)
    design = preview_gains(g, 1.0, 0.0, 0.1, 40)
    z = 0.3 + 0.8j
    np.testing.assert_allclose(design.system(z), g(z), atol=1e-12)
    run = track(design, np.ones((200, 2)))
    np.testing.assert_allclose(run.y[-1], 1.0, atol=1e-9)


def test_the_callers_matrices_stay_the_callers() -> None:
    a, b, c, d = plant(2, 2, False)
    system, q = control.ss(a, b, c, d, 0.1), np.eye(2)
    design = preview_gains(system, q, 0.1, 0.2, 30)
    before = design.plant.A.copy()
    system.A[0, 0], q[0, 0] = 9.0, 9.0
    np.testing.assert_array_equal(design.plant.A, before)
    assert design.Q_e[0, 0] == 1.0
    for part in (design.system.A, design.system.B, design.plant.C, design.Q_e):
        assert not part.flags.writeable


@pytest.mark.parametrize(("q_e", "r"), [(7e6, 4e-12), (3e8, 6e-11)])
@pytest.mark.parametrize(
    ("z_c", "dt", "n"), [(0.8, 0.01, 100), (0.814, 0.005, 320), (0.3, 0.02, 50)]
)
def test_ill_conditioned_weights_give_a_servo_or_a_sentence(
    q_e: float, r: float, z_c: float, dt: float, n: int
) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        with suppress(InvalidInput):
            assert np.isfinite(preview_gains(cart_table(z_c, dt), q_e, 0.0, r, n).feedback).all()


def test_time_may_count_in_samples() -> None:
    matrices = [[0.9]], [[1.0]], [[1.0]], [[0.0]]
    same = preview_gains(matrices, 1.0, 0.0, 0.1, 30)
    for design in (
        same,
        preview_gains(matrices, 1.0, 0.0, 0.1, 30, dt=True),
        preview_gains((*matrices, True), 1.0, 0.0, 0.1, 30),
        preview_gains(control.ss(*matrices, True), 1.0, 0.0, 0.1, 30, dt=True),
    ):
        assert design.plant.dt is True
        assert design.system.dt is True
        assert design.dt == 1.0
        np.testing.assert_array_equal(design.preview_gain, same.preview_gain)
    for system in (control.ss(*matrices, 0), control.ss(*matrices, 0.1)):
        with pytest.raises(InvalidInput, match="dt"):
            preview_gains(system, 1.0, 0.0, 0.1, 30, dt=True)


def test_a_transfer_function_with_more_zeros_than_poles_is_refused() -> None:
    for system in (control.tf([1.0, 0.0], [1.0], 0.1), control.tf([1.0, 0.0, 1.0], [1.0, 2.0])):
        with pytest.raises(InvalidInput, match="more zeros than poles"):
            preview_gains(system, 1.0, 0.0, 0.1, 30, dt=0.1)
