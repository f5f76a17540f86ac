"""Plans and commands given while a walk runs: checked, and from any thread."""

from __future__ import annotations

import threading
import warnings

import numpy as np
import pytest

import preview_walk as pw
from preview_walk.errors import InvalidInput
from preview_walk.geometry.poses import pose_at
from preview_walk.robots.robot import Robot
from preview_walk.simulation.requests import Requests

PATIENCE = 30.0
"""Time (s) in which a thread that asks must have asked: far more than it needs."""


@pytest.fixture
def walk(talos: Robot) -> pw.Walk:
    planner = pw.FootstepPlanner(0.2, talos.step_width, 0.8)
    return pw.Walk(talos, planner.generate_footsteps(2)).run(until=0.5)


def plan_of(walk: pw.Walk, steps: int = 2, start: tuple[float, ...] = (0.0, 0.0)) -> object:
    planner = pw.FootstepPlanner(0.2, walk.robot.step_width, 0.8)
    return planner.generate_footsteps(steps, start)


def test_a_plan_that_does_not_fit_is_refused_and_the_old_one_goes_on(walk: pw.Walk) -> None:
    far = pw.FootstepPlanner(0.9, walk.robot.step_width, 0.8).generate_footsteps(4)
    for plan, words in (
        (plan_of(walk, start=(0.6, 0.0)), "0.600 m from where it stands"),
        (plan_of(walk, start=(0.0, 0.0, np.pi / 2)), "turned by 1.57"),
        (far, "0.900 m ahead"),
        (None, "plan must be a FootstepPlan"),
        ([{"foot": "left"}], "must have the key"),
    ):
        before = walk.plan
        with pytest.raises(InvalidInput, match=words) as told:
            walk.plan = plan  # type: ignore[assignment]
        assert told.value.argument is not None
        assert walk.plan is before
    walk.run(until=1.0)
    assert not walk.fallen


def test_a_plan_of_the_past_is_refused_elsewhere_and_stood_on_here(walk: pw.Walk) -> None:
    walk.run()
    with pytest.raises(InvalidInput, match="which was over at"):
        walk.plan = plan_of(walk, 0)  # type: ignore[assignment]
    last = [walk.plan.sole(foot, walk.time) for foot in ("left", "right")]
    walk.plan = pw.FootstepPlan.standing(*last)
    walk.run(until=walk.time + 0.2)
    assert not walk.fallen


def test_other_forms_of_a_plan_are_walked(talos: Robot) -> None:
    """The lab's dictionaries, and a plan of a record, lead to the same feet."""
    plan = pw.FootstepPlanner(0.2, talos.step_width, 0.8).generate_footsteps(1)
    record = pw.Walk(talos, plan).run().record()
    again = pw.Walk(talos, record.plans[-1]).run().record()
    assert again.differences(record) == ()
    keys = ("foot", "pos", "time", "type")
    walk = pw.Walk(talos, [{key: step[key] for key in keys} for step in plan])
    assert [step.land for step in walk.plan] == pytest.approx([step.land for step in plan])


def test_an_attribute_that_a_walk_lacks_cannot_be_set(walk: pw.Walk) -> None:
    with pytest.raises(AttributeError):
        walk.friction = 0.5  # type: ignore[attr-defined]


def test_after_a_fall_nothing_is_taken(walk: pw.Walk) -> None:
    walk.plant.q[2] = 0.1
    walk._fall = (0.5, "the CoM sank")
    with pytest.raises(InvalidInput, match=r"the robot fell at 0\.50 s: the CoM sank; make"):
        walk.command(0.2, 0.0, 0.0)


def test_commands_and_plans_from_another_thread_are_taken_at_a_tick(talos: Robot) -> None:
    walk = pw.Walk.standing(talos)
    stop = threading.Event()
    sent: list[float] = []

    def steer() -> None:
        while not stop.wait(0.02):
            sent.append(0.1 + 0.2 * (len(sent) % 2))
            walk.command(sent[-1], 0.0, 0.0)

    thread = threading.Thread(target=steer)
    thread.start()
    try:
        walk.run(until=1.0)
    finally:
        stop.set()
        thread.join()
    assert not walk.fallen
    assert len(sent) > 10
    record = walk.record()
    assert len(record.plans) > 5
    # A plan comes into force with a tick, never within one.
    assert set(np.round(record.plans.plan_time, 9)) <= set(np.round(record.time, 9))


def test_a_request_waits_for_the_tick_under_way_elsewhere() -> None:
    requests, done = Requests(), []
    asked = threading.Thread(target=lambda: requests.do(lambda: done.append("asked")))
    with requests:
        requests.do(lambda: done.append("own"))  # the same thread, as in a callback, need not wait
        asked.start()
        asked.join(PATIENCE)
        assert not asked.is_alive()  # who asks is not held up by the tick
        assert done == ["own"]
    with requests:
        assert done == ["own", "asked"]


def test_a_request_that_cannot_be_done_any_more_is_warned_of() -> None:
    requests = Requests()

    def refuse() -> None:
        raise InvalidInput("the plan is over.")

    asked = threading.Thread(target=lambda: requests.do(refuse))
    with requests:
        asked.start()
        asked.join(PATIENCE)
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        with requests:
            pass
    assert [str(w.message) for w in told] == [
        "what another thread asked for is refused: the plan is over."
    ]


def test_a_step_that_was_moved_under_way_lands_where_it_was_moved_to(walk: pw.Walk) -> None:
    step = walk.plan.steps[0]
    walk.run(until=step.lift + 0.1)
    walk.plan = walk.plan.retarget(walk.time, pose_at(step.pos[0] + 0.03, step.pos[1], 0.0))
    record = walk.run().record()
    assert not walk.fallen
    landed = record.left_foot[np.searchsorted(record.time, step.land + 0.1), :2, 3]
    assert landed == pytest.approx((step.pos[0] + 0.03, step.pos[1]), abs=2e-3)
