"""Walks of one step size and of strides given one by one."""

import re

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from preview_walk.errors import InvalidInput
from preview_walk.footsteps.layout import STAND_TIME
from preview_walk.footsteps.limits import GaitLimits
from preview_walk.footsteps.plan import FootstepPlan
from preview_walk.footsteps.planner import FootstepPlanner
from preview_walk.footsteps.stride import Stride
from preview_walk.geometry.poses import midfeet, pose_at
from preview_walk.geometry.support import Sole
from preview_walk.types import FEET, other

LIMITS = GaitLimits.for_leg(0.85, 0.17, Sole(0.1, 0.0675))


def raises(sentence):
    return pytest.raises(InvalidInput, match=f"^{re.escape(sentence)}$")


planners = st.builds(
    FootstepPlanner,
    step_length=st.floats(-0.4, 0.5),
    step_width=st.floats(0.1, 0.3),
    step_time=st.floats(0.3, 1.5),
    double_support_ratio=st.floats(0.05, 0.5),
)
starts = st.tuples(st.floats(-100, 100), st.floats(-100, 100), st.floats(-3.1, 3.1))


@given(planners, st.integers(1, 30), starts, st.sampled_from(FEET), st.integers(0, 6))
def test_a_straight_walk_is_what_was_asked(planner, n, start, foot, ramp):
    plan = planner.generate_footsteps(n, start, foot, ramp=ramp)
    assert len(plan.steps) == n
    assert plan.steps[0].foot == foot
    assert all(a.foot == other(b.foot) for a, b in zip(plan.steps, plan.steps[1:], strict=False))
    # It starts and ends with the feet side by side.
    begin = midfeet(plan[0].pose, plan[1].pose)
    end = midfeet(plan.sole("left", plan.end), plan.sole("right", plan.end))
    assert begin == pytest.approx(start, abs=1e-9)
    assert end[2] == pytest.approx(start[2], abs=1e-9)
    last = plan.sole("left", plan.end)[:3, 3] - plan.sole("right", plan.end)[:3, 3]
    assert np.linalg.norm(last) == pytest.approx(planner.step_width)
    forward = np.array([np.cos(start[2]), np.sin(start[2])])
    walked = (np.array(end[:2]) - start[:2]) @ forward
    if ramp == 0:
        assert walked == pytest.approx((n - 1) * planner.step_length, abs=1e-9)
    # The swing lasts exactly the single support, double support and swing make one step time.
    assert plan.steps[0].lift == plan.start + STAND_TIME
    for a, b in zip(plan.steps, plan.steps[1:], strict=False):
        assert b.land - a.land == pytest.approx(planner.step_time)
        assert b.lift - a.land == pytest.approx(planner.double_support_time)
        assert b.land - b.lift == pytest.approx(planner.single_support_time)


def test_first_and_last_step_are_half_steps():
    plan = FootstepPlanner(0.2, 0.2, 0.7).generate_footsteps(6)
    travel = [s.pos[0] - plan.start_pose(s)[0, 3] for s in plan.steps]
    assert travel == pytest.approx([0.2, 0.4, 0.4, 0.4, 0.4, 0.2])


def test_a_ramp_grows_and_shrinks_the_steps():
    plan = FootstepPlanner(0.4, 0.2, 0.7).generate_footsteps(9, ramp=3)
    x = [s.pos[0] for s in plan.steps]
    assert np.diff([0.0, *x]) == pytest.approx([0.1, 0.2, 0.3, 0.4, 0.4, 0.3, 0.2, 0.1, 0.0])


@given(planners, st.floats(-0.2, 0.2), starts)
def test_a_turning_walk_does_not_care_where_the_world_begins(planner, turn, start):
    here = planner.generate_footsteps(8, turn=turn)
    there = planner.generate_footsteps(8, start, turn=turn)
    moved = here.transformed(pose_at(*start))
    for a, b in zip(moved, there, strict=True):
        assert np.allclose(a.pose, b.pose, atol=1e-9)
        assert (a.lift, a.land) == (b.lift, b.land)


def test_a_turning_walk_stays_on_its_circle():
    turn, length = 0.2, 0.25
    radius = 0.5 * length / np.sin(0.5 * turn)
    plan = FootstepPlanner(length, 0.2, 0.7).generate_footsteps(20, turn=turn)
    for s in plan.steps:
        side = -1.0 if s.foot == "left" else 1.0
        assert np.hypot(s.pos[0], s.pos[1] - radius) == pytest.approx(radius + side * 0.1)


def test_no_steps_is_standing():
    plan = FootstepPlanner().generate_footsteps(0)
    assert plan.steps == ()
    assert FootstepPlanner().get_support_phase(3.0, plan) == ("double", 1.0)


def test_width_and_time_may_differ_step_by_step():
    planner = FootstepPlanner(0.2, 0.2, 0.7, 0.2)
    strides = [Stride(0.1, width=0.3, time=1.0, double_support_ratio=0.5), Stride(0.2), Stride()]
    plan = planner.walk(strides)
    assert plan.steps[0].pos[1] == pytest.approx(0.15)
    assert plan.steps[0].land - plan.steps[0].lift == pytest.approx(0.5)
    assert plan.steps[1].lift - plan.steps[0].land == pytest.approx(0.5)
    assert plan.steps[1].land - plan.steps[1].lift == pytest.approx(0.56)


