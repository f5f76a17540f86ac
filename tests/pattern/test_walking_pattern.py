"""The walking pattern: consistent, on the ZMP it was asked for, live, the same anywhere."""

from dataclasses import dataclass, fields

import numpy as np
import pytest
from walker_stand_in import LEGS, MODEL, MOMENTUM, SOLE, SWING_HEIGHT, fast_walk, slow_walk

from preview_walk.constants import GRAVITY
from preview_walk.footsteps.goals import from_list
from preview_walk.footsteps.limits import GaitLimits
from preview_walk.footsteps.plan import FootstepPlan
from preview_walk.footsteps.planner import FootstepPlanner
from preview_walk.geometry.poses import midfeet, pose_at
from preview_walk.geometry.support import support_margin, support_polygon
from preview_walk.pattern.com.sampled_plan import PLANNING_DT
from preview_walk.pattern.swing_moment import swing_zmp_shift
from preview_walk.pattern.walking_pattern import ComReference, WalkingPattern
from preview_walk.pattern.zmp_reference import zmp_reference
from preview_walk.types import DOUBLE_SUPPORT, FEET, LEFT_SUPPORT, Array, Foot

DT = 0.002


@dataclass
class Motion:
    """A pattern sampled over a plan: the fields of `ComReference`, first axis time."""

    time: Array
    com: Array
    velocity: Array
    acceleration: Array
    zmp: Array
    zmp_ref: Array
    dcm: Array
    ground: Array


Walked = tuple[FootstepPlan, WalkingPattern, Motion]


def pattern_of(plan: FootstepPlan) -> WalkingPattern:
    x, y, _ = midfeet(plan[0].pose, plan[1].pose)
    com = np.array((x, y, plan[0].pos[2] + LEGS.com_height))
    return WalkingPattern(plan, com, MODEL)


def motion(pattern: WalkingPattern, times: Array) -> Motion:
    samples = [pattern.at(t) for t in times]
    columns = {
        f.name: np.array([getattr(s, f.name) for s in samples]) for f in fields(ComReference)
    }
    return Motion(time=times, **columns)


def times_of(plan: FootstepPlan, dt: float = DT) -> Array:
    return np.asarray(plan.start + dt * np.arange(int((plan.end + 1.5 - plan.start) / dt)))


@pytest.fixture(scope="module", params=[slow_walk, fast_walk])
def walked(request: pytest.FixtureRequest) -> Walked:
    plan = request.param()
    pattern = pattern_of(plan)
    return plan, pattern, motion(pattern, times_of(plan))


def test_velocity_and_acceleration_are_derivatives(walked: Walked) -> None:
    _, _, m = walked
    velocity, acceleration = (np.gradient(x, DT, axis=0) for x in (m.com, m.velocity))
    inner = slice(3, -3)
    assert np.abs(velocity - m.velocity)[inner].max() < 1e-4
    assert np.abs(acceleration - m.acceleration)[inner].max() < 3e-2
    assert np.abs(np.diff(m.acceleration, axis=0)).max() < 0.3  # no jumps


def test_the_zmp_is_that_of_the_motion(walked: Walked) -> None:
    """p = c - c'' / omega^2 and the moment of the swinging leg, with omega of the right height."""
    plan, pattern, m = walked
    height = MOMENTUM.effective_height(LEGS.com_height)
    assert pattern.omega == pytest.approx(np.sqrt(GRAVITY / height))
    shift = swing_zmp_shift(plan, m.time, MOMENTUM, SWING_HEIGHT)
    expected = m.com[:, :2] - m.acceleration[:, :2] * height / GRAVITY + shift
    # Between two planning ticks shift and ZMP are interpolated.
    tick = np.isclose(m.time % PLANNING_DT % PLANNING_DT, 0.0, atol=1e-9)
    assert np.abs(m.zmp - expected)[tick].max() < 1e-3
    assert m.dcm == pytest.approx(m.com[:, :2] + m.velocity[:, :2] / pattern.omega, abs=1e-12)


def test_the_zmp_follows_the_plan_and_stays_on_the_soles(walked: Walked) -> None:
    plan, _, m = walked
    assert m.zmp_ref == pytest.approx(zmp_reference(plan, SOLE).at(m.time), abs=5e-3)
    error = m.zmp - m.zmp_ref
    assert np.sqrt((error**2).mean(axis=0)).max() < 4e-3
    for k in range(0, len(m.time), 5):
        phase = plan.support(m.time[k])
        feet = FEET if phase == DOUBLE_SUPPORT else FEET[:1] if phase == LEFT_SUPPORT else FEET[1:]
        polygon = support_polygon([plan.sole(foot, m.time[k]) for foot in feet], SOLE)
        assert support_margin(polygon, m.zmp[k]) > 0.0


def test_the_planned_dcm_is_the_one_walked(walked: Walked) -> None:
    """Two ways to the same bounded motion: backward integration and preview control."""
    plan, _, m = walked
    pattern = pattern_of(plan)
    planned = []
    for t in m.time:
        pattern.at(t)
        planned.append(pattern.planned_dcm(t))
    assert np.abs(planned - m.dcm).max() < 4e-3


