"""The ZMP shift of swinging legs: the rate of an angular momentum, differentiated here by hand."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from preview_walk.constants import GRAVITY
from preview_walk.footsteps.plan import FootstepPlan
from preview_walk.footsteps.planner import FootstepPlanner
from preview_walk.geometry.poses import pose_at
from preview_walk.pattern.swing import swing_of
from preview_walk.pattern.swing_moment import MomentumModel, swing_zmp_shift
from preview_walk.types import Array

MASS, HEIGHT = 90.0, 0.05
DT = 0.002
# About what TALOS has, and parts that differ between the feet.
MODEL = MomentumModel(
    MASS,
    np.array([[0.0, -10.0, 0.0], [14.0, 0.0, 11.0], [0.0, -0.4, 0.0]]),
    {
        "left": np.array([[0.2, 5.2, 0.8], [-6.8, -0.2, -5.6], [-0.9, 0.2, -0.8]]),
        "right": np.array([[-0.2, 5.3, -0.8], [-6.7, 0.2, -5.5], [0.9, 0.2, 0.8]]),
    },
)


def walk(n_steps: int = 5, yaw: float = 0.0, turn: float = 0.0) -> FootstepPlan:
    planner = FootstepPlanner(0.3, 0.17, 0.7, 0.2)
    return planner.generate_footsteps(n_steps, (0.3, -0.2, yaw), turn=turn)


def times_of(plan: FootstepPlan) -> Array:
    return np.arange(plan.start, plan.end, DT)


def momentum(plan: FootstepPlan, t: float) -> Array:
    """Return L (3,) in the world at time t, from the speed of the sole in the air."""
    step = plan.swing_at(t)
    if step is None:
        return np.zeros(3)
    _, velocity, _ = swing_of(plan, step, HEIGHT).at(t)
    heading = pose_at(0.0, 0.0, step.yaw)[:3, :3]
    return np.asarray(heading @ MODEL.foot[step.foot] @ heading.T @ velocity[:3])


@pytest.mark.parametrize(("yaw", "turn"), [(0.0, 0.0), (2.1, 0.0), (-0.4, 0.2)])
def test_is_the_rate_of_the_angular_momentum(yaw: float, turn: float) -> None:
    plan, h = walk(yaw=yaw, turn=turn), 1e-5
    times = times_of(plan)
    shift = swing_zmp_shift(plan, times, MODEL, HEIGHT)
    assert np.abs(shift).max() > 0.01
    # The jerk jumps where polynomials meet: at lift, apex and landing.
    knots = np.array([(s.lift, 0.5 * (s.lift + s.land), s.land) for s in plan.steps]).ravel()
    smooth = np.abs(times[:, None] - knots).min(axis=1) > 2.0 * h
    for k in np.flatnonzero(smooth)[::5]:
        rate = (momentum(plan, times[k] + h) - momentum(plan, times[k] - h)) / (2.0 * h)
        expected = np.array((-rate[1], rate[0])) / (MASS * GRAVITY)
        assert shift[k] == pytest.approx(expected, abs=1e-6)


def test_no_swing_no_shift_and_a_swing_gives_back_what_it_took() -> None:
    """A foot starts and ends at rest: over a swing the moments cancel."""
    plan = walk(turn=0.1)
    times = times_of(plan)
    shift = swing_zmp_shift(plan, times, MODEL, HEIGHT)
    for step in plan.steps:
        inside = (times >= step.lift) & (times < step.land)
        assert np.abs(shift[inside].sum(axis=0) * DT).max() < 1e-6
    standing = np.array([plan.swing_at(t) is None for t in times])
    assert (shift[standing] == 0.0).all()


@settings(max_examples=20)
@given(st.floats(-3.1, 3.1), st.floats(-50.0, 50.0), st.floats(-50.0, 50.0))
def test_turns_with_the_walk(yaw: float, x: float, y: float) -> None:
    plan = walk(turn=0.15)
    times = times_of(plan)
    turned = swing_zmp_shift(plan.transformed(pose_at(x, y, yaw)), times, MODEL, HEIGHT)
    rotation = pose_at(0.0, 0.0, yaw)[:2, :2]
    expected = swing_zmp_shift(plan, times, MODEL, HEIGHT) @ rotation.T
    assert turned == pytest.approx(expected, abs=1e-9)


def test_does_not_depend_on_when_one_begins_to_look() -> None:
    plan = walk()
    times = times_of(plan)
    whole = swing_zmp_shift(plan, times, MODEL, HEIGHT)
    for first in range(0, len(times), 97):
        late = swing_zmp_shift(plan, times[first:], MODEL, HEIGHT)
        assert (late == whole[first:]).all()


def test_effective_height_is_that_of_a_leaning_walker() -> None:
    """A CoM that moves with L = K @ v needs the ZMP c - (z + k / m) c'' / g, per axis."""
    com_height, acceleration = 0.87, np.array((1.3, -0.7, 0.0))
    rate = MODEL.com @ acceleration
    shift = np.array((-rate[1], rate[0])) / (MASS * GRAVITY)
    zmp = -com_height * acceleration[:2] / GRAVITY + shift
    heights = -zmp * GRAVITY / acceleration[:2]
    assert MODEL.effective_height(com_height) == pytest.approx(heights.mean())
    still = MomentumModel(MASS, np.zeros((3, 3)), MODEL.foot)
    assert still.effective_height(com_height) == com_height
