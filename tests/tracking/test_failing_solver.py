"""Walks whose solver fails, now and then or for good: there are torques all the same."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from preview_walk import Walk
from preview_walk.tracking.qp.condensed_backend import CondensedBackend
from preview_walk.tracking.qp.osqp_method import WarmOsqp
from preview_walk.tracking.qp.problem import TickProblem
from preview_walk.tracking.qp.safety import DAMPED_POSTURE, LAST_SOLUTION, SOLVED
from preview_walk.tracking.qp.solution import Backend, Solution

MakeWalk = Callable[..., Walk]


class FailsNow:
    """One solve in a hundred, drawn by a seeded generator, is replaced by a failure."""

    def __init__(self, backend: Backend) -> None:
        self.backend = backend
        self.rng = np.random.default_rng(0)

    def solve(self, problem: TickProblem) -> Solution:
        solution = self.backend.solve(problem)
        if self.rng.random() < 0.01:
            return replace(solution, solved=False, status="injected")
        return solution


def test_a_walk_with_one_percent_of_failed_solves_does_not_fall(make_walk: MakeWalk) -> None:
    walk = make_walk(3)
    body = walk.walker.body
    body.backend = FailsNow(body.backend)
    record = walk.run().record()
    assert not walk.fallen
    assert body.failures >= 10
    assert np.count_nonzero(record.qp_status == LAST_SOLUTION) == body.failures
    assert np.abs(record.com - record.com_ref)[250:].max() <= 0.01


def test_standing_survives_a_solver_that_never_works_again(make_walk: MakeWalk) -> None:
    walk = make_walk(1)
    walk.run(until=0.3)
    body = walk.walker.body

    class Dead:
        def solve(self, problem: TickProblem) -> Solution:
            raise RuntimeError("dead")

    body.backend = Dead()
    walk.run(until=1.2)
    assert not walk.fallen
    assert body.status == DAMPED_POSTURE
    assert np.abs(walk.plant.v[6:]).max() < 0.5


def test_a_walk_with_nan_in_one_measured_velocity_stops_and_says_so(make_walk: MakeWalk) -> None:
    walk = make_walk(1)
    walk.run(until=0.5)
    sense = walk.plant.sense

    def broken() -> None:
        sense()
        walk.plant.v[6 + walk.robot.joint_names.index("arm_left_3_joint")] = np.nan

    walk.plant.sense = broken  # type: ignore[method-assign]
    walk.run()
    assert walk.fallen
    assert walk.record().run.fall_reason == (
        "the measured state must be finite, got nan for the velocity of joint 'arm_left_3_joint'."
    )


def test_a_walk_with_five_iterations_at_most_still_walks(make_walk: MakeWalk) -> None:
    """What OSQP does not finish, the active-set method does."""
    walk = make_walk(2)
    walk.walker.body.backend = CondensedBackend(WarmOsqp(max_iterations=5))
    record = walk.run().record()
    assert not walk.fallen
    assert (record.qp_status == SOLVED).all()
