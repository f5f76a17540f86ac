"""Velocity commands at any moment: complete plans, nothing changed that is under way."""

import re

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from preview_walk.errors import InvalidInput
from preview_walk.footsteps.limits import GaitLimits
from preview_walk.footsteps.planner import FootstepPlanner
from preview_walk.footsteps.velocity import LEAD, follow_velocity, rhythm, saturated
from preview_walk.geometry.poses import midfeet, pose_at
from preview_walk.geometry.support import Sole
from preview_walk.pattern.check import check_plan
from preview_walk.pattern.zmp_reference import zmp_reference

LIMITS = GaitLimits.for_leg(0.87, 0.17, Sole(0.1, 0.0675))
STAND = FootstepPlanner(0.25, 0.17, 0.7).stand((3.0, -2.0, 1.0))


def raises(sentence):
    return pytest.raises(InvalidInput, match=f"^{re.escape(sentence)}$")


def end_of(plan):
    return midfeet(plan.sole("left", plan.end), plan.sole("right", plan.end))


def assert_stops(plan):
    left, right = plan.sole("left", plan.end), plan.sole("right", plan.end)
    apart = np.linalg.inv(right) @ left
    assert np.allclose(apart, pose_at(0.0, LIMITS.step_width), atol=1e-9)


commands = st.tuples(st.floats(-2, 2), st.floats(-0.5, 0.5), st.floats(-1, 1))
sequences = st.lists(st.tuples(st.floats(0.0, 2.5), commands), min_size=1, max_size=8)


@settings(max_examples=80)
@given(sequences)
def test_commands_at_any_moment(sequence):
    plan, t = STAND, 0.0
    for wait, command in sequence:
        t += wait
        new = follow_velocity(plan, t, command, LIMITS)
        # What is under way is kept, and so is the ZMP up to now.
        kept = plan.lifted(t + LEAD)
        assert new.steps[: len(kept)] == kept
        planned = plan.steps[len(kept) : len(kept) + 1]
        if planned:
            first = new.steps[len(kept)]
            assert (first.foot, first.lift) == (planned[0].foot, planned[0].lift)
        past = np.linspace(0.0, t + LEAD, 50)
        old_zmp, new_zmp = zmp_reference(plan, LIMITS.sole), zmp_reference(new, LIMITS.sole)
        assert np.array_equal(old_zmp.at(past), new_zmp.at(past))
        # The plan is complete, and every step of it can be walked.
        assert_stops(new)
        assert check_plan(new, LIMITS) == ()
        plan = new


@settings(max_examples=40)
@given(sequences, st.tuples(st.floats(-100, 100), st.floats(-100, 100), st.floats(-3, 3)))
def test_commands_do_not_care_where_the_world_begins(sequence, where):
    by = pose_at(*where)
    here, there, t = STAND, STAND.transformed(by), 0.0
    for wait, command in sequence:
        t += wait
        here = follow_velocity(here, t, command, LIMITS)
        there = follow_velocity(there, t, command, LIMITS)
    assert len(here) == len(there)
    for a, b in zip(here.transformed(by), there, strict=True):
        assert np.allclose(a.pose, b.pose, atol=0.011)  # a widened step may round either way
        assert a.lift == pytest.approx(b.lift)


@pytest.mark.parametrize("command", [(0.5, 0, 0), (0, 0.1, 0), (0, 0, 0.4), (0.3, 0.03, -0.2)])
def test_the_same_command_again_changes_only_the_end(command):
    plan = follow_velocity(STAND, 0.0, command, LIMITS)
    for t in (0.4, 1.5, 2.2, 2.9, 3.5):
        new = follow_velocity(plan, t, command, LIMITS)
        same = [s for s in plan.steps if s.lift < t]
        steady = [s for s in plan.steps if t <= s.lift < plan.steps[0].lift + 1.0]
        for a, b in zip([*same, *steady], new.steps, strict=False):
            assert np.allclose(a.pose, b.pose, atol=1e-9)
            assert (a.lift, a.land) == (b.lift, b.land)
        plan = new


@pytest.mark.parametrize("vx", [-0.3, 0.2, 0.5, 0.9])
def test_reaches_the_forward_speed(vx):
    plan = follow_velocity(STAND, 0.0, (vx, 0.0, 0.0), LIMITS, 12.0)
    a, b = plan.steps[8], plan.steps[9]
    along = (b.pos - a.pos)[:2] @ [np.cos(1.0), np.sin(1.0)]
    assert along / (b.land - a.land) == pytest.approx(vx, rel=1e-6)


