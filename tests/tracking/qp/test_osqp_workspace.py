import daqp
import numpy as np
import osqp
import pytest
import scipy.sparse as sparse
from tracking.states import busy_problem

from preview_walk.robots.robot import Robot
from preview_walk.tracking.qp.condensing import CondensedQP, NearestPoint
from preview_walk.tracking.qp.osqp_method import WarmOsqp
from preview_walk.tracking.qp.osqp_workspace import SETTINGS, OsqpWorkspace
from preview_walk.types import Array


def exact(e: CondensedQP) -> Array:
    """Return w by daqp on the same small QP."""
    w, _, flag, _ = daqp.solve(
        e.factor @ e.factor.T,
        e.gradient,
        e.constraints,
        np.minimum(e.high, 1e30),
        np.maximum(e.low, -1e30),
        np.zeros(len(e.low), dtype=np.int32),
        primal_tol=1e-11,
        dual_tol=1e-11,
    )
    assert flag == 1
    return np.asarray(w)


def hard(robot: Robot, seed: int) -> CondensedQP:
    """Return a QP of a foot that has just landed and may carry next to nothing."""
    p = busy_problem(robot, seed)
    p.contact_high[16] = 0.05 * 9.81 * robot.mass
    e = CondensedQP(p, ())
    e.reduce()
    return e


def workspace_for(qp: NearestPoint, spare: int = 0) -> OsqpWorkspace:
    """Return a workspace with room for so many limits more."""
    count, size = qp.rows.shape
    return OsqpWorkspace(count + spare, size + spare, burst=25)


@pytest.mark.parametrize("spare", [0, 5])
def test_agrees_with_daqp_also_where_it_has_room_to_spare(talos: Robot, spare: int) -> None:
    for seed in range(5):
        e = hard(talos, seed)
        qp = e.normalise()
        found = workspace_for(qp, spare).solve(qp, None, 40)
        assert found.optimal
        w = e.original(found.x)
        assert np.linalg.norm(e.factor.T @ (w - exact(e))) <= 1e-4


@pytest.mark.parametrize("iterations", [5, 50])
def test_agrees_with_daqp_whether_or_not_osqp_converges(robot: Robot, iterations: int) -> None:
    finished = []
    for seed in range(5):
        e = hard(robot, seed)
        qp = e.normalise()
        found = WarmOsqp(iterations).solve(qp, e.problem.contacts, None)
        assert found is not None
        assert found.iterations <= iterations
        finished.append(found.finished)
        w = e.original(found.x)
        assert np.linalg.norm(e.factor.T @ (w - exact(e))) <= 1e-4
    assert any(finished) or iterations > 5


@pytest.mark.parametrize("seed", [0, 2, 4])
def test_polished_multipliers_need_one_iteration(talos: Robot, seed: int) -> None:
    qp = hard(talos, seed).normalise()
    workspace = workspace_for(qp)
    first = workspace.solve(qp, None, 40)
    again = workspace.solve(qp, first.multipliers, 40)
    assert first.iterations > 1
    assert again.iterations == 1
    np.testing.assert_allclose(again.x, first.x, atol=1e-4)


def test_what_was_solved_before_leaves_no_trace(talos: Robot) -> None:
    large, small = hard(talos, 1).normalise(), hard(talos, 2).normalise()
    used, fresh = workspace_for(large, 3), workspace_for(large, 3)
    used.solve(large, None, 40)
    used.solve(small, None, 40)
    mine, clean = used.solve(large, None, 40), fresh.solve(large, None, 40)
    np.testing.assert_array_equal(mine.x, clean.x)
    assert mine.iterations == clean.iterations


def test_the_same_as_osqp_through_its_own_interface(talos: Robot) -> None:
    """The classes that are used are those beneath `osqp.OSQP`, which must not move away."""
    qp = hard(talos, 3).normalise()
    count, size = qp.rows.shape
    solver = osqp.OSQP()
    solver.setup(
        sparse.identity(size, format="csc"),
        qp.gradient,
        sparse.csc_matrix(qp.rows),
        qp.low,
        qp.high,
        **{**SETTINGS, "max_iter": 4000},
    )
    solver.warm_start(-qp.gradient, np.zeros(count))
    theirs = solver.solve(raise_error=True)
    mine = workspace_for(qp).solve(qp, None, 160)
    np.testing.assert_allclose(mine.x, theirs.x, atol=1e-4)


def test_variables_make_the_hessian_the_identity(talos: Robot) -> None:
    e = CondensedQP(busy_problem(talos, 2), ())
    e.reduce()
    qp = e.normalise()
    x = np.random.default_rng(0).standard_normal(e.size)
    w = e.original(x)
    cost = 0.5 * np.sum((e.factor.T @ w) ** 2) + e.gradient @ w
    assert 0.5 * x @ x + qp.gradient @ x == pytest.approx(cost, rel=1e-9)
    np.testing.assert_allclose(qp.length * (qp.rows @ x), e.constraints @ w, atol=1e-9)
    np.testing.assert_allclose(np.linalg.norm(qp.rows, axis=1), 1.0, rtol=1e-12)
