"""The feet follow the plan, but the ground decides when a landing is one."""

from __future__ import annotations

import numpy as np
import pytest

import preview_walk as pw
from preview_walk.controller.feet import (
    GRACE,
    HANG,
    PROBE_SPEED,
    PROBE_TIME,
    RAMP_TIME,
    SINK_SPEED,
    Feet,
)
from preview_walk.footsteps.plan import FootstepPlan
from preview_walk.tracking.gains import TrackingGains
from preview_walk.tracking.whole_body import WholeBodyController
from preview_walk.types import Foot

WEIGHT = 900.0
BOTH: dict[Foot, float] = {"left": 450.0, "right": 450.0}
RIGHT_ONLY: dict[Foot, float] = {"left": 0.0, "right": WEIGHT}


@pytest.fixture
def plan() -> FootstepPlan:
    robot = pw.load_robot("talos")
    return pw.FootstepPlanner(0.2, robot.step_width, 0.9).generate_footsteps(4)


@pytest.fixture
def feet(plan: FootstepPlan) -> Feet:
    robot = pw.load_robot("talos")
    body = WholeBodyController(robot, TrackingGains(), 0.8)
    body.update(robot.posture, np.zeros(robot.pin.nv))
    return Feet(body, plan, WEIGHT, 0.05)


def lift(feet: Feet, plan: FootstepPlan) -> None:
    """Take the first step, of the left foot, to the end of its swing."""
    step = plan.steps[0]
    assert step.foot == "left"
    for t in np.linspace(step.lift, step.land - 0.005, 60):
        assert feet.follow(float(t), plan, RIGHT_ONLY) is None
    assert not feet["left"].contact
    assert feet["right"].contact


def test_a_foot_that_feels_the_ground_in_its_descent_has_landed(
    feet: Feet, plan: FootstepPlan
) -> None:
    lift(feet, plan)
    t = plan.steps[0].land - 0.04
    assert feet.follow(t, plan, BOTH) == "left"
    assert feet["left"].contact
    assert set(feet.normal_limits(t, plan)) == {"left", "right"}


def test_a_foot_that_hits_something_while_rising_swings_on(feet: Feet, plan: FootstepPlan) -> None:
    step = plan.steps[0]
    feet.follow(step.lift, plan, RIGHT_ONLY)
    assert feet.follow(step.lift + 0.2 * (step.land - step.lift), plan, BOTH) is None
    assert not feet["left"].contact


def test_a_foot_that_misses_the_ground_goes_on_down_until_it_is_there(
    feet: Feet, plan: FootstepPlan
) -> None:
    lift(feet, plan)
    land = plan.steps[0].land
    task = feet._body.foot_tasks["left"]
    feet.follow(land, plan, RIGHT_ONLY)
    assert feet["left"].contact, "due: it stands until the ground is missed"
    late = GRACE + 0.03
    feet.follow(land + late, plan, RIGHT_ONLY)
    assert not feet["left"].contact
    assert task.pose[2, 3] == pytest.approx(plan.steps[0].pose[2, 3] - PROBE_SPEED * late)
    assert task.velocity[2] == -PROBE_SPEED
    feet.follow(land + late + 0.01, plan, BOTH)
    assert feet["left"].contact
    # Felt once, a light sole stays a contact.
    feet.follow(land + late + 0.02, plan, RIGHT_ONLY)
    assert feet["left"].contact


def test_a_ground_never_felt_is_believed_in_the_end(feet: Feet, plan: FootstepPlan) -> None:
    lift(feet, plan)
    feet.follow(plan.steps[0].land + PROBE_TIME + 1e-3, plan, RIGHT_ONLY)
    assert feet["left"].contact


def test_a_foot_that_should_stand_and_carries_nothing_sinks_unless_it_is_to_lift(
    feet: Feet, plan: FootstepPlan
) -> None:
    sink, lift = feet._body.sink, plan.steps[0].lift
    feet.follow(lift - 2.0 * HANG, plan, BOTH)
    assert sink == {}
    feet.follow(lift - 1.1 * HANG, plan, RIGHT_ONLY)
    assert sink == {"left": SINK_SPEED}
    feet.follow(lift - 0.9 * HANG, plan, RIGHT_ONLY)
    assert sink == {}


def test_what_does_not_feel_the_ground_cannot_be_leant_on(feet: Feet, plan: FootstepPlan) -> None:
    """Its load ramps up from when it feels the ground; in the air or at the start all can be."""
    nothing: dict[Foot, float] = {"left": 0.0, "right": 0.0}
    feet.follow(0.1, plan, nothing)
    assert feet.normal_limits(0.1, plan)["left"] == pytest.approx(2.0 * WEIGHT)
    feet.follow(0.2, plan, RIGHT_ONLY)
    limits = feet.normal_limits(0.2, plan)
    assert limits["left"] < 0.05 * WEIGHT
    assert limits["right"] == pytest.approx(2.0 * WEIGHT)
    for t in (0.2 + 0.5 * RAMP_TIME, 0.2 + 1.1 * RAMP_TIME):
        feet.follow(t, plan, BOTH)
    assert feet.normal_limits(0.2 + 0.5 * RAMP_TIME, plan)["left"] == pytest.approx(
        2.0 * WEIGHT * 0.52
    )
    assert feet.normal_limits(0.2 + 1.1 * RAMP_TIME, plan)["left"] == pytest.approx(2.0 * WEIGHT)
