import daqp
import numpy as np
import pytest
from tracking.states import busy_problem

from preview_walk.robots.robot import Robot
from preview_walk.tracking.qp.condensing import CondensedQP, inverse_factor
from preview_walk.tracking.qp.osqp_workspace import OsqpWorkspace
from preview_walk.tracking.qp.solvers import OsqpBackend
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


@pytest.mark.parametrize("iterations", [5, 50])
def test_agrees_with_daqp_whether_or_not_osqp_converges(robot: Robot, iterations: int) -> None:
    for seed in range(5):
        p = busy_problem(robot, seed)
        p.contact_high[16] = 0.05 * 9.81 * robot.mass  # a foot just landed
        e = CondensedQP(p, ())
        e.reduce()
        workspace = OsqpWorkspace(e, iterations)
        found = workspace.solve(np.zeros(len(e.constraints)))
        assert found is not None
        assert workspace.iterations <= iterations
        distance = np.linalg.norm(e.factor.T @ (found[0] - exact(e)))
        assert distance <= 1e-4


def test_warm_start_with_the_own_multipliers_needs_the_fewest_iterations(talos: Robot) -> None:
    p = busy_problem(talos, 1)
    p.contact_high[16] = 0.05 * 9.81 * talos.mass
    e = CondensedQP(p, ())
    e.reduce()
    workspace = OsqpWorkspace(e, 1000)
    first = workspace.solve(np.zeros(len(e.constraints)))
    cold = workspace.iterations
    assert first is not None
    again = workspace.solve(first[1])
    assert again is not None
    assert workspace.iterations < cold
    np.testing.assert_allclose(again[0], first[0], atol=0.05)


def test_variables_make_the_hessian_the_identity(talos: Robot) -> None:
    e = CondensedQP(busy_problem(talos, 2), ())
    e.reduce()
    inverse = inverse_factor(e.factor)
    hessian = inverse @ (e.factor @ e.factor.T) @ inverse.T
    np.testing.assert_allclose(hessian, np.eye(e.size), atol=1e-9)


def test_the_sparsity_never_changes(talos: Robot) -> None:
    backend = OsqpBackend()
    problems = [busy_problem(talos, seed) for seed in range(3)]
    for p in problems:
        backend.solve(p)
    used = [item for item in backend._workspaces.items() if item[1]._solver is not None]
    assert used
    for (problem, working_set), workspace in used:
        matrix = workspace._solver._derivative_cache["A"]
        rows = 17 * len(problem.contacts) + len(working_set)
        assert matrix.nnz == rows * (problem.nf + len(working_set))
