"""OSQP in whole walks: who solved each tick, how exactly, and how often it was set up."""

from dataclasses import dataclass, field, replace

import numpy as np
import pytest
from tracking.states import busy_problem

from preview_walk import FootstepPlanner, Record, Walk
from preview_walk.robots.robot import Robot
from preview_walk.tracking.qp.condensed_backend import CondensedBackend
from preview_walk.tracking.qp.osqp_method import SLOTS, WarmOsqp
from preview_walk.tracking.qp.problem import TickProblem
from preview_walk.tracking.qp.solution import Solution
from preview_walk.tracking.qp.solvers import QpsolversBackend, make_backend
from preview_walk.types import Foot

EVERY = 10
"""So many ticks lie between two that are solved by other solvers too."""


@dataclass
class Witness:
    """A backend that compares another with an exact solver, and with daqp called directly.

    `errors`: largest differences of the torques (N·m).
    """

    mine: CondensedBackend
    exact: QpsolversBackend = field(default_factory=lambda: QpsolversBackend("daqp"))
    errors: dict[str, float] = field(default_factory=lambda: {"osqp": 0.0, "daqp": 0.0})
    contacts: set[tuple[Foot, ...]] = field(default_factory=set)
    solutions: list[Solution] = field(default_factory=list)

    def solve(self, problem: TickProblem) -> Solution:
        solution = self.mine.solve(problem)
        self.contacts.add(problem.contacts)
        self.solutions.append(solution)
        if len(self.solutions) % EVERY == 0:
            torques = self.exact.solve(problem).torques
            direct = make_backend("daqp").solve(problem).torques
            for name, found in (("osqp", solution.torques), ("daqp", direct)):
                error = float(np.abs(found - torques).max())
                self.errors[name] = max(self.errors[name], error)
        return solution


def witnessed(walk: Walk, until: float) -> tuple[Witness, Record]:
    """Return the witness of a walk, and its record."""
    witness = Witness(CondensedBackend(WarmOsqp()))
    walk.walker.body.backend = witness
    walk.run(until=until)
    assert not walk.fallen
    return witness, walk.record()


@pytest.fixture(scope="module")
def gentle(talos: Robot) -> tuple[Witness, Record]:
    plan = FootstepPlanner(0.25, talos.step_width, 0.9).generate_footsteps(3)
    return witnessed(Walk(talos, plan), 4.0)


@pytest.fixture(scope="module")
def fast(talos: Robot) -> tuple[Witness, Record]:
    walk = Walk.standing(talos)
    walk.command(1.0, 0.0, 0.0)
    return witnessed(walk, 6.0)


def test_osqp_itself_solves_every_tick_of_a_gentle_walk(gentle: tuple[Witness, Record]) -> None:
    witness, record = gentle
    assert all(solution.iterations >= 1 for solution in witness.solutions)
    assert record.summary().qp_own_share == pytest.approx(1.0, abs=1e-3)


def test_osqp_itself_solves_nearly_every_tick_of_a_fast_walk(fast: tuple[Witness, Record]) -> None:
    """At 1 m/s limits are reached in most ticks; measured 0.99 to 0.995."""
    witness, record = fast
    late = witness.solutions[2000:]
    assert np.mean([solution.finished for solution in late]) <= 0.02
    assert np.mean([solution.iterations > 1 for solution in late]) >= 0.1
    assert record.summary().qp_own_share == np.mean([not s.finished for s in witness.solutions])


@pytest.mark.parametrize("solver", ["osqp", "daqp"])
@pytest.mark.parametrize("walk", ["gentle", "fast"])
def test_torques_are_those_of_an_exact_solver(
    walk: str, solver: str, request: pytest.FixtureRequest
) -> None:
    witness, _ = request.getfixturevalue(walk)
    assert witness.errors[solver] <= 1e-3


def test_osqp_is_set_up_at_first_sets_of_contacts_only(fast: tuple[Witness, Record]) -> None:
    witness, _ = fast
    method = witness.mine.method
    assert isinstance(method, WarmOsqp)
    assert method.set_ups == len(SLOTS) * len(witness.contacts)
    assert len(witness.contacts) == 3


def test_a_solution_says_that_the_exact_method_finished_it(talos: Robot) -> None:
    p = busy_problem(talos, 1)
    p.contact_high[16] = 0.05 * 9.81 * talos.mass  # a foot that has just landed
    hasty = CondensedBackend(WarmOsqp(max_iterations=1)).solve(p)
    patient = CondensedBackend(WarmOsqp(max_iterations=600)).solve(p)
    assert hasty.solved
    assert hasty.finished
    assert patient.solved
    assert not patient.finished
    np.testing.assert_allclose(hasty.torques, patient.torques, atol=1e-3)


def test_a_record_says_which_ticks_were_finished(talos: Robot) -> None:
    class Alternating:
        """Says of every second tick that the exact method finished it."""

        def __init__(self) -> None:
            self.backend = make_backend("osqp")
            self.odd = True

        def solve(self, problem: TickProblem) -> Solution:
            self.odd = not self.odd
            return replace(self.backend.solve(problem), finished=self.odd)

    walk = Walk.standing(talos)
    walk.walker.body.backend = Alternating()
    walk.run(until=0.1)
    np.testing.assert_array_equal(walk.record().qp_solver, np.arange(50) % 2)
    assert walk.record().summary().qp_own_share == 0.5
