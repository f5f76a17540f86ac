"""The feet follow the plan, but the ground decides when a landing is one."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import pytest

import preview_walk as pw
from preview_walk.controller.feet import (
    GRACE,
    HANG,
    RAMP_TIME,
    SEARCH,
    SINK_SPEED,
    Feet,
)
from preview_walk.footsteps.plan import FootstepPlan
from preview_walk.geometry.poses import pose_at
from preview_walk.types import Array, Foot

WEIGHT = 900.0
BOTH: dict[Foot, float] = {"left": 450.0, "right": 450.0}
RIGHT_ONLY: dict[Foot, float] = {"left": 0.0, "right": WEIGHT}


@pytest.fixture
def plan() -> FootstepPlan:
    robot = pw.load_robot("talos")
    return pw.FootstepPlanner(0.2, robot.step_width, 0.9).generate_footsteps(4)


@pytest.fixture
def feet(plan: FootstepPlan) -> Feet:
    return Feet(plan, WEIGHT, 0.05)


def follow(feet: Feet, t: float, plan: FootstepPlan, load: Mapping[Foot, float]) -> Foot | None:
    """Let the feet follow the plan with the soles measured where the plan has them."""
    soles: dict[Foot, Array] = {"left": plan.sole("left", t), "right": plan.sole("right", t)}
    return feet.follow(t, plan, soles, load)


def lift(feet: Feet, plan: FootstepPlan) -> None:
    """Take the first step, of the left foot, to the end of its swing."""
    step = plan.steps[0]
    assert step.foot == "left"
    for t in np.linspace(step.lift, step.land - 0.005, 60):
        assert follow(feet, float(t), plan, RIGHT_ONLY) is None
    assert not feet.states["left"].contact
    assert feet.states["right"].contact


def test_a_foot_that_feels_the_ground_in_its_descent_has_landed(
    feet: Feet, plan: FootstepPlan
) -> None:
    lift(feet, plan)
    t = plan.steps[0].land - 0.04
    assert follow(feet, t, plan, BOTH) == "left"
    assert feet.states["left"].contact
    assert set(feet.normal_limits(t, plan)) == {"left", "right"}


def test_a_foot_that_hits_something_while_rising_swings_on(feet: Feet, plan: FootstepPlan) -> None:
    step = plan.steps[0]
    follow(feet, step.lift, plan, RIGHT_ONLY)
    assert follow(feet, step.lift + 0.2 * (step.land - step.lift), plan, BOTH) is None
    assert not feet.states["left"].contact


def test_a_foot_that_misses_the_ground_goes_on_down_until_it_is_there(
    feet: Feet, plan: FootstepPlan
) -> None:
    lift(feet, plan)
    land = plan.steps[0].land
    follow(feet, land, plan, RIGHT_ONLY)
    assert feet.states["left"].contact, "due: it stands until the ground is missed"
    late = GRACE + 0.03
    follow(feet, land + late, plan, RIGHT_ONLY)
    assert not feet.states["left"].contact
    target = feet.targets["left"]
    assert target.pose[2, 3] == pytest.approx(plan.steps[0].pose[2, 3] - SEARCH.speed * late)
    assert target.velocity[2] == -SEARCH.speed
    follow(feet, land + late + 0.01, plan, BOTH)
    assert feet.states["left"].contact
    # Felt once, a light sole stays a contact.
    follow(feet, land + late + 0.02, plan, RIGHT_ONLY)
    assert feet.states["left"].contact


def test_a_ground_never_felt_is_believed_in_the_end(feet: Feet, plan: FootstepPlan) -> None:
    lift(feet, plan)
    follow(feet, plan.steps[0].land + SEARCH.time + 1e-3, plan, RIGHT_ONLY)
    assert feet.states["left"].contact


def test_a_foot_that_should_stand_and_carries_nothing_sinks_unless_it_is_to_lift(
    feet: Feet, plan: FootstepPlan
) -> None:
    lift = plan.steps[0].lift

    def sinking() -> dict[Foot, float]:
        return {foot: target.sink for foot, target in feet.targets.items()}

    follow(feet, lift - 2.0 * HANG, plan, BOTH)
    assert sinking() == {"left": 0.0, "right": 0.0}
    follow(feet, lift - 1.1 * HANG, plan, RIGHT_ONLY)
    assert sinking() == {"left": SINK_SPEED, "right": 0.0}
    follow(feet, lift - 0.9 * HANG, plan, RIGHT_ONLY)
    assert sinking() == {"left": 0.0, "right": 0.0}


def test_a_lifting_foot_is_unloaded_before_it_lifts(feet: Feet, plan: FootstepPlan) -> None:
    """Its load ramps down over `RAMP_TIME`; the other foot may carry all."""
    lift = plan.steps[0].lift
    for early, share in ((2.0 * RAMP_TIME, 1.0), (0.5 * RAMP_TIME, 0.51), (0.0, 0.01)):
        t = lift - early - 1e-9
        follow(feet, t, plan, BOTH)
        limits = feet.normal_limits(t, plan)
        assert limits["left"] == pytest.approx(2.0 * WEIGHT * share, rel=1e-5)
        assert limits["right"] == pytest.approx(2.0 * WEIGHT)


def test_a_swing_starts_where_the_sole_is_measured(feet: Feet, plan: FootstepPlan) -> None:
    """So that no error of a stance goes into the next."""
    step = plan.steps[0]
    off = np.array(step.pose)
    off[:3, 3] = plan.sole("left", step.lift)[:3, 3] + (0.003, -0.002, 0.001)
    soles: dict[Foot, Array] = {"left": off, "right": plan.sole("right", step.lift)}
    feet.follow(step.lift, plan, soles, RIGHT_ONLY)
    assert feet.targets["left"].pose[:3, 3] == pytest.approx(off[:3, 3], abs=1e-12)


def test_a_swing_under_way_turns_to_a_moved_foothold(feet: Feet, plan: FootstepPlan) -> None:
    """Position and velocity do not jump, and the foot ends at the new place."""
    step = plan.steps[0]
    t = step.lift + 0.4 * (step.land - step.lift)
    for time in np.linspace(step.lift, t, 20):
        follow(feet, float(time), plan, RIGHT_ONLY)
    before = feet.targets["left"]
    moved = plan.retarget(t, pose_at(step.pos[0] + 0.05, step.pos[1], 0.0))
    follow(feet, t, moved, RIGHT_ONLY)
    after = feet.targets["left"]
    assert after.pose == pytest.approx(before.pose, abs=1e-12)
    assert after.velocity == pytest.approx(before.velocity, abs=1e-9)
    follow(feet, step.land - 1e-6, moved, RIGHT_ONLY)
    assert feet.targets["left"].pose[0, 3] == pytest.approx(step.pos[0] + 0.05, abs=1e-6)


def test_what_does_not_feel_the_ground_cannot_be_leant_on(feet: Feet, plan: FootstepPlan) -> None:
    """Its load ramps up from when it feels the ground; in the air or at the start all can be."""
    nothing: dict[Foot, float] = {"left": 0.0, "right": 0.0}
    follow(feet, 0.1, plan, nothing)
    assert feet.normal_limits(0.1, plan)["left"] == pytest.approx(2.0 * WEIGHT)
    follow(feet, 0.2, plan, RIGHT_ONLY)
    limits = feet.normal_limits(0.2, plan)
    assert limits["left"] < 0.05 * WEIGHT
    assert limits["right"] == pytest.approx(2.0 * WEIGHT)
    for t in (0.2 + 0.5 * RAMP_TIME, 0.2 + 1.1 * RAMP_TIME):
        follow(feet, t, plan, BOTH)
    assert feet.normal_limits(0.2 + 0.5 * RAMP_TIME, plan)["left"] == pytest.approx(
        2.0 * WEIGHT * 0.52
    )
    assert feet.normal_limits(0.2 + 1.1 * RAMP_TIME, plan)["left"] == pytest.approx(2.0 * WEIGHT)