def test_ends_at_rest_between_the_feet(walked: Walked) -> None:
    plan, _, m = walked
    x, y, _ = midfeet(plan.sole("left", plan.end), plan.sole("right", plan.end))
    assert m.com[-1] == pytest.approx((x, y, LEGS.com_height), abs=5e-4)
    assert np.abs(m.velocity[-1]).max() < 1e-3


def test_can_be_asked_at_any_rate() -> None:
    plan = slow_walk(3)
    often = motion(pattern_of(plan), times_of(plan, 0.001))
    seldom = motion(pattern_of(plan), times_of(plan, 0.008))
    assert (often.com[::8][: len(seldom.com)] == seldom.com).all()


def test_is_the_same_anywhere_in_any_direction_at_any_time() -> None:
    plan, by = slow_walk(4), pose_at(100.0, -50.0, 2.4, 0.7)
    home = motion(pattern_of(plan), times_of(plan))
    away = motion(pattern_of(plan.transformed(by)), times_of(plan))
    assert away.com == pytest.approx(home.com @ by[:3, :3].T + by[:3, 3], abs=1e-7)
    assert away.zmp == pytest.approx(home.zmp @ by[:2, :2].T + by[:2, 3], abs=1e-6)
    assert away.ground == pytest.approx(home.ground + 0.7)
    later = FootstepPlan(
        [type(s)(s.foot, s.pose, s.lift + 64.0, s.land + 64.0, s.type) for s in plan],
        plan.weight_shift,
    )
    assert motion(pattern_of(later), times_of(later)).com == pytest.approx(home.com, abs=1e-9)


@pytest.mark.parametrize("plan", [slow_walk(), fast_walk()])
def test_an_equal_plan_changes_nothing(plan: FootstepPlan) -> None:
    whole = motion(pattern_of(plan), times_of(plan))
    pattern, com = pattern_of(plan), []
    for k, t in enumerate(times_of(plan)):
        if k % 411 == 100:
            pattern.follow(FootstepPlan(list(plan), plan.weight_shift))
        com.append(pattern.at(t).com)
    assert np.array(com) == pytest.approx(whole.com, abs=1e-9)


def test_another_plan_bends_the_motion_without_a_jump() -> None:
    """A walk of which nothing remains but the step in the air: the CoM slows down and stands."""
    plan = slow_walk(8)
    whole, times = motion(pattern_of(plan), times_of(plan)), times_of(plan)
    change = plan.steps[4].lift + 0.1
    pattern, samples = pattern_of(plan), []
    for t in times:
        if pattern.plan is plan and t >= change:
            pattern.follow(plan.replace_after(t, []))
        samples.append(pattern.at(t))
    com = np.array([s.com for s in samples])
    velocity = np.array([s.velocity for s in samples])
    before = times < change
    assert (com[before] == whole.com[before]).all()
    assert np.abs(np.diff(velocity, axis=0)).max() < 0.01
    x, y, _ = midfeet(*(pattern.plan.sole(foot, times[-1]) for foot in FEET))
    assert com[-1, :2] == pytest.approx((x, y), abs=1e-3)


def test_rejoin_starts_at_the_robot_and_comes_back_to_the_plan() -> None:
    plan = slow_walk()
    whole, times = motion(pattern_of(plan), times_of(plan)), times_of(plan)
    pattern = pattern_of(plan)
    k = int((plan.steps[2].lift + 0.2) / DT)
    motion(pattern, times[:k])
    pushed = whole.com[k, :2] + (0.03, -0.02)
    pattern.rejoin(times[k], pushed)
    now = pattern.at(times[k])
    assert now.com[:2] == pytest.approx(pushed, abs=1e-12)
    assert now.dcm == pytest.approx(pattern.planned_dcm(times[k]), abs=1e-12)
    error = np.abs(motion(pattern, times[k:]).com - whole.com[k:])
    # The stable part of the pendulum, exp(-omega t), is all that is left.
    for seconds in (0.5, 1.0, 1.5):
        bound = 0.04 * np.exp(-pattern.omega * seconds) + 2e-3
        assert error[int(seconds / DT) :].max() < bound


def test_stairs_raise_ground_and_com_alike() -> None:
    places: list[tuple[Foot, float]]
    places = [("left", 0.1), ("right", 0.2), ("left", 0.3), ("right", 0.3)]
    poses: list[tuple[Foot, Array]] = []
    for k, (foot, z) in enumerate(places):
        x, y = 0.28 * min(k + 1, 3), 0.085 if foot == "left" else -0.085
        poses.append((foot, pose_at(x, y, 0.0, z)))
    plan = from_list(poses, FootstepPlanner(0.28, 0.17, 0.9), limits=GaitLimits(backward=0.4))
    m = motion(pattern_of(plan), times_of(plan))
    assert m.ground[0] == 0.0
    assert m.ground[-1] == pytest.approx(0.3)
    assert m.com[-1, 2] == pytest.approx(LEGS.com_height + 0.3, abs=1e-3)
    assert np.abs(m.com[:, 2] - LEGS.com_height - m.ground).max() < 0.15
    assert np.abs(m.acceleration[:, 2]).max() < 0.5 * GRAVITY
