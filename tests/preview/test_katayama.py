"""The type-one servo of Katayama, Ohki, Inoue and Kato (1985): by hand, and what the paper claims.

The paper's own example is a power plant whose numbers are not at hand; the plants here are of its
class, the expected values are worked out by hand or by brute force.
"""

import numpy as np
import pytest
from preview.brute_force import optimal_input

from preview_walk.preview.gains import preview_gains
from preview_walk.preview.response import track
from preview_walk.types import Array

# Two lags that are coupled, with a slow drum behind the second: asymptotically stable, 2 by 2.
A = np.array([[0.9, 0.05, 0.0], [0.0, 0.8, 0.0], [0.1, 0.05, 0.95]])
B = np.array([[0.2, 0.0], [0.0, 0.3], [0.0, 0.05]])
C = np.array([[1.0, 0.0, 0.0], [0.0, 0.3, 1.0]])
WEIGHTS = (np.diag([1.0, 2.0]), 0.1 * np.eye(3), np.diag([0.5, 0.2]))


def demand(samples: int) -> Array:
    """Return two demands that ramp one after the other and then hold."""
    t = np.arange(samples, dtype=float)
    return np.column_stack([np.interp(t, [20, 40], [0, 1]), np.interp(t, [30, 35], [0, -0.5])])


def test_a_delay_of_one_sample_by_hand() -> None:
    """y(k+1) = u(k): with Q_e = 1 and R = 2 the Riccati equation is P^2 = Q_e (R + P), P = 2.

    So G_I = P / (R + P) = 1/2, no state feedback, A_c = 1 - G_I = 1/2, and G_d(l) = -(1/2)^l.
    """
    design = preview_gains(([[0.0]], [[1.0]], [[1.0]], [[0.0]]), 1.0, 0.0, 2.0, 12)
    assert design.integral_gain.item() == pytest.approx(0.5, abs=1e-14)
    assert design.state_gain.item() == pytest.approx(0.0, abs=1e-14)
    expected = -(0.5 ** np.arange(1, 13))
    np.testing.assert_allclose(design.preview_gain[:, 0, 0], expected, rtol=1e-12)
    # A step at sample 20, where y - r = R (y(k+1) - 2 y(k) + y(k-1)) with factors of 1/2 to both
    # sides: y = (2/3) 2^j before it and 1 - (1/3) 2^-j from it on, j samples away.
    run = track(design, np.repeat([0.0, 1.0], 20))
    expected = np.array([1 / 12, 1 / 6, 1 / 3, 2 / 3, 5 / 6, 11 / 12, 23 / 24])
    np.testing.assert_allclose(run.y[17:24, 0], expected, atol=1e-6)


def test_the_gains_are_the_least_cost() -> None:
    """The law's inputs against the optimum of the whole run, found without a Riccati equation."""
    design = preview_gains((A, B, C, np.zeros((2, 2))), *WEIGHTS, 150)
    r, x0 = demand(241), np.array([0.3, -0.2, 0.1])
    expected = optimal_input(design.plant, WEIGHTS, (r, np.zeros((240, 0))), x0)
    np.testing.assert_allclose(track(design, r[:-1], x0).u[:60], expected[:60], atol=1e-8)


def test_complete_regulation_by_a_perturbed_plant_with_a_disturbance_not_measured() -> None:
    """The abstract's claim: no error remains though plant and load are not the design's."""
    design = preview_gains((A, B, C, np.zeros((2, 2))), *WEIGHTS, 60)
    rng = np.random.default_rng(2)
    a, b, c = (m * (1.0 + 0.05 * rng.uniform(-1, 1, m.shape)) for m in (A, B, C))
    r, x = demand(600), np.zeros(3)
    held, errors = np.pad(r, ((0, 60), (0, 0)), "edge"), []
    # As the paper has it: du from the increments of the state that was measured and of the error.
    u, before = np.zeros(2), x
    for k in range(600):
        error = c @ x - r[k]
        ahead = np.diff(held[k : k + 61], axis=0)
        du = -design.integral_gain @ error - design.state_gain @ (x - before)
        du -= np.einsum("lmp,lp->m", design.preview_gain, ahead)
        u, before = u + du, x
        x = a @ x + b @ u + 0.1
        errors.append(error)
    assert np.abs(errors[-1]).max() < 1e-9
    assert np.abs(np.array(errors)).max() > 0.05


@pytest.mark.filterwarnings("ignore::preview_walk.preview.horizon.ShortHorizonWarning")
def test_preview_makes_the_transient_cheaper_the_more_the_further() -> None:
    costs = []
    for n in (0, 3, 10, 30, 100):
        run = track(preview_gains((A, B, C, np.zeros((2, 2))), *WEIGHTS, n), demand(200))
        du, dx = (np.diff(v, axis=0, prepend=0.0 * v[:1]) for v in (run.u, run.x))
        parts = zip((run.error, dx, du), WEIGHTS, strict=True)
        costs.append(sum(float(np.einsum("ki,ij,kj", v, q, v)) for v, q in parts))
    assert costs == sorted(costs, reverse=True)
    assert costs[-1] < 0.5 * costs[0]
