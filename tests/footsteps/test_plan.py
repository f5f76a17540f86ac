"""Footsteps as values, plans as immutable sequences of them."""

import re

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from preview_walk.errors import InvalidInput
from preview_walk.footsteps.footstep import Footstep
from preview_walk.footsteps.plan import WEIGHT_SHIFT_TIME, FootstepPlan
from preview_walk.footsteps.planner import FootstepPlanner
from preview_walk.geometry.poses import pose_at
from preview_walk.pattern.zmp_reference import zmp_reference
from preview_walk.types import FEET, LEFT_SUPPORT, RIGHT_SUPPORT, other

PLAN = FootstepPlanner(0.25, 0.2, 0.7).generate_footsteps(8, (1.0, 2.0, 0.5))


def raises(sentence):
    return pytest.raises(InvalidInput, match=f"^{re.escape(sentence)}$")


def step(foot, lift, land, x=0.0):
    return Footstep(foot, pose_at(x, 0.1 if foot == "left" else -0.1), lift, land)


def standing():
    return FootstepPlan.standing(pose_at(0.0, 0.1), pose_at(0.0, -0.1))


def test_a_footstep_has_the_keys_of_the_walking_lab():
    s = PLAN.steps[0]
    assert (s["foot"], s["time"], s["type"]) == (s.foot, s.land, "swing_end")
    assert np.array_equal(s["pos"], s.pose[:2, 3])
    assert s.yaw == pytest.approx(0.5)
    with pytest.raises(KeyError, match="the keys foot, pos, time, type, not 'pose'"):
        s["pose"]


def test_a_footstep_keeps_its_own_pose():
    mine = np.eye(4)
    kept = Footstep("left", mine, 0.0, 1.0)
    mine[0, 3] = 9.0
    assert kept.pos[0] == 0.0
    with pytest.raises(ValueError, match="read-only"):
        kept.pose[0, 3] = 1.0


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (("third", np.eye(4), 0.0, 1.0), "foot must be 'left' or 'right', got 'third'."),
        (
            ("left", np.eye(4), 0.0, 1.0, "hop"),
            "type must be 'stance' or 'swing_end', got 'hop'.",
        ),
        (
            ("left", np.eye(4), 1.0, 1.0),
            "a swing_end footstep needs times with lift < land, got 1.0 s, 1.0 s.",
        ),
        (
            ("left", np.eye(4), 0.0, 1.0, "stance"),
            "a stance footstep needs times with lift == land, got 0.0 s, 1.0 s.",
        ),
        (
            ("left", np.eye(4), 0.0, np.inf),
            "land must be finite (s), got inf.",
        ),
    ],
)
def test_a_footstep_that_cannot_be_is_refused(arguments, sentence):
    with raises(sentence):
        Footstep(*arguments)


def test_a_plan_needs_two_stance_soles_first():
    left, right = standing()
    with raises("a plan must begin with one left and one right stance footstep, got left stance."):
        FootstepPlan([left])
    with raises(
        "a plan must begin with one left and one right stance footstep, "
        "got left stance, left stance."
    ):
        FootstepPlan([left, left])
    late = Footstep("right", right.pose, 1.0, 1.0, "stance")
    with raises("both stance footsteps must have the same time, got 0.0 s and 1.0 s."):
        FootstepPlan([left, late])
    with raises("weight_shift must be > 0 s, got 0.0."):
        FootstepPlan([left, right], weight_shift=0.0)
    assert [s.foot for s in FootstepPlan([right, left])] == ["left", "right"]


@pytest.mark.parametrize(
    ("steps", "sentence"),
    [
        (
            [step("left", 1.0, 1.5), step("left", 1.6, 2.0)],
            "step 2 must be taken by the right foot, because step 1 was taken by the left foot "
            "0.100 s before (a foot may go twice after a stand of 0.800 s).",
        ),
        (
            [step("left", 1.0, 1.5), step("right", 1.5, 2.0)],
            "step 2 must lift after step 1 lands at 1.500 s, got a lift at 1.500 s.",
        ),
        (
            [step("left", -0.5, 1.5)],
            "step 1 must lift after the plan starts at 0.000 s, got a lift at -0.500 s.",
        ),
        (
            [Footstep("left", np.eye(4), 1.0, 1.0, "stance")],
            "step 1 must be of type 'swing_end', got 'stance'.",
        ),
    ],
)
def test_a_plan_out_of_order_is_refused(steps, sentence):
    with raises(sentence):
        FootstepPlan([*standing(), *steps])