def test_reaches_the_sideways_speed_and_the_yaw_rate():
    plan = follow_velocity(STAND, 0.0, (0.0, 0.1, 0.0), LIMITS, 12.0)
    a, b = plan.steps[4], plan.steps[8]
    left = (b.pos - a.pos)[:2] @ [-np.sin(1.0), np.cos(1.0)]
    assert left / (b.land - a.land) == pytest.approx(0.1)
    plan = follow_velocity(STAND, 0.0, (0.0, 0.0, 0.3), LIMITS, 12.0)
    a, b = plan.steps[4], plan.steps[8]
    assert (b.yaw - a.yaw) / (b.land - a.land) == pytest.approx(0.3)


def test_walks_a_circle():
    plan = follow_velocity(STAND, 0.0, (0.3, 0.0, 0.3), LIMITS, 20.0)
    centre = np.array([3.0 - np.sin(1.0), -2.0 + np.cos(1.0)])
    distance = [np.linalg.norm(s.pos[:2] - centre) for s in plan.steps]
    assert np.mean(distance) == pytest.approx(1.0, abs=0.05)


def test_speed_changes_a_little_at_each_step():
    plan = follow_velocity(STAND, 0.0, (0.8, 0.0, 0.0), LIMITS, 6.0)
    x = [(s.pos[:2] - STAND[0].pos[:2]) @ [np.cos(1.0), np.sin(1.0)] for s in plan.steps]
    speeds = np.diff([0.0, *x]) / [rhythm(v, LIMITS)[0] for v in speeds_of(np.diff([0.0, *x]))]
    assert np.abs(np.diff([0.0, *speeds])).max() <= LIMITS.speed_change + 1e-9
    assert speeds.max() == pytest.approx(0.8)


def speeds_of(lengths):
    """Invert length = speed * step time by bisection."""
    result = []
    for length in lengths:
        low, high = 0.0, 2.0
        for _ in range(60):
            middle = 0.5 * (low + high)
            long = middle * rhythm(middle, LIMITS)[0] > length
            low, high = (low, middle) if long else (middle, high)
        result.append(low)
    return result


def test_standing_still_stays():
    assert follow_velocity(STAND, 0.5, (0.0, 0.0, 0.0), LIMITS) is STAND
    walk = follow_velocity(STAND, 0.0, (0.3, 0.0, 0.0), LIMITS)
    assert follow_velocity(walk, walk.end + 1.0, (0.0, 0.0, 0.0), LIMITS) is walk


def test_starts_again_after_a_stop_with_the_foot_on_the_side_it_goes_to():
    walk = follow_velocity(STAND, 0.0, (0.3, 0.0, 0.0), LIMITS)
    for vy, foot in ((0.1, "left"), (-0.1, "right")):
        again = follow_velocity(walk, walk.end - 0.1, (0.0, vy, 0.0), LIMITS)
        first = again.steps[len(walk.steps)]
        assert first.foot == foot
        assert first.lift - walk[-1].land >= 2 * walk.weight_shift - 1e-9


def test_stops_within_a_few_steps():
    plan = follow_velocity(STAND, 0.0, (0.5, 0.0, 0.0), LIMITS, 10.0)
    t = plan.steps[6].lift + 0.1
    stop = follow_velocity(plan, t, (0.0, 0.0, 0.0), LIMITS)
    assert len(stop.steps) <= 7 + 4
    assert stop.end < t + 4.0


@given(st.floats(0.0, 1.2))
def test_rhythm_quickens_with_the_speed(speed):
    time, ratio = rhythm(speed, LIMITS)
    assert LIMITS.fast_step_time <= time <= LIMITS.slow_step_time
    assert LIMITS.fast_double_support <= ratio + 1e-12
    assert ratio <= LIMITS.slow_double_support
    assert rhythm(-speed, LIMITS) == (time, ratio)


@given(commands)
def test_too_fast_commands_keep_their_direction(command):
    out = saturated(command, LIMITS)
    assert np.cross(out, command) == pytest.approx(np.zeros(3), abs=1e-9)
    assert np.dot(out, command) >= 0.0
    assert saturated(out, LIMITS) == pytest.approx(out)
    if max(map(abs, command)) < 0.1:
        assert out == command


@pytest.mark.parametrize("command", [(1.0, 2.0), (0.0, np.nan, 0.0), "fast", None])
def test_what_is_no_command_is_refused(command):
    with raises(
        f"a velocity command must be (vx, vy, yaw rate), finite, in m/s and rad/s, got {command!r}."
    ):
        follow_velocity(STAND, 0.0, command, LIMITS)


def test_times_are_checked():
    with raises("duration must be >= 0 s, got -1.0."):
        follow_velocity(STAND, 0.0, (0.1, 0.0, 0.0), LIMITS, -1.0)
    with raises("t must be finite (s), got nan."):
        follow_velocity(STAND, np.nan, (0.1, 0.0, 0.0), LIMITS)
