from typing import Any

import numpy as np
import pytest
from tracking.states import busy_problem

from preview_walk.robots.robot import Robot
from preview_walk.tracking.qp.condensing import CondensedQP, NotSolvable
from preview_walk.tracking.qp.problem import TickProblem
from preview_walk.types import Array, Foot

BOTH: tuple[Foot, Foot] = ("left", "right")


def without_limits(p: TickProblem) -> tuple[Array, Array]:
    """Return accelerations and wrenches that solve the QP with its equalities alone."""
    qp: Any = p.build()
    size = p.nv + p.nf
    count = len(qp.b)
    kkt = np.zeros((size + count, size + count))
    kkt[:size, :size] = qp.P[:size, :size]
    kkt[size:, :size] = qp.A[:, :size]
    kkt[:size, size:] = qp.A[:, :size].T
    z = np.linalg.solve(kkt, np.concatenate([-qp.q[:size], qp.b]))
    return p.split(z)


@pytest.mark.parametrize("feet", [BOTH, ("left",), ("right",)])
@pytest.mark.parametrize("seed", range(3))
def test_free_minimiser_is_that_of_the_whole_qp(
    robot: Robot, feet: tuple[Foot, ...], seed: int
) -> None:
    p = busy_problem(robot, seed, *feet)
    e = CondensedQP(p, ())
    e.reduce()
    w = -np.linalg.solve(e.factor @ e.factor.T, e.gradient)
    e.expand(w)
    acceleration, wrench = without_limits(p)
    scale = np.abs(acceleration).max()
    np.testing.assert_allclose(e.acceleration, acceleration, atol=1e-6 * scale)
    np.testing.assert_allclose(w, wrench, atol=1e-6 * np.abs(wrench).max())


@pytest.mark.parametrize("working_set", [(), (3, 40), (0, 31, 33, 60)])
def test_any_wrench_comes_with_consistent_dynamics(
    talos: Robot, working_set: tuple[int, ...]
) -> None:
    p = busy_problem(talos, 1)
    e = CondensedQP(p, working_set)
    e.reduce()
    rng = np.random.default_rng(0)
    for _ in range(5):
        w = np.concatenate(
            [200.0 * rng.standard_normal(p.nf), rng.standard_normal(len(working_set))]
        )
        e.expand(w)
        residual = p.forces(e.acceleration, w[: p.nf])[:6]
        # Wild wrenches ask for accelerations of 1e4 rad/s^2: the bound is to the forces at play.
        inertia = float(np.abs(p.mass @ e.acceleration).max())
        assert np.abs(residual).max() <= 1e-6 * max(9.81 * talos.mass, inertia)


def test_watched_torques_take_their_values(talos: Robot) -> None:
    p = busy_problem(talos, 2)
    working_set = (2, 17, 30)
    e = CondensedQP(p, working_set)
    e.reduce()
    u = np.array([5.0, -12.0, 40.0])
    e.expand(np.concatenate([np.zeros(p.nf), u]))
    np.testing.assert_allclose(e.torques[list(working_set)], u, atol=1e-5)


def test_watching_a_limit_that_is_not_reached_changes_nothing(talos: Robot) -> None:
    p = busy_problem(talos, 3)
    free, watching = CondensedQP(p, ()), CondensedQP(p, (5, 20, 50))
    for e in (free, watching):
        e.reduce()
        e.expand(-np.linalg.solve(e.factor @ e.factor.T, e.gradient))
    np.testing.assert_allclose(watching.torques, free.torques, atol=1e-5)


def test_the_remaining_cost_is_that_of_the_whole_qp(talos: Robot) -> None:
    p = busy_problem(talos, 4)
    e = CondensedQP(p, ())
    e.reduce()
    qp: Any = p.build()

    def whole(w: Array) -> float:
        e.expand(w)
        z = np.concatenate([e.acceleration, w / p.unit, np.zeros(p.n)])
        return float(0.5 * z @ qp.P @ z + qp.q @ z)

    def left(w: Array) -> float:
        return float(0.5 * np.sum((e.factor.T @ w) ** 2) + e.gradient @ w)

    rng = np.random.default_rng(1)
    zero = np.zeros(p.nf)
    for _ in range(5):
        w = 100.0 * rng.standard_normal(p.nf)
        assert left(w) - left(zero) == pytest.approx(whole(w) - whole(zero), rel=1e-6)


@pytest.mark.parametrize("part", ["rows", "target"])
def test_values_that_are_not_finite(talos: Robot, part: str) -> None:
    p = busy_problem(talos, 5)
    getattr(p, part)[0] = np.nan
    e = CondensedQP(p, ())
    with pytest.raises(NotSolvable, match="are not finite"):
        solve_free(e)


def solve_free(e: CondensedQP) -> None:
    e.reduce()
    e.free()


def test_in_the_air_there_is_nothing_left_to_solve(talos: Robot) -> None:
    p = busy_problem(talos, 6)
    air = TickProblem(talos, (), p.tasks, p.posture, wrench_weight=1e-3, friction=0.8)
    assert CondensedQP(air, ()).size == 0
