"""The preview servo against the optimum of its own cost, found without any Riccati equation."""

import re

import control
import numpy as np
import pytest
import scipy.sparse as sp
from preview.example_plants import KAJITA, kajita, two_by_two
from scipy.sparse.linalg import spsolve

from preview_walk.errors import InvalidInput
from preview_walk.preview.gains import preview_gains
from preview_walk.preview.response import Recursion, preview_effect, track
from preview_walk.types import Array


def optimum(
    system: control.StateSpace, weights: tuple[Array, Array, Array], r: Array, x0: Array
) -> tuple[Array, Array]:
    """Return x and u that minimise the servo's cost over len(r) samples, by sparse least squares.

    Unknowns x(1..H), u(0..H-1); rows: weighted errors, state and input increments; equality:
    the plant as it stands, no augmentation; u(-1) = 0.
    """
    h, n, m = len(r) - 1, system.nstates, system.ninputs
    q_e, q_x, q_u = (np.linalg.cholesky(w + 1e-300 * np.eye(len(w))).T for w in weights)
    identity, shift = sp.identity(h), sp.eye(h, k=-1)
    difference = identity - shift
    none_u, none_x = sp.csr_matrix((h * n, h * m)), sp.csr_matrix((h * m, h * n))
    rows = sp.bmat(
        [
            [sp.kron(identity, q_e @ system.C), sp.csr_matrix((h * len(q_e), h * m))],
            [sp.kron(difference, q_x), none_u],
            [none_x, sp.kron(difference, q_u)],
        ]
    )
    first = np.zeros((h, n))
    first[0] = q_x @ x0
    target = np.concatenate([(r[1:] @ q_e.T).ravel(), first.ravel(), np.zeros(h * m)])
    plant = sp.bmat([[sp.identity(h * n) - sp.kron(shift, system.A), -sp.kron(identity, system.B)]])
    start = np.zeros((h, n))
    start[0] = system.A @ x0
    # The augmented system of constrained least squares: no normal equations, no squared condition.
    matrix = sp.bmat(
        [
            [sp.identity(rows.shape[0]), rows, None],
            [rows.T, None, plant.T],
            [None, plant, None],
        ]
    )
    right = np.concatenate([target, np.zeros(rows.shape[1]), start.ravel()])
    solution = spsolve(matrix.tocsc(), right)[rows.shape[0] :]
    x = np.vstack([x0, solution[: h * n].reshape(h, n)])
    return x, solution[h * n : h * (n + m)].reshape(h, m)


def test_cart_table_converges_to_the_least_squares_optimum_as_the_horizon_grows() -> None:
    t = np.arange(1700) * 0.005
    reference = np.interp(t, [0.5, 0.6, 1.1, 1.2, 1.8, 1.9], [0, 0.1, 0.1, -0.1, -0.1, 0.05])
    weights = (np.eye(1), np.zeros((3, 3)), np.array([[1e-6]]))
    x, u = optimum(KAJITA, weights, reference[:, None], np.zeros(3))
    compared = slice(0, 400)
    gaps = []
    for horizon in (160, 320, 640, 1280):
        run = track(kajita(horizon), reference)
        gaps.append(np.abs(run.x[compared] - x[compared]).max())
    assert gaps[0] > 1e-4
    assert gaps[1] < 0.2 * gaps[0]
    assert gaps[2] < 0.2 * gaps[1]
    assert gaps[3] < 1e-8
    assert np.abs(run.u[compared] - u[compared]).max() < 1e-8 * np.abs(u).max()


def test_a_plant_of_two_inputs_and_outputs_reaches_the_least_squares_optimum() -> None:
    system = two_by_two()
    rng = np.random.default_rng(3)
    reference = np.repeat(rng.normal(size=(16, 2)), 5, axis=0)
    reference = np.vstack([reference, np.repeat(reference[-1:], 220, axis=0)])
    root = rng.normal(size=(4, 4))
    weights = (np.diag([2.0, 0.5]), 0.01 * root @ root.T, np.array([[0.3, 0.1], [0.1, 0.2]]))
    x0 = rng.normal(size=4)
    design = preview_gains(system, *weights, 200)
    x, u = optimum(system, weights, reference, x0)
    run = track(design, reference, x0)
    np.testing.assert_allclose(run.x[:80], x[:80], atol=1e-8)
    np.testing.assert_allclose(run.u[:80], u[:80], atol=1e-8)


