"""Which plans may take over a walk, and what the others are told."""

import re
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from preview_walk.footsteps.handover import refusal
from preview_walk.footsteps.limits import GaitLimits
from preview_walk.footsteps.plan import FootstepPlan
from preview_walk.footsteps.planner import FootstepPlanner
from preview_walk.footsteps.velocity import follow_velocity
from preview_walk.geometry.poses import pose_at
from preview_walk.geometry.support import Sole
from preview_walk.types import FEET

LIMITS = GaitLimits.for_leg(0.87, 0.2, Sole(0.1, 0.06))
PLANNER = FootstepPlanner(0.25, 0.2, 0.7)
PLAN = PLANNER.generate_footsteps(6, (5.0, 5.0, 2.0))
FIRST, SECOND = PLAN.steps[:2]
IN_AIR = 0.5 * (SECOND.lift + SECOND.land)
ON_TWO_FEET = 0.5 * (FIRST.land + SECOND.lift)


def measured(plan, t, by=None):
    """The soles where the plan has them, moved by a pose in their own axes."""
    by = np.eye(4) if by is None else by
    return {foot: plan.sole(foot, t) @ by for foot in FEET}


def told(plan, t, current=PLAN, soles=None):
    soles = measured(current, t) if soles is None else soles
    error = refusal(plan, current, t, LIMITS, soles)
    return None if error is None else (str(error), error.argument)


def shifted(seconds):
    """The plan so much later."""
    later = [replace(s, lift=s.lift + seconds, land=s.land + seconds) for s in PLAN]
    return FootstepPlan(later)


@pytest.mark.parametrize("t", [0.0, ON_TWO_FEET, IN_AIR, SECOND.lift, SECOND.land, PLAN.end + 1.0])
def test_the_plan_that_is_walked_may_go_on_with_and_without_its_past(t):
    assert told(PLAN, t) is None
    assert told(PLAN.since(t), t) is None
    assert told([*PLAN], t) is None


@given(
    st.lists(
        st.tuples(st.floats(-0.6, 0.9), st.floats(-0.3, 0.3), st.floats(-0.8, 0.8)),
        min_size=2,
        max_size=6,
    ),
    st.floats(0.1, 2.0),
)
def test_walks_by_command_may_always_take_over(commands, every):
    plan, t = PLANNER.stand((1.0, -2.0, 0.7)), 0.0
    for command in commands:
        changed = follow_velocity(plan, t, command, LIMITS).since(t)
        assert told(changed, t, plan) is None
        plan, t = changed, t + every


def test_a_foothold_out_of_reach():
    far = replace(PLAN.steps[3], pose=PLAN.steps[3].pose @ pose_at(0.5, 0.0))
    plan = PLAN.replace_after(IN_AIR, [PLAN.steps[2], far, *PLAN.steps[4:]])
    sentence, argument = told(plan, IN_AIR)
    assert sentence == (
        "the plan cannot be walked: at 4.260 s step 4 lands 0.750 m ahead of the left sole, "
        "at most 0.652 m is allowed."
    )
    assert argument == "step_length"
    # Once it has landed there it is history, and as far as the plan that is walked goes it stays.
    assert told(plan, IN_AIR, plan) is None
    assert told(plan.since(far.land + 0.01), far.land + 0.01, plan) is None


def test_a_step_that_is_kept_but_from_another_sole_is_judged():
    # The step in the air lands further back: the one after it is as before, but too long now.
    assert told(PLAN.retarget(IN_AIR, SECOND.pose @ pose_at(-0.3, 0.0)), IN_AIR) is None
    assert told(PLAN.retarget(IN_AIR, SECOND.pose @ pose_at(-0.45, 0.0)), IN_AIR) == (
        "the plan cannot be walked: at 3.560 s step 3 lands 0.700 m ahead of the right sole, "
        "at most 0.652 m is allowed.",
        "step_length",
    )


def test_steps_that_have_landed_are_history():
    first = replace(FIRST, pose=FIRST.pose @ pose_at(0.6, 0.0))
    plan = FootstepPlan([*PLAN[:2], first, *PLAN.steps[1:]])
    assert told(plan, PLAN.steps[2].land) is None  # both feet have stepped since
    assert "step 1 lands" in told(plan, 0.0)[0]


