"""Plans for a pushed walker: what moves, what stays, and which foot steps."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from preview_walk.footsteps.limits import GaitLimits
from preview_walk.footsteps.plan import FootstepPlan
from preview_walk.footsteps.planner import FootstepPlanner
from preview_walk.geometry.poses import pose_at
from preview_walk.geometry.support import Sole
from preview_walk.stabilizer.recovery_steps import (
    SHORT_PAUSE,
    UNLOAD,
    keep_standing,
    land_at,
    step_out,
    step_sooner,
)
from preview_walk.stabilizer.step_limits import StepLimits

SOLE = Sole(0.1, 0.06)
GAIT = GaitLimits(sole=SOLE, step_width=0.2, min_width=0.14, max_width=0.55)
OMEGA, SWING_TIME = 3.3, 0.35
LIMITS = StepLimits(
    gait=GAIT,
    omega=OMEGA,
    zmp=(SOLE.half_length, SOLE.half_width),
    swing_time=(0.33, 1.0),
    swing_speed=3.7,
    swing_acceleration=25.0,
    tolerance=0.026,
    step_out_time=SWING_TIME,
)


def walk() -> FootstepPlan:
    return FootstepPlanner(0.2, 0.2, 0.9, 0.2 / 0.9).generate_footsteps(6)


def stand() -> FootstepPlan:
    return FootstepPlan.standing(pose_at(0.0, 0.1, 0.0), pose_at(0.0, -0.1, 0.0))


def out(plan: FootstepPlan, t: float, dcm: tuple[float, float]) -> FootstepPlan | None:
    return step_out(plan, t, np.array(dcm), LIMITS)


def test_a_step_that_lands_elsewhere_takes_the_later_ones_along():
    plan = walk()
    step = plan.steps[1]
    t = 0.5 * (step.lift + step.land)
    pose = pose_at(step.pos[0] + 0.1, step.pos[1] - 0.05, 0.0)
    new = land_at(plan, t, pose, step.land - 0.1)
    assert new.steps[0] is plan.steps[0]
    assert new.steps[1].land == step.land - 0.1
    for before, after in zip(plan.steps[1:], new.steps[1:], strict=True):
        assert np.allclose(after.pos - before.pos, (0.1, -0.05, 0.0), atol=1e-12)
    assert new.steps[2].lift - new.steps[1].land == pytest.approx(SHORT_PAUSE)
    for before, after in zip(plan.steps[2:], new.steps[2:], strict=True):
        assert after.land - after.lift == pytest.approx(before.land - before.lift)


def test_a_lift_is_hastened_only_in_a_walk_and_only_once():
    plan = walk()
    t = plan.steps[0].land + 0.01
    sooner = step_sooner(plan, t)
    assert sooner is not None
    assert sooner.steps[1].lift == pytest.approx(max(t + UNLOAD, plan.steps[0].land + SHORT_PAUSE))
    assert step_sooner(sooner, t) is None
    assert step_sooner(stand(), 1.0) is None
    assert step_sooner(plan, plan.end) is None


def test_a_foot_waits_while_the_dcm_is_beyond_the_other_one():
    plan = walk()
    following = plan.steps[1]
    stance = plan.steps[0]
    side = 1.0 if stance.foot == "left" else -1.0
    t = following.lift - UNLOAD - 0.01
    aside = np.array((0.0, side * 0.02))
    beyond = stance.pos[:2] + aside
    within = stance.pos[:2] - aside
    later = keep_standing(plan, t, beyond)
    assert later is not None
    assert later.steps[1].lift == pytest.approx(t + 2.0 * UNLOAD)
    assert keep_standing(plan, following.lift - 0.15, beyond) is not None
    assert keep_standing(plan, t, within) is None
    assert keep_standing(stand(), t, beyond) is None


@pytest.mark.parametrize("dcm", [(0.0, 0.0), (0.09, 0.0), (-0.09, 0.15), (0.0, -0.15)])
def test_ankles_come_first(dcm: tuple[float, float]):
    assert out(stand(), 1.0, dcm) is None


@pytest.mark.parametrize("dcm", [(0.15, 0.0), (-0.15, 0.0), (0.0, 0.2), (0.0, -0.2), (0.1, 0.19)])
def test_a_stand_is_left_by_two_allowed_steps_that_end_in_a_stand(dcm: tuple[float, float]):
    plan = stand()
    new = out(plan, 1.0, dcm)
    assert new is not None
    first, second = new.steps
    assert first.foot != second.foot
    assert first.lift == pytest.approx(1.0 + UNLOAD)
    stance = plan.sole(second.foot, 1.0)
    assert GAIT.problem(first.foot, stance, first.pose) is None
    assert np.linalg.norm(first.pos - second.pos) == pytest.approx(GAIT.step_width)
    ends = {step.foot: step.pos[1] for step in new.steps}
    assert ends["left"] > ends["right"]  # beside the other foot on its own side: legs do not cross
    # Once decided it is not decided again before the lift.
    assert out(new, 1.005, dcm) is None


def test_the_answer_turns_with_the_walk_and_mirrors():
    angle, shift = 0.7, np.array((1.0, -2.0))
    turn = np.array(((np.cos(angle), -np.sin(angle)), (np.sin(angle), np.cos(angle))))
    poses = [pose_at(*(turn @ (0.0, y) + shift), angle) for y in (0.1, -0.1)]
    turned = out(FootstepPlan.standing(poses[0], poses[1]), 1.0, tuple(turn @ (0.13, 0.18) + shift))
    plain = out(stand(), 1.0, (0.13, 0.18))
    mirrored = out(stand(), 1.0, (0.13, -0.18))
    assert turned is not None
    assert plain is not None
    assert mirrored is not None
    for a, b, c in zip(plain.steps, turned.steps, mirrored.steps, strict=True):
        assert a.foot == b.foot != c.foot
        assert np.allclose(turn @ a.pos[:2] + shift, b.pos[:2], atol=1e-9)
        assert np.allclose(a.pos[:2] * (1.0, -1.0), c.pos[:2], atol=1e-9)


def test_a_foot_that_just_landed_steps_again_where_the_other_would_have_to_cross():
    plan = walk()
    stance, following = plan.steps[0], plan.steps[1]
    side = 1.0 if stance.foot == "left" else -1.0
    t = stance.land + 0.001
    dcm = stance.pos[:2] + np.array((-0.05, side * 0.07))
    new = step_out(plan, t, dcm, replace(LIMITS, step_out_time=0.25))
    assert new is not None
    again = new.steps[1]
    assert again.foot == stance.foot
    assert again.again
    assert new.steps[2].foot == following.foot
    move = again.pos - stance.pos
    assert side * move[1] > 0.0
    assert np.allclose(new.steps[2].pos - following.pos, move, atol=1e-9)


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_a_dcm_that_ends_between_the_feet_is_caught_by_the_foot_that_is_next(side: float):
    """Backwards, over the sole that just landed: both hold it, that foot need not step again."""
    plan = walk()
    step, following = next(
        (a, b) for a, b in pairwise(plan.steps) if (a.foot == "left") == (side > 0.0)
    )
    t = step.land + 0.02
    x, y = step.pos[:2].tolist()
    dcm = np.array((x - 1.1 * SOLE.half_length, y + 0.9 * side * SOLE.half_width))
    wide = replace(GAIT, max_width=0.7)  # the foot that landed could well catch it too
    new = step_out(plan, t, dcm, replace(LIMITS, gait=wide))
    assert new is not None
    ahead = [s for s in new.steps if s.lift > t]
    assert ahead[0].foot == following.foot
    assert ahead[0].lift < following.lift