def test_more_inputs_than_outputs() -> None:
    system = control.ss(two_by_two().A, two_by_two().B, two_by_two().C[:1], 0, 0.1)
    design = preview_gains(system, 1.0, 0.0, 0.1, 300)
    reference = np.r_[np.zeros(20), np.ones(400)]
    weights = (np.eye(1), np.zeros((4, 4)), 0.1 * np.eye(2))
    x, _ = optimum(system, weights, reference[:, None], np.zeros(4))
    np.testing.assert_allclose(track(design, reference).x[:60], x[:60], atol=1e-8)


def test_a_plant_with_a_delay() -> None:
    """A singular A, whose past cannot be computed backwards, is optimal from any start too."""
    system = control.ss([[0.9, 1.0], [0.0, 0.0]], [[0.0], [1.0]], [[1.0, 0.0]], 0, 0.1)
    reference = np.r_[np.zeros(10), np.ones(200)]
    weights = (np.eye(1), np.zeros((2, 2)), np.array([[2.0]]))
    x0 = np.array([0.3, -0.5])
    x, _ = optimum(system, weights, reference[:, None], x0)
    run = track(preview_gains(system, *weights, 200), reference, x0)
    np.testing.assert_allclose(run.x[:80], x[:80], atol=1e-8)


@pytest.mark.parametrize("length", [1, 2, 15, 16, 17, 256, 1000])
def test_recursion_in_blocks_is_the_recursion(length: int) -> None:
    rng = np.random.default_rng(length)
    a, b = 0.4 * rng.normal(size=(4, 4)), rng.normal(size=(4, 2))
    w, z = rng.normal(size=(3, length, 2)), rng.normal(size=(3, 4))
    result = Recursion(a, b).run(w, z)
    assert result.shape == (3, length, 4)
    for k in range(length):
        np.testing.assert_allclose(result[:, k], z, atol=1e-11)
        z = z @ a.T + w[:, k] @ b.T


def test_tracking_is_the_closed_loop_driven_by_the_preview_action() -> None:
    """The fast filter against `control.forced_response` and a plain correlation."""
    design = preview_gains(two_by_two(), 1.0, 0.1, 0.5, 60)
    reference = np.random.default_rng(1).normal(size=(1500, 2))
    padded = np.vstack([reference, np.repeat(reference[-1:], 60, axis=0)])
    action = np.array(
        [np.einsum("lmp,lp->m", design.window_gain, padded[k + 1 : k + 61]) for k in range(1500)]
    )
    expected = control.forced_response(design.closed_loop, inputs=action.T).outputs
    run = track(design, reference)
    np.testing.assert_allclose(run.y, expected.T, atol=1e-11)
    np.testing.assert_allclose(run.error, run.y - reference, atol=0)
    step = run.x[:-1] @ design.system.A.T + run.u[:-1] @ design.system.B.T
    np.testing.assert_allclose(run.x[1:], step, atol=1e-10)


def test_longer_horizons_leave_smaller_errors() -> None:
    """At rest nothing moves; a ramp costs less the earlier it is seen."""
    t = np.arange(1000) * 0.005
    errors = preview_effect(
        kajita(500), np.interp(t, [2.5, 2.6], [0.3, 0.4]), [20, 80, 160, 240, 320, 500]
    )
    assert errors.shape == (6, 1)
    assert np.all(np.diff(errors[:, 0]) < 0.0)
    assert errors[0, 0] > 0.05
    assert errors[-1, 0] < 0.005
    assert np.abs(preview_effect(kajita(), np.full(900, 0.3), [100, 320])).max() < 1e-12


def refused(sentence: str) -> pytest.RaisesExc[InvalidInput]:
    return pytest.raises(InvalidInput, match=f"^{re.escape(sentence)}$")


def test_tracking_refusals() -> None:
    design = kajita()
    with refused("expected a reference of shape (M, 1) with M >= 1, got shape (3, 2)."):
        track(design, np.zeros((3, 2)))
    with refused("expected a reference of shape (M, 1) with M >= 1, got shape (0,)."):
        preview_effect(design, [], [100])
    with refused("expected a finite reference, got NaN or infinity."):
        track(design, [0.0, np.nan])
    with refused("expected x0 to be 3 finite numbers, got [0, 1]."):
        track(design, np.zeros(5), [0, 1])
    with refused("expected horizons of 0 to 320 samples, got 321."):
        preview_effect(design, np.zeros(5), [321])