def test_a_landing_too_soon():
    t = SECOND.lift + 0.05
    sentence, argument = told(PLAN.retarget(t, SECOND.pose, SECOND.lift + 0.2), t)
    assert "step 2 is 0.200 s in the air, at least 0.253 s is needed" in sentence
    assert argument == "step_time"


def test_a_stance_elsewhere_or_turned():
    half = "at most half a sole (0.100 m along, 0.060 m across) is allowed."
    plan = PLANNER.generate_footsteps(4, (5.6, 5.0, 2.0))
    assert told(plan, 0.0) == (
        f"at 0.000 s the plan has the left sole 0.600 m from where it stands, {half}",
        "plan",
    )
    plan = PLANNER.generate_footsteps(4, (5.0, 5.0, 2.0 + np.pi / 2))
    assert told(plan, 0.0) == (
        "at 0.000 s the plan has the left sole turned by 1.571 rad (90.0 degrees) from how it "
        "stands, at most 0.200 rad (11.5 degrees) is allowed.",
        "plan",
    )
    assert told(PLAN.transformed(pose_at(0.0, 0.0, 0.0, 0.3)), 0.0) == (
        "at 0.000 s the plan has the left sole 0.300 m higher or lower than it stands, "
        "at most 0.217 m is allowed.",
        "plan",
    )


@pytest.mark.parametrize("foot", FEET)
@pytest.mark.parametrize(
    ("by", "fits"),
    [
        (pose_at(0.099, 0.0), True),
        (pose_at(0.101, 0.0), False),
        (pose_at(-0.101, 0.0), False),
        (pose_at(0.0, 0.059), True),
        (pose_at(0.0, -0.061), False),
        (pose_at(0.0, 0.0, 0.19), True),
        (pose_at(0.0, 0.0, -0.21), False),
        (pose_at(0.0, 0.0, 0.21), False),
        # Turned soles: the plan's centre lies on the sole that stands, seen along that sole.
        (np.linalg.inv(pose_at(0.095, 0.05, 0.19)), True),
        (pose_at(0.095, 0.05, 0.19), False),
        (pose_at(0.0, 0.0, 0.0, 0.05), True),
    ],
)
def test_a_sole_may_be_off_by_half_a_sole(foot, by, fits):
    # Along the sole and across it, whichever way the walk goes.
    soles = {**measured(PLAN, ON_TWO_FEET), foot: PLAN.sole(foot, ON_TWO_FEET) @ by}
    found = told(PLAN, ON_TWO_FEET, soles=soles)
    assert (found is None) == fits
    assert fits or foot in found[0]


def test_where_the_foot_in_the_air_is_does_not_count():
    soles = {**measured(PLAN, IN_AIR), "right": pose_at(9.0, 9.0)}
    assert told(PLAN, IN_AIR, soles=soles) is None


def test_a_plan_that_is_over_elsewhere():
    t = PLAN.end + 5.0
    old = PLANNER.generate_footsteps(4, (5.0, 5.0, 2.0))
    assert told(old, t) == (
        f"at {t:.3f} s the plan, which was over at {old.end:.3f} s, has the left sole 0.500 m from "
        "where it stands, at most half a sole (0.100 m along, 0.060 m across) is allowed.",
        "plan",
    )
    # Over, but where the feet are: the robot stands.
    assert told(PLAN, t) is None


@pytest.mark.parametrize(
    ("plan", "t", "sentence"),
    [
        (shifted(0.3), IN_AIR, "has the right foot on the ground, but it is in the air since 2.3"),
        (shifted(-0.2), ON_TWO_FEET, "has the right foot in the air since 2.100 s, but it stands"),
        (shifted(0.01), IN_AIR, "has lifted the right foot at 2.310 s, but it lifted at 2.300 s"),
        (PLANNER.stand((5.0, 5.0, 2.0)), FIRST.lift, "has the left foot on the ground, but it is"),
    ],
)
def test_a_foot_that_is_in_the_air_in_one_of_the_two(plan, t, sentence):
    text, argument = told(plan, t)
    assert re.match(rf"at {t:.3f} s the plan(, which was over at 0.000 s,)? {sentence}", text)
    assert argument == "plan"


@pytest.mark.parametrize("plan", [None, "walk", 3, [1, 2], {"foot": "left"}])
def test_what_is_no_plan(plan):
    text, argument = told(plan, 0.0)
    assert text.startswith("plan ")
    assert argument == "plan"
