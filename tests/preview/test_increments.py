"""Weights on states, inputs and their increments in one cost, against its optimum."""

import numpy as np
import pytest
from preview.brute_force import least_squares, solution

from preview_walk.preview.gains import preview_gains
from preview_walk.preview.increments import with_increments
from preview_walk.preview.plant import read_plant
from preview_walk.preview.response import track

A = np.array([[1.02, 0.1, 0.0], [0.0, 0.9, 0.2], [0.0, -0.1, 0.8]])
B = np.array([[0.1, 0.0], [0.5, 0.2], [0.0, 1.0]])
C = np.array([[1.0, 0.0, 0.2], [0.0, 0.5, 1.0]])
E = np.array([[0.1], [0.3], [-0.2]])
Q_E, Q_X, Q_DX = np.diag([1.0, 2.0]), 0.05 * np.eye(3), np.diag([0.3, 0.0, 0.2])
R, R_DU = np.array([[0.2, 0.1], [0.1, 0.3]]), np.diag([0.6, 0.4])


@pytest.mark.parametrize("feedthrough", [0.0, 0.4])
def test_one_cost_of_states_inputs_and_increments(feedthrough: float) -> None:
    """The cost is that of the servo without integral action and the increments' part of the other.

    Both are sums of squares: their least-squares rows stand one below the other.
    """
    own = A, B, C, feedthrough * np.eye(2)
    plant, rng = read_plant(own, E=E), np.random.default_rng(5)
    r, w, x0 = rng.normal(size=(161, 2)), 0.1 * rng.normal(size=(160, 1)), rng.normal(size=3)
    r[90:], w[90:] = r[90], 0.0
    parts = [
        least_squares(plant, (Q_E, Q_X, R), (r, w), x0, integral=False),
        least_squares(plant, (np.zeros((2, 2)), Q_DX, R_DU), (r, w), x0),
    ]
    matrix, right = (np.concatenate([part[i] for part in parts]) for i in (0, 1))
    expected = solution(matrix, right).reshape(-1, 2)

    weight = np.zeros((7, 7))
    weight[:2, :2], weight[2:5, 2:5], weight[5:, 5:] = Q_E, Q_DX, R_DU
    both, on_x = with_increments(own, E=E), np.zeros((8, 8))
    on_x[:3, :3] = Q_X
    design = preview_gains(both, weight, on_x, R, 90, integral=False)
    reference = np.pad(r[:160], ((0, 0), (0, 5)))
    run = track(design, reference, np.concatenate([x0, x0, np.zeros(2)]), disturbance=w)
    np.testing.assert_allclose(run.u[:60], expected[:60], atol=1e-8)
    np.testing.assert_allclose(run.y[1:, 2:5], np.diff(run.x[:, :3], axis=0), atol=1e-12)
    np.testing.assert_allclose(run.y[:, 5:], np.diff(run.u, axis=0, prepend=0.0), atol=1e-12)
    assert both.outputs == ("y[0]", "y[1]", "x[0]_increment", "x[1]_increment", "x[2]_increment",
                            "u[0]_increment", "u[1]_increment")  # fmt: skip


def test_without_weight_on_increments_it_is_the_plain_servo() -> None:
    plain = preview_gains((A, B, C, np.zeros((2, 2))), Q_E, Q_X, R, 40, integral=False)
    on_x = np.concatenate([np.full(3, 0.05), np.zeros(5)])
    both = with_increments((A, B, C, np.zeros((2, 2))))
    design = preview_gains(both, [1.0, 2.0, 0, 0, 0, 0, 0], on_x, R, 40, integral=False)
    np.testing.assert_allclose(design.state_gain[:, :3], plain.state_gain, atol=1e-9)
    np.testing.assert_allclose(design.state_gain[:, 3:], 0.0, atol=1e-9)
    np.testing.assert_allclose(design.preview_gain[..., :2], plain.preview_gain, atol=1e-9)
