"""The check of answers: nonsense of every kind falls back, and what solvers return is taken."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from tracking.states import busy_problem, full_load, standing_controller

from preview_walk.robots.robot import Robot
from preview_walk.tracking.qp.answer import ROOM, flaw
from preview_walk.tracking.qp.problem import TickProblem
from preview_walk.tracking.qp.safety import DAMPED_POSTURE, LAST_SOLUTION, SOLVED
from preview_walk.tracking.qp.solution import Solution
from preview_walk.tracking.qp.solvers import QpsolversBackend, make_backend
from preview_walk.types import Foot

Spoil = Callable[[Solution], Any]
ARRAYS = ("acceleration", "wrench", "torques")
NONSENSE: dict[str, tuple[Spoil, str]] = {
    "None": (lambda s: None, "returned None"),
    "an int": (lambda s: 7, "returned 7"),
    "an array": (lambda s: s.torques, "returned an array of shape"),
    "zeros": (
        lambda s: replace(s, **{name: 0.0 * getattr(s, name) for name in ARRAYS}),
        "the equations of motion are missed by",
    ),
    "no text": (lambda s: replace(s, iterations="many"), "counted 'many' iterations"),
    "not quite solved": (lambda s: replace(s, solved="yes", status="perhaps"), "perhaps"),
    "another motion": (
        lambda s: replace(s, acceleration=s.acceleration + 0.1),
        "the equations of motion are missed by",
    ),
    "another load": (lambda s: replace(s, wrench=1.1 * s.wrench), "equations of motion"),
    "other torques": (lambda s: replace(s, torques=s.torques + 20.0), "equations of motion"),
    "pulling": (lambda s: replace(s, wrench=-s.wrench), "the contact cones are left by"),
}
for _name in ARRAYS:
    for _kind, _change, _said in (
        ("short", lambda x: x[:-1], "an array of shape"),
        ("long", lambda x: np.append(x, 0.0), "an array of shape"),
        ("flat", lambda x: x[None], "an array of shape"),
        ("complex", lambda x: x + 0j, "an array of shape"),
        ("text", lambda x: "text", "'text'"),
        ("missing", lambda x: None, "None"),
        ("a list", lambda x: x.tolist(), "["),
        ("nan", lambda x: x * np.nan, "missed by nan|left by nan"),
        ("huge", lambda x: x * 1e200, "missed by|left by"),
    ):
        NONSENSE[f"{_kind} {_name}"] = (
            lambda s, n=_name, c=_change: replace(s, **{n: c(getattr(s, n))}),  # type: ignore[misc]
            _said,
        )


class Spoiling:
    """A backend whose answers are spoilt."""

    def __init__(self, spoil: Spoil) -> None:
        self.backend, self.spoil = make_backend("osqp"), spoil

    def solve(self, problem: TickProblem) -> Any:
        return self.spoil(self.backend.solve(problem))


@pytest.mark.filterwarnings("ignore:overflow", "ignore:invalid value")
@pytest.mark.parametrize("kind", NONSENSE)
def test_nonsense_never_reaches_the_motors(talos: Robot, kind: str) -> None:
    spoil, said = NONSENSE[kind]
    body = standing_controller(talos)
    good = body.torques(full_load(talos))
    body.backend = Spoiling(spoil)
    np.testing.assert_allclose(body.torques(full_load(talos)), good, atol=1e-6)
    assert body.status == LAST_SOLUTION
    assert any(part in str(body.failure) for part in said.split("|")), body.failure
    body.backend = make_backend("osqp")
    body.torques(full_load(talos))
    assert body.status == SOLVED


def test_nonsense_from_the_first_tick_on_leaves_the_posture_damped(talos: Robot) -> None:
    body = standing_controller(talos)
    body.backend = Spoiling(lambda solution: 7)
    assert np.abs(body.torques(full_load(talos))).max() > 10.0
    assert body.status == DAMPED_POSTURE


@pytest.mark.parametrize("feet", [("left", "right"), ("left",), ()])
@pytest.mark.parametrize("seed", range(6))
def test_what_solvers_return_is_taken_with_room_to_spare(
    robot: Robot, seed: int, feet: tuple[Foot, ...], monkeypatch: pytest.MonkeyPatch
) -> None:
    problem = busy_problem(robot, seed, *feet)
    monkeypatch.setattr("preview_walk.tracking.qp.answer.ROOM", 0.1 * ROOM)
    for backend in (make_backend("osqp"), QpsolversBackend("daqp"), QpsolversBackend("proxqp")):
        answer = backend.solve(problem)
        assert answer.solved or isinstance(backend, QpsolversBackend)
        assert not answer.solved or flaw(problem, answer) is None
