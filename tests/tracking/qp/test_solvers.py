import re
import sys

import numpy as np
import pytest
from tracking.states import busy_problem, full_load, standing_controller

from preview_walk.errors import InvalidInput
from preview_walk.robots.robot import Robot
from preview_walk.tracking.qp.condensed_backend import FORGET_TICKS, CondensedBackend
from preview_walk.tracking.qp.solvers import QpsolversBackend, make_backend
from preview_walk.types import Foot

BOTH: tuple[Foot, Foot] = ("left", "right")
OURS = ("osqp", "daqp")


def ours(name: str = "osqp") -> CondensedBackend:
    """Return a backend that solves the condensed QP."""
    backend = make_backend(name)
    assert isinstance(backend, CondensedBackend)
    return backend


@pytest.mark.parametrize("name", ["daqp", "proxqp"])
@pytest.mark.parametrize("feet", [BOTH, ("left",), ()])
def test_any_backend_of_qpsolvers_finds_the_same_torques(
    robot: Robot, feet: tuple[Foot, ...], name: str
) -> None:
    body = standing_controller(robot)
    limits = dict.fromkeys(feet, 20.0 * robot.mass)
    if not feet:
        body.com.acceleration = np.array([0.0, 0.0, -9.81])
    for foot, task in body.foot_tasks.items():
        terms = body.dynamics.soles[foot]
        task.pose = np.eye(4)
        task.pose[:3, :3], task.pose[:3, 3] = terms.rotation, terms.position
    p = body.problem(limits)
    mine = ours().solve(p)
    theirs = QpsolversBackend(name).solve(p)
    assert mine.solved
    assert theirs.solved
    np.testing.assert_allclose(mine.torques, theirs.torques, atol=0.05)


@pytest.mark.parametrize("name", OURS)
@pytest.mark.parametrize("seed", range(8))
def test_reached_limits_are_held_exactly(robot: Robot, seed: int, name: str) -> None:
    p = busy_problem(robot, seed)
    mine, exact = ours(name).solve(p), QpsolversBackend("daqp").solve(p)
    assert mine.solved
    np.testing.assert_allclose(mine.torques, exact.torques, atol=1e-3)
    assert (np.abs(mine.torques) <= robot.effort + 1e-3).all()


def test_busy_problems_do_reach_limits(talos: Robot) -> None:
    """Otherwise the test above shows nothing."""
    backend = ours()
    for seed in range(8):
        assert backend.solve(busy_problem(talos, seed)).solved
    assert len(backend._working_set) > 3


def test_limits_are_forgotten_when_they_are_no_longer_reached(talos: Robot) -> None:
    backend = ours()
    for seed in range(8):
        backend.solve(busy_problem(talos, seed))
    assert backend._working_set
    quiet = standing_controller(talos).problem(full_load(talos))
    for _ in range(FORGET_TICKS + 2):
        assert backend.solve(quiet).solved
    assert not backend._working_set


def test_the_answer_does_not_depend_on_what_was_solved_before(talos: Robot) -> None:
    p = busy_problem(talos, 1)
    fresh = ours().solve(p)
    used = ours()
    for feet in (("left",), ("right",), BOTH):
        used.solve(busy_problem(talos, 2, *feet))
    np.testing.assert_allclose(used.solve(p).torques, fresh.torques, atol=0.01)


def test_osqp_solves_a_standing_robot_in_one_iteration(robot: Robot) -> None:
    body = standing_controller(robot)
    body.torques(full_load(robot))
    assert body.solution is not None
    assert body.solution.solved
    assert not body.solution.finished
    assert body.solution.iterations == 1


def test_without_daqp_one_sentence_says_how_to_install_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "daqp", None)
    with pytest.raises(InvalidInput) as caught:
        make_backend("daqp")
    assert str(caught.value) == (
        "solver 'daqp' needs the package daqp, which is not installed; "
        "pip install 'preview-walk[daqp]' adds it."
    )
    assert caught.value.argument == "solver"


def test_an_unknown_solver() -> None:
    said = re.escape("solver must be one of those installed, osqp, ")
    with pytest.raises(InvalidInput, match=said + r".*, got 'simplex'\."):
        make_backend("simplex")


def test_a_foot_that_may_carry_nothing_carries_nothing(talos: Robot) -> None:
    body = standing_controller(talos)
    for limit in (0.0, -5.0):
        body.torques({"left": limit, "right": 2000.0})
        assert body.status == 0
        np.testing.assert_allclose(body.wrench("left"), 0.0, atol=1e-2)
