"""Walks to a goal and over given footholds."""

import re

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from preview_walk.errors import InvalidInput
from preview_walk.footsteps.goals import from_list, to_pose
from preview_walk.footsteps.limits import GaitLimits
from preview_walk.footsteps.planner import FootstepPlanner
from preview_walk.geometry.poses import midfeet, pose_at, relative
from preview_walk.geometry.support import Sole
from preview_walk.pattern.check import check_plan

LIMITS = GaitLimits.for_leg(0.87, 0.17, Sole(0.1, 0.0675))
PLANNER = FootstepPlanner(0.25, 0.17, 0.7)


def raises(sentence):
    return pytest.raises(InvalidInput, match=f"^{re.escape(sentence)}$")


@settings(max_examples=60)
@given(st.tuples(st.floats(-4, 4), st.floats(-4, 4), st.floats(-3.1, 3.1)))
def test_every_goal_is_reached_exactly(goal):
    plan = to_pose(goal, PLANNER, (1.0, 2.0, -1.0), LIMITS)
    end = midfeet(plan.sole("left", plan.end), plan.sole("right", plan.end))
    assert relative(goal, end) == pytest.approx((0.0, 0.0, 0.0), abs=1e-8)
    assert check_plan(plan, LIMITS) == ()
    far = np.hypot(goal[0] - 1.0, goal[1] - 2.0)
    assert len(plan.steps) < 40 + 3 * far / PLANNER.step_length


def test_a_goal_straight_ahead_is_walked_to_straight():
    plan = to_pose((2.0, 0.0, 0.0), PLANNER, limits=LIMITS)
    assert all(abs(abs(s.pos[1]) - 0.085) < 1e-9 for s in plan.steps)
    assert len(plan.steps) == 9


def test_a_goal_just_behind_is_walked_to_backwards():
    plan = to_pose((-0.5, 0.0, 0.0), PLANNER, limits=LIMITS)
    assert all(s.yaw == pytest.approx(0.0) for s in plan.steps)


def test_being_there_takes_no_step():
    assert to_pose((1.0, 2.0, 0.5), PLANNER, (1.0, 2.0, 0.5)).steps == ()


def test_footholds_of_a_list():
    slope = pose_at(0.3, -0.085, 0.0, 0.05, 0.1)
    places = [("left", (0.2, 0.085)), ("right", slope), ("left", (0.3, 0.085, 0.1))]
    plan = from_list(places, PLANNER, limits=LIMITS, step_times=[0.7, 1.0, 0.7])
    assert np.array_equal(plan.steps[1].pose, slope)
    assert plan.steps[2].yaw == pytest.approx(0.1)
    assert plan.steps[1].land - plan.steps[1].lift == pytest.approx(0.8)
    more = from_list([("right", (0.3, -0.085))], PLANNER, plan, LIMITS)
    assert more.steps[:3] == plan.steps


def test_a_foothold_out_of_reach_is_refused_or_shortened():
    places = [("left", (0.2, 0.085)), ("right", (1.2, -0.085))]
    with raises("step 2 lands 1.000 m ahead of the left sole, at most 0.652 m is allowed."):
        from_list(places, PLANNER, limits=LIMITS)
    plan = from_list(places, PLANNER, limits=LIMITS, shorten=True)
    assert plan.steps[1].pos[0] == pytest.approx(0.2 + LIMITS.forward)


@pytest.mark.parametrize(
    ("make", "sentence"),
    [
        (
            lambda: to_pose((1.0,), PLANNER),
            "goal must be (x, y) or (x, y, yaw) in m and rad, got (1.0,).",
        ),
        (
            lambda: to_pose((1.0, 0.0), FootstepPlanner(step_length=0.0)),
            "step_length must not be 0 to walk to a goal, got 0.0.",
        ),
        (
            lambda: from_list([("both", (0, 0))], PLANNER),
            "the foot of step 1 must be 'left' or 'right', got 'both'.",
        ),
        (
            lambda: from_list([("left", (0.1, 0.085))], PLANNER, step_times=[]),
            "step_times must hold one time per foothold, 1, got [].",
        ),
        (
            lambda: from_list([("left", np.eye(3))], PLANNER),
            "the sole of step 1 must be a finite (4, 4) homogeneous pose with an orthonormal "
            "right-handed rotation, got an array of shape (3, 3).",
        ),
        (
            lambda: from_list([("left", "there")], PLANNER),
            "the sole of step 1 must be (x, y), (x, y, yaw) or a (4, 4) pose, got 'there'.",
        ),
    ],
)
def test_what_cannot_be_is_refused(make, sentence):
    with raises(sentence):
        make()