def test_a_foot_may_go_twice_after_a_stand():
    first = step("left", 1.0, 1.5)
    plan = FootstepPlan([*standing(), first, step("left", 1.5 + 2 * WEIGHT_SHIFT_TIME, 3.0)])
    assert [s.foot for s in plan.steps] == ["left", "left"]


def slow_support(plan, t):
    return next((s for s in plan.steps if s.lift <= t < s.land), None)


@given(st.floats(-1.0, 9.0))
def test_look_ups_agree_with_a_walk_through_the_list(t):
    swing = slow_support(PLAN, t)
    assert PLAN.swing_at(t) is swing
    code = {None: 0, "right": LEFT_SUPPORT, "left": RIGHT_SUPPORT}
    assert PLAN.support(t) == code[swing and swing.foot]
    for foot in FEET:
        landed = [s for s in PLAN if s.foot == foot and s.land <= t] or [
            s for s in PLAN[:2] if s.foot == foot
        ]
        assert PLAN.sole(foot, t) is landed[-1].pose
    assert PLAN.next_landing(t) is next((s for s in PLAN.steps if s.land > t), None)
    assert PLAN.next_lift(t) is next((s for s in PLAN.steps if s.lift > t), None)
    assert PLAN.lifted(t) == tuple(s for s in PLAN.steps if s.lift <= t)


@given(st.floats(0.0, 9.0))
def test_replacing_the_future_keeps_what_is_lifted(t):
    new = PLAN.replace_after(t, [])
    assert new.steps == PLAN.lifted(t)
    again = new.replace_after(t, PLAN.steps[len(new.steps) :])
    assert list(again) == list(PLAN)


def test_a_new_step_must_be_in_the_future():
    with raises("a new step must lift after t = 3.000 s, got 2.500 s."):
        PLAN.replace_after(3.0, [step("left", 2.5, 3.1)])


@given(st.integers(0, 7), st.floats(0.0, 0.99), st.floats(0.01, 0.5))
def test_retargeting_moves_one_landing_and_delays_the_rest(index, share, late):
    old = PLAN.steps[index]
    t = old.lift + share * (old.land - old.lift)
    pose = pose_at(9.0, 9.0, 1.0)
    new = PLAN.retarget(t, pose, old.land + late)
    assert np.array_equal(new.steps[index].pose, pose)
    assert new.steps[index].lift == old.lift
    for before, after in zip(PLAN.steps[index + 1 :], new.steps[index + 1 :], strict=True):
        assert after.lift - before.lift == pytest.approx(late)
        assert np.array_equal(after.pose, before.pose)
    assert PLAN.retarget(t, pose).steps[index + 1 :] == PLAN.steps[index + 1 :]


def test_only_a_foot_in_the_air_is_retargeted():
    with raises("no foot is in the air at t = 0.500 s, so none can be retargeted."):
        PLAN.retarget(0.5, np.eye(4))
    t = PLAN.steps[0].lift + 0.1
    with raises(f"land must be after t = {t:.3f} s, got 0.0 s."):
        PLAN.retarget(t, np.eye(4), 0.0)


@given(st.floats(0.0, 9.0), st.floats(0.0, 4.0))
def test_forgetting_the_past_changes_nothing_to_come(t, later):
    short = PLAN.since(t)
    assert len(short.steps) <= len(PLAN.steps)
    assert short.support(t + later) == PLAN.support(t + later)
    for foot in FEET:
        assert np.array_equal(short.sole(foot, t + later), PLAN.sole(foot, t + later))
    a, b = zmp_reference(short).at(t + later), zmp_reference(PLAN).at(t + later)
    assert np.allclose(a, b, atol=1e-12)
    assert short.end == PLAN.end


def test_a_plan_moves_as_one():
    by = pose_at(100.0, -50.0, 2.0, 1.0)
    moved = PLAN.transformed(by)
    for a, b in zip(PLAN, moved, strict=True):
        assert np.allclose(by @ a.pose, b.pose)
        assert (a.foot, a.lift, a.land) == (b.foot, b.lift, b.land)


def test_a_plan_is_a_sequence():
    assert len(PLAN) == 10
    assert PLAN[2:] == PLAN.steps
    assert PLAN[-1].land + PLAN.weight_shift == PLAN.end
    assert [other(s.foot) for s in PLAN.steps[:-1]] == [s.foot for s in PLAN.steps[1:]]
    assert repr(standing()) == "FootstepPlan(0 steps, 0.000 s to 0.000 s)"
    assert standing().end == 0.0
