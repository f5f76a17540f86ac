"""What one step may be."""

import re
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from preview_walk.errors import InvalidInput
from preview_walk.footsteps.limits import GaitLimits
from preview_walk.geometry.poses import compose, pose_at, relative
from preview_walk.geometry.support import Sole, sole_gap
from preview_walk.types import FEET

LIMITS = GaitLimits(sole=Sole(0.1, 0.05), step_width=0.2, min_width=0.12, max_width=0.4)


def raises(sentence):
    return pytest.raises(InvalidInput, match=f"^{re.escape(sentence)}$")


@pytest.mark.parametrize(
    ("foot", "landing", "z", "problem"),
    [
        ("left", (0.0, 0.2), 0.0, None),
        ("right", (0.3, -0.2, -0.1), 0.1, None),
        (
            "left",
            (0.6, 0.2),
            0.0,
            ("lands 0.600 m ahead of the right sole, at most 0.500 m is allowed", "step_length"),
        ),
        (
            "right",
            (-0.4, -0.2),
            0.0,
            ("lands 0.400 m behind the left sole, at most 0.300 m is allowed", "step_length"),
        ),
        (
            "right",
            (0.0, -0.5),
            0.0,
            ("lands 0.500 m beside the left sole, at most 0.400 m is allowed", "step_width"),
        ),
        (
            "left",
            (0.3, -0.1),
            0.0,
            ("lands -0.100 m beside the right sole, at least 0.120 m is allowed", "step_width"),
        ),
        (
            "left",
            (0.0, 0.3, 0.6),
            0.0,
            (
                "turns 0.600 rad (34.4 degrees) out from the right sole, "
                "at most 0.500 rad (28.6 degrees) is allowed",
                "turn",
            ),
        ),
        (
            "right",
            (0.0, -0.3, 0.3),
            0.0,
            (
                "turns 0.300 rad (17.2 degrees) in to the left sole, "
                "at most 0.200 rad (11.5 degrees) is allowed",
                "turn",
            ),
        ),
        (
            "left",
            (0.0, 0.2),
            -0.3,
            (
                "lands 0.300 m higher or lower than the right sole, at most 0.200 m is allowed",
                "footholds",
            ),
        ),
        (
            "left",
            (0.0, 0.12, 0.4),
            0.0,
            (
                "collides with the right sole (overlap 0.015 m), at least 0.010 m must stay free",
                "turn",
            ),
        ),
    ],
)
def test_problems_in_words(foot, landing, z, problem):
    where = (3.0, -4.0, 2.0)
    found = LIMITS.problem(foot, pose_at(*where), pose_at(*compose(where, *landing), z))
    assert (found and (found.text, found.argument)) == problem


def test_a_narrow_gap_is_told_from_a_collision():
    tight = replace(LIMITS, min_width=0.1)
    found = tight.problem("left", np.eye(4), pose_at(0.0, 0.105))
    assert found.text == "passes 0.005 m from the right sole, at least 0.010 m must stay free"
    assert found.argument == "step_width"


def test_a_turned_sole_is_too_near_by_its_turn():
    found = LIMITS.problem("left", np.eye(4), pose_at(0.0, 0.11, -0.1))
    assert found.text == "lands 0.110 m beside the right sole, at least 0.120 m is allowed"
    assert found.argument == "turn"


def test_a_swing_across_the_standing_sole():
    stance, start, landing = pose_at(0.0, 0.0), pose_at(0.0, -0.2), pose_at(0.0, 0.2)
    found = LIMITS.crossing("left", stance, start, landing)
    assert found.text == "swings across the right sole (overlap 0.100 m)"
    assert found.argument == "step_width"
    assert LIMITS.crossing("left", stance, landing, landing) is None


headings = st.tuples(st.floats(-2, 2), st.floats(-2, 2), st.floats(-3.1, 3.1))


@given(st.sampled_from(FEET), headings, headings)
def test_a_clamped_step_is_allowed_and_clamping_it_again_changes_nothing(foot, stance, goal):
    landing = LIMITS.clamp(foot, stance, goal)
    assert LIMITS.problem(foot, pose_at(*stance), pose_at(*landing)) is None
    assert LIMITS.clamp(foot, stance, landing) == landing
    assert sole_gap(stance, landing, LIMITS.sole) >= LIMITS.clearance - 1e-9


@given(st.sampled_from(FEET), headings, headings, headings)
def test_limits_do_not_care_where_the_world_begins(foot, stance, goal, where):
    here = LIMITS.clamp(foot, stance, goal)
    there = LIMITS.clamp(foot, compose(where, *stance), compose(where, *goal))
    # A step on the edge of a bound may fall on either side of it by rounding: 1 cm wider.
    assert relative(where, there)[:2] == pytest.approx(here[:2], abs=0.011)


def test_a_leg_gives_limits_in_proportion():
    a = GaitLimits.for_leg(0.85, 0.2)
    b = GaitLimits.for_leg(4 * 0.85, 0.8, Sole(0.4, 0.18))
    assert b.forward == pytest.approx(4 * a.forward)
    assert b.slow_step_time == pytest.approx(2 * a.slow_step_time)
    assert a.slow_step_time == pytest.approx(0.7, abs=0.01)
    assert a.fast_step_time == pytest.approx(0.6, abs=0.01)


@pytest.mark.parametrize(
    ("make", "sentence"),
    [
        (lambda: GaitLimits(forward=0.0), "forward must be > 0 m, got 0.0."),
        (
            lambda: GaitLimits(step_width=0.5),
            "step_width must be between min_width and max_width, got 0.12 <= 0.5 <= 0.4 m.",
        ),
        (
            lambda: GaitLimits(slow_step_time=0.7, fast_step_time=0.3),
            "fast_step_time must be more than half of slow_step_time and not longer, "
            "got 0.3 s and 0.7 s.",
        ),
        (
            lambda: GaitLimits(slow_double_support=1.0),
            "slow_double_support must be in (0, 1), the share of the step time, got 1.0.",
        ),
        (lambda: GaitLimits.for_leg(-1.0, 0.2), "leg_length must be > 0 m, got -1.0."),
        (
            lambda: GaitLimits.for_leg(0.8, 0.1, Sole(0.1, 0.06)),
            "a step_width of 0.1 m is too narrow for soles 0.12 m wide with 0.01 m between them.",
        ),
    ],
)
def test_limits_that_cannot_be_are_refused(make, sentence):
    with raises(sentence):
        make()
