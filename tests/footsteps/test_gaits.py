"""Whole walks end where they were asked to, within the limits."""

import re
from itertools import pairwise
from math import pi

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from preview_walk.errors import InvalidInput
from preview_walk.footsteps import gaits
from preview_walk.footsteps.limits import GaitLimits
from preview_walk.footsteps.planner import FootstepPlanner
from preview_walk.geometry.poses import compose, midfeet, pose_at, relative
from preview_walk.geometry.support import Sole
from preview_walk.pattern.check import check_plan

LIMITS = GaitLimits.for_leg(0.87, 0.17, Sole(0.1, 0.0675))
PLANNER = FootstepPlanner(0.25, 0.17, 0.7)
START = (100.0, -50.0, 2.4)


def raises(sentence):
    return pytest.raises(InvalidInput, match=f"^{re.escape(sentence)}$")


def gone(plan, start=START):
    """How far the midfeet point went, in the frame of the start."""
    return relative(start, midfeet(plan.sole("left", plan.end), plan.sole("right", plan.end)))


def assert_ends_at(plan, where):
    assert gone(plan) == pytest.approx(where, abs=1e-9)
    end = relative(START, compose(START, *where))
    assert gone(plan)[2] == pytest.approx(end[2], abs=1e-9)
    left, right = plan.sole("left", plan.end), plan.sole("right", plan.end)
    assert (np.linalg.inv(right) @ left)[:3, 3] == pytest.approx([0.0, 0.17, 0.0], abs=1e-9)
    assert check_plan(plan, LIMITS) == ()


@settings(max_examples=40)
@given(st.floats(-3.0, 3.0), st.integers(0, 4))
def test_straight(distance, ramp):
    plan = gaits.straight(distance, PLANNER, START, limits=LIMITS, ramp=ramp)
    assert_ends_at(plan, (distance, 0.0, 0.0))
    x = [relative(START, (*s.pos[:2], 0.0))[0] for s in plan.steps]
    assert np.abs(np.diff([0.0, 0.0, *x])).max() <= 0.25 + 1e-9


@settings(max_examples=40)
@given(st.floats(-1.5, 1.5))
def test_sideways(distance):
    plan = gaits.sideways(distance, PLANNER, START, LIMITS)
    assert_ends_at(plan, (0.0, distance, 0.0))
    assert plan.steps == () or plan.steps[0].foot == ("left" if distance > 0 else "right")


@pytest.mark.parametrize("angle", [0.3, -1.0, pi, -2 * pi, 0.0, 7.0])
def test_turn_in_place(angle):
    plan = gaits.turn_in_place(angle, PLANNER, START, LIMITS)
    turn = relative((0.0, 0.0, 0.0), (0.0, 0.0, angle))[2]
    assert gone(plan)[:2] == pytest.approx((0.0, 0.0), abs=1e-9)
    assert np.cos(gone(plan)[2] - turn) == pytest.approx(1.0)
    assert check_plan(plan, LIMITS) == ()


def test_turning_with_narrow_feet_takes_a_wider_stance():
    plan = gaits.turn_in_place(1.0, FootstepPlanner())
    assert gone(plan, (0.0, 0.0, 0.0)) == pytest.approx((0.0, 0.0, 1.0), abs=1e-9)
    widths = [np.linalg.norm(a.pos - b.pos) for a, b in pairwise(plan[1:])]
    assert max(widths) > 0.11
    assert np.linalg.norm(plan[-1].pos - plan[-2].pos) == pytest.approx(0.1)


@settings(max_examples=30)
@given(st.floats(0.4, 5.0), st.floats(-4.0, 4.0), st.integers(0, 3))
def test_arc(radius, angle, ramp):
    plan = gaits.arc(radius, angle, PLANNER, START, limits=LIMITS, ramp=ramp)
    side = 1.0 if angle > 0 else -1.0
    end = (radius * np.sin(abs(angle)), side * radius * (1 - np.cos(angle)))
    assert gone(plan)[:2] == pytest.approx(end, abs=1e-9)
    assert np.cos(gone(plan)[2] - angle) == pytest.approx(1.0)
    assert check_plan(plan, LIMITS) == ()
    centre = compose(START, 0.0, side * radius)
    for s in plan.steps:
        inner = (s.foot == "left") == (angle > 0)
        distance = np.hypot(s.pos[0] - centre[0], s.pos[1] - centre[1])
        assert distance == pytest.approx(abs(radius - (0.085 if inner else -0.085)), abs=1e-9)


def test_a_full_circle_comes_home():
    plan = gaits.arc(1.0, 2 * pi, PLANNER, START, limits=LIMITS)
    assert gone(plan) == pytest.approx((0.0, 0.0, 0.0), abs=1e-9)


def test_on_the_spot():
    plan = gaits.on_the_spot(6, PLANNER, START)
    for s in plan.steps:
        assert np.allclose(s.pose, plan.start_pose(s))


def test_walks_follow_each_other():
    plan = gaits.straight(0.5, PLANNER, START)
    plan = gaits.turn_in_place(pi / 2, PLANNER, plan)
    plan = gaits.sideways(-0.5, PLANNER, plan)
    plan = gaits.straight(-0.5, PLANNER, plan)
    assert gone(plan) == pytest.approx((1.0, -0.5, pi / 2), abs=1e-9)
    assert check_plan(plan, gaits.limits_for(PLANNER, None)) == ()


def test_walks_do_not_care_where_the_world_begins():
    here = gaits.arc(0.7, 2.0, PLANNER).transformed(pose_at(*START))
    there = gaits.arc(0.7, 2.0, PLANNER, START)
    for a, b in zip(here, there, strict=True):
        assert np.allclose(a.pose, b.pose, atol=1e-9)


@pytest.mark.parametrize(
    ("make", "sentence"),
    [
        (lambda: gaits.straight(np.nan, PLANNER), "distance must be finite (m), got nan."),
        (lambda: gaits.turn_in_place(np.inf, PLANNER), "angle must be finite (rad), got inf."),
        (lambda: gaits.arc(0.0, 1.0, PLANNER), "radius must be > 0 m, got 0.0."),
        (lambda: gaits.on_the_spot(-1, PLANNER), "n_steps must be an integer >= 0, got -1."),
        (
            lambda: gaits.straight(1.0, FootstepPlanner(step_length=0.0)),
            "step_length must not be 0 to cover a distance, got 0.0.",
        ),
        (
            lambda: gaits.straight(1.0, FootstepPlanner(0.2, 0.05)),
            "a step_width of 0.05 m is too narrow for soles 0.09 m wide with 0.01 m between them.",
        ),
        (
            lambda: gaits.straight(1.0, FootstepPlanner(0.2, 0.5), limits=LIMITS),
            "step 1 lands 0.500 m beside the right sole, at most 0.388 m is allowed.",
        ),
    ],
)
def test_walks_that_cannot_be_are_refused(make, sentence):
    with raises(sentence):
        make()
