"""The CoM's height: what the legs reach, and where over a plan it changes."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from preview_walk.footsteps.gaits import sideways
from preview_walk.footsteps.goals import from_list
from preview_walk.footsteps.limits import GaitLimits
from preview_walk.footsteps.plan import FootstepPlan
from preview_walk.footsteps.planner import FootstepPlanner
from preview_walk.geometry.poses import pose_at
from preview_walk.pattern.com_height import (
    LONGEST_STRETCH,
    LOWEST_HIPS,
    LegGeometry,
    wanted_heights,
)
from preview_walk.types import FEET, Array, Foot

LEGS = LegGeometry(length=0.81, hip_height=0.747, com_height=0.876)
DT = 0.005


def fast_walk(step_length: float = 0.5, ratio: float = 0.05) -> FootstepPlan:
    planner = FootstepPlanner(step_length, 0.17, 0.62, ratio)
    return planner.generate_footsteps(10, ramp=3)


def stairs(rise: float = 0.1, count: int = 4) -> FootstepPlan:
    """Return a walk up stairs of 0.28 m, each foot on every other stair, and the last joined."""
    places: list[tuple[Foot, Array]] = []
    for k in range(1, count + 2):
        stair, foot = min(k, count), FEET[(k + 1) % 2]
        side = 0.085 if foot == "left" else -0.085
        places.append((foot, pose_at(0.28 * stair, side, 0.0, rise * stair)))
    return from_list(places, FootstepPlanner(0.28, 0.17, 0.9), limits=GaitLimits(backward=0.4))


def times_of(plan: FootstepPlan) -> Array:
    return np.arange(plan.start, plan.end, DT)


@given(st.floats(0.0, 1.5), st.floats(0.5, 1.0))
def test_both_legs_reach_their_soles(spread: float, posture: float) -> None:
    legs = LegGeometry(0.81, posture * 0.81, posture * 0.81 + 0.13)
    hips = legs.com_over(spread) - (legs.com_height - legs.hip_height)
    assert hips <= max(legs.hip_height, LOWEST_HIPS * legs.length) + 1e-12
    lowest = hips <= LOWEST_HIPS * legs.length + 1e-12
    assert lowest or np.hypot(0.5 * spread, hips) <= LONGEST_STRETCH * legs.length + 1e-12
    assert legs.com_over(spread + 0.1) <= legs.com_over(spread)


def test_short_and_sideways_steps_leave_the_posture_alone() -> None:
    limits = GaitLimits(step_width=0.17, max_width=0.45)
    planner = FootstepPlanner(0.2, 0.17, 0.8)
    for plan in (planner.generate_footsteps(6), sideways(0.6, planner, limits=limits)):
        assert wanted_heights(plan, times_of(plan), LEGS) == pytest.approx(0.876, abs=1e-12)


def test_long_steps_lower_the_com_from_swing_to_swing() -> None:
    plan = fast_walk()
    times = times_of(plan)
    heights = wanted_heights(plan, times, LEGS)
    assert heights[0] == heights[-1] == LEGS.com_height
    assert 0.004 < LEGS.com_height - heights.min() < 0.02
    jumps = times[1:][np.abs(np.diff(heights)) > 1e-9]
    middles = np.array([0.5 * (step.lift + step.land) for step in plan.steps])
    assert len(jumps) >= 2
    assert np.abs(jumps[:, None] - middles).min(axis=1).max() <= DT


def test_stairs_raise_the_com_by_their_height() -> None:
    plan = stairs()
    heights = wanted_heights(plan, times_of(plan), LEGS)
    assert heights[0] == LEGS.com_height
    assert heights[-1] == pytest.approx(LEGS.com_height + 0.4)
    assert (np.diff(heights) >= -1e-12).all()


@given(st.floats(-50.0, 50.0), st.floats(-50.0, 50.0), st.floats(-3.1, 3.1), st.floats(-1.0, 1.0))
def test_is_the_same_wherever_the_walk_is(x: float, y: float, yaw: float, z: float) -> None:
    plan = fast_walk()
    times = times_of(plan)
    moved = wanted_heights(plan.transformed(pose_at(x, y, yaw, z)), times, LEGS)
    assert moved - z == pytest.approx(wanted_heights(plan, times, LEGS), abs=1e-9)


@pytest.mark.parametrize("plan", [fast_walk(), fast_walk(0.4, 0.2), stairs()])
def test_does_not_depend_on_when_one_begins_to_look(plan: FootstepPlan) -> None:
    """A plan replaced under way is sampled from that moment: the future must stay the same."""
    times = times_of(plan)
    whole = wanted_heights(plan, times, LEGS)
    for first in range(0, len(times), 13):
        late = wanted_heights(plan, times[first:], LEGS)
        assert late == pytest.approx(whole[first:], abs=1e-12)
