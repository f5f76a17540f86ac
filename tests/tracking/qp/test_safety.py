import numpy as np
import pytest
import qpsolvers
from tracking.states import full_load, standing_controller

import preview_walk as pw
from preview_walk.robots.robot import Robot
from preview_walk.tracking.qp.problem import TickProblem
from preview_walk.tracking.qp.safety import (
    DAMPED_POSTURE,
    LAST_SOLUTION,
    SOLVED,
    STALE_TICKS,
    QPFailure,
)
from preview_walk.tracking.qp.solvers import Backend, Solution


class Broken:
    """A backend that fails in a chosen way while `broken`."""

    def __init__(self, backend: Backend, way: str) -> None:
        self.backend, self.way, self.broken = backend, way, True

    def solve(self, problem: TickProblem) -> Solution:
        right = self.backend.solve(problem)
        if not self.broken:
            return right
        if self.way == "raises":
            raise RuntimeError("out of order")
        bad = right.torques * (np.nan if self.way == "nan" else 1e3)
        return Solution(right.acceleration, right.wrench, bad, self.way == "nan", 7, "gave up")


@pytest.mark.parametrize("way", ["raises", "nan", "gives up"])
def test_last_solution_then_damped_posture_then_back(talos: Robot, way: str) -> None:
    body = standing_controller(talos)
    good = body.torques(full_load(talos))
    body.backend = broken = Broken(body.backend, way)
    assert STALE_TICKS <= 10  # 20 ms, in which a sole unloads: no longer does it fit the state
    for tick in range(STALE_TICKS):
        torques = body.torques(full_load(talos))
        assert body.status == LAST_SOLUTION
        assert body.failures == tick + 1
        np.testing.assert_allclose(torques, good, atol=1e-6)
    torques = body.torques(full_load(talos))
    assert body.status == DAMPED_POSTURE
    assert np.isfinite(torques).all()
    assert (np.abs(torques) <= talos.effort).all()
    broken.broken = False
    np.testing.assert_allclose(body.torques(full_load(talos)), good, atol=1e-6)
    assert body.status == SOLVED
    assert body.failures == STALE_TICKS + 1


def test_without_a_last_solution_the_posture_is_damped_at_once(talos: Robot) -> None:
    body = standing_controller(talos)
    body.backend = Broken(body.backend, "raises")
    torques = body.torques(full_load(talos))
    assert body.status == DAMPED_POSTURE
    assert np.abs(torques).max() > 10.0  # the legs carry the weight


def test_the_damped_posture_stands_on_its_own(talos: Robot) -> None:
    """Its wrenches and torques balance gravity with the joints at rest."""
    body = standing_controller(talos)
    body.backend = Broken(body.backend, "raises")
    body.torques(full_load(talos))
    assert body.solution is not None
    problem = body.problem(full_load(talos))
    forces = problem.forces(np.zeros(problem.nv), body.solution.wrench)
    np.testing.assert_allclose(forces[:6], 0.0, atol=1e-6)
    np.testing.assert_allclose(forces[6:], body.solution.torques, atol=1e-6)


def test_the_failure_carries_problem_and_result(talos: Robot) -> None:
    body = standing_controller(talos)
    body.backend = Broken(body.backend, "gives up")
    body.torques(full_load(talos))
    failure = body.failure
    assert isinstance(failure, QPFailure)
    assert str(failure) == "the QP of a tick was not solved: gave up."
    assert failure.solution is not None
    assert failure.solution.iterations == 7
    assert failure.cause is None
    assert qpsolvers.solve_problem(failure.problem, "daqp").found

    body.backend = Broken(body.backend, "raises")
    body.torques(full_load(talos))
    assert body.failure is not None
    assert str(body.failure) == "the QP of a tick was not solved: out of order."
    assert isinstance(body.failure.cause, RuntimeError)


@pytest.mark.parametrize("solver", ["osqp", "daqp"])
def test_nan_in_a_reference_falls_back(talos: Robot, solver: str) -> None:
    body = standing_controller(talos, solver)
    body.torques(full_load(talos))
    body.com.acceleration = np.array([np.nan, 0.0, 0.0])
    torques = body.torques(full_load(talos))
    assert body.status == LAST_SOLUTION
    assert np.isfinite(torques).all()


@pytest.mark.parametrize("end", [SystemExit(3), RecursionError(), MemoryError()])
def test_an_exit_inside_a_solver_is_a_failure_of_the_solver(
    talos: Robot, end: BaseException
) -> None:
    class Leaves:
        def solve(self, problem: TickProblem) -> Solution:
            raise end

    body = standing_controller(talos)
    body.backend = Leaves()
    torques = body.torques(full_load(talos))
    assert body.status == DAMPED_POSTURE
    assert np.isfinite(torques).all()
    assert body.failure is not None
    assert body.failure.cause is end


def test_ctrl_c_inside_a_solver_ends_the_run_with_its_record(talos: Robot) -> None:
    class Stopped:
        def __init__(self, backend: Backend) -> None:
            self.backend, self.ticks = backend, 0

        def solve(self, problem: TickProblem) -> Solution:
            self.ticks += 1
            if self.ticks == 6:
                raise KeyboardInterrupt
            return self.backend.solve(problem)

    walk = pw.Walk.standing(talos)
    walk.walker.body.backend = Stopped(walk.walker.body.backend)
    record = walk.run(until=1.0).record()
    assert record.run.interrupted
    assert not record.run.fell
    assert len(record) == 5