def test_a_walk_goes_on_from_another():
    planner = FootstepPlanner(0.2, 0.2, 0.7)
    first = planner.generate_footsteps(4, (1.0, 2.0, 0.5))
    both = planner.walk([Stride(0.2), Stride()], first, "right")
    assert both.steps[:4] == first.steps
    assert both.steps[4].lift == pytest.approx(first[-1].land + STAND_TIME)
    gone = np.array(midfeet(both[-1].pose, both[-2].pose)) - midfeet(first[-1].pose, first[-2].pose)
    assert gone == pytest.approx([0.2 * np.cos(0.5), 0.2 * np.sin(0.5), 0.0])


def test_a_step_out_of_reach_is_refused_or_shortened():
    planner = FootstepPlanner(0.2, 0.17, 0.7)
    strides = [Stride(0.2), Stride(0.9), Stride()]
    with raises("step 2 lands 0.900 m ahead of the left sole, at most 0.637 m is allowed."):
        planner.walk(strides, limits=LIMITS)
    plan = planner.walk(strides, limits=LIMITS, shorten=True)
    assert plan.steps[1].pos[0] == pytest.approx(0.2 + LIMITS.forward)
    assert plan.steps[2].pos[0] == pytest.approx(0.2 + LIMITS.forward)
    assert planner.walk(strides).steps[1].pos[0] == pytest.approx(1.1)


@pytest.mark.parametrize(
    ("make", "sentence"),
    [
        (lambda: FootstepPlanner(np.nan), "step_length must be finite (m), got nan."),
        (lambda: FootstepPlanner(0.1, 0.0), "step_width must be > 0 m, got 0.0."),
        (lambda: FootstepPlanner(0.1, 0.1, -1.0), "step_time must be > 0 s, got -1.0."),
        (
            lambda: FootstepPlanner(0.1, 0.1, 0.5, 1.0),
            "double_support_ratio must be in (0, 1), the share of the step time, got 1.0.",
        ),
        (
            lambda: FootstepPlanner().generate_footsteps(2.5),
            "n_steps must be an integer >= 0, got 2.5.",
        ),
        (
            lambda: FootstepPlanner().generate_footsteps(-1),
            "n_steps must be an integer >= 0, got -1.",
        ),
        (
            lambda: FootstepPlanner().generate_footsteps(3, ramp="two"),
            "ramp must be an integer >= 0, got 'two'.",
        ),
        (
            lambda: FootstepPlanner().generate_footsteps(3, start_foot="both"),
            "start_foot must be 'left' or 'right', got 'both'.",
        ),
        (
            lambda: FootstepPlanner().generate_footsteps(3, turn=np.inf),
            "turn must be finite (rad per step), got inf.",
        ),
        (
            lambda: FootstepPlanner().generate_footsteps(3, (1.0,)),
            "start_pos must be (x, y) or (x, y, yaw) in m and rad, got (1.0,).",
        ),
        (lambda: Stride(np.nan), "forward must be finite (m), got nan."),
        (lambda: Stride(width=0.0), "width must be > 0 m, got 0.0."),
        (
            lambda: Stride(double_support_ratio=0.0),
            "double_support_ratio must be in (0, 1), the share of the step time, got 0.0.",
        ),
    ],
)
def test_sizes_that_cannot_be_are_refused(make, sentence):
    with raises(sentence):
        make()


def test_support_phase_names_the_standing_foot_and_the_progress():
    planner = FootstepPlanner(0.15, 0.1, 0.5, 0.2)
    plan = planner.generate_footsteps(4, start_foot="left")
    first, second = plan.steps[:2]
    assert planner.get_support_phase(-1.0, plan) == ("double", 0.0)
    assert planner.get_support_phase(0.5 * first.lift, plan) == ("double", 0.5)
    middle = 0.5 * (first.lift + first.land)
    assert planner.get_support_phase(middle, plan) == ("right_support", pytest.approx(0.5))
    between = 0.25 * second.lift + 0.75 * first.land
    assert planner.get_support_phase(between, plan) == ("double", pytest.approx(0.25))
    assert planner.get_support_phase(second.lift, list(plan)) == ("left_support", 0.0)
    assert planner.get_support_phase(99.0, plan) == ("double", 1.0)


@given(st.floats(-1.0, 8.0))
def test_progress_stays_between_nought_and_one(t):
    planner = FootstepPlanner()
    plan = planner.generate_footsteps(8)
    phase, progress = planner.get_support_phase(t, plan)
    assert 0.0 <= progress <= 1.0
    assert phase == ("double", "left_support", "right_support")[plan.support(t)]


def test_a_walk_goes_on_after_a_stand_in_which_the_weight_shifts():
    """However slowly it does: there and back takes two shifts."""
    soles = pose_at(0.0, 0.1, 0.0), pose_at(0.0, -0.1, 0.0)
    for shift, pause in ((0.4, STAND_TIME), (1.2, 2.4)):
        before = FootstepPlan.standing(*soles, start=1.0, weight_shift=shift)
        plan = FootstepPlanner(0.2, 0.2, 0.9).walk([Stride(0.2), Stride()], before)
        assert plan.steps[0].lift == pytest.approx(1.0 + pause)
