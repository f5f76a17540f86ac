"""Step adaptation: silent without need, within limits, the same in every frame."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from preview_walk.footsteps.footstep import Footstep
from preview_walk.footsteps.limits import GaitLimits
from preview_walk.footsteps.plan import FootstepPlan
from preview_walk.footsteps.planner import FootstepPlanner
from preview_walk.geometry.poses import pose_at, yaw_of
from preview_walk.geometry.support import Sole
from preview_walk.stabilizer.recovery_steps import SHORT_PAUSE
from preview_walk.stabilizer.situation import Situation
from preview_walk.stabilizer.step_adaptation import (
    DROP,
    LATEST,
    RELIFT,
    SOON,
    _carried,
    adapt_step,
)
from preview_walk.stabilizer.step_limits import StepLimits
from preview_walk.types import Array, other

OMEGA = 3.3
GAIT = GaitLimits(
    sole=Sole(0.1, 0.06), step_width=0.2, forward=0.6, backward=0.4, min_width=0.14, max_width=0.55
)
LIMITS = StepLimits(
    gait=GAIT,
    omega=OMEGA,
    zmp=(0.095, 0.057),
    swing_time=(0.33, 1.0),
    swing_speed=3.7,
    swing_acceleration=25.0,
    tolerance=0.026,
    step_out_time=0.36,
)


def walk(
    start: tuple[float, float, float] = (0.0, 0.0, 0.0),
) -> tuple[FootstepPlan, Footstep, float]:
    """Return a plan, a step of it, and a time in the middle of that step."""
    plan = FootstepPlanner(0.2, 0.2, 0.9, 0.2 / 0.9).generate_footsteps(8, start)
    step = plan.steps[3]
    return plan, step, step.lift + 0.4 * (step.land - step.lift)


def planned(plan: FootstepPlan, step: Footstep, t: float) -> tuple[Array, Array]:
    """Return a DCM now and after the landing that the sole centres could give."""
    stance = plan.sole(other(step.foot), t)[:2, 3]
    end = step.pos[:2] + 0.4 * (stance - step.pos[:2])
    now = stance + (end - stance) * np.exp(-OMEGA * (step.land + 0.1 - t))
    return now, end


def adapted(
    plan: FootstepPlan,
    t: float,
    dcm: Array,
    planned: tuple[Array, Array],
    swing: tuple[Array, Array],
    nominal: Footstep,
    limits: StepLimits = LIMITS,
) -> FootstepPlan | None:
    """Return the answer to a DCM where the plan has `planned` now and after the landing."""
    situation = Situation(
        t, plan, dcm, np.zeros(2), lambda time: planned[0] if time == t else planned[1], swing
    )
    return adapt_step(situation, nominal, limits)


def answer(
    error: Array, start: tuple[float, float, float] = (0.0, 0.0, 0.0), limits: StepLimits = LIMITS
) -> tuple[FootstepPlan, Footstep, FootstepPlan | None]:
    plan, step, t = walk(start)
    dcm = planned(plan, step, t)
    here = 0.5 * (plan.start_pose(step)[:3, 3] + step.pos)
    speed = (step.pos - plan.start_pose(step)[:3, 3]) / (step.land - step.lift)
    return plan, step, adapted(plan, t, dcm[0] + error, dcm, (here, speed), step, limits)


@pytest.mark.parametrize("error", [(0.0, 0.0), (0.02, 0.0), (-0.02, 0.01), (0.0, 0.02)])
def test_a_small_error_is_left_to_the_sole(error: tuple[float, float]):
    assert answer(np.array(error))[2] is None


def test_a_standing_or_a_landing_foot_is_left_alone():
    plan, step, _ = walk()
    far, here = np.array((1.0, 1.0)), (step.pos, np.zeros(3))
    for t in (step.land + 0.05, step.land - 0.5 * SOON):
        dcm = planned(plan, step, t)
        assert adapted(plan, t, dcm[0] + far, dcm, here, step, LIMITS) is None


def test_a_foot_about_to_land_ahead_rises_again_for_a_push_back():
    plan, step, _ = walk()
    t = step.land - 0.5 * LATEST
    dcm, here = planned(plan, step, t), (step.pos, np.zeros(3))
    assert adapted(plan, t, dcm[0] + (-0.01, 0.0), dcm, here, step, LIMITS) is None
    new = adapted(plan, t, dcm[0] + (-0.2, 0.0), dcm, here, step, LIMITS)
    assert new is not None
    changed = new.steps[3]
    assert changed.land >= t + RELIFT - 1e-9
    assert (changed.pos - step.pos)[0] < -0.1


def test_a_foot_about_to_land_is_put_down_at_once_where_it_is_for_other_pushes():
    plan, step, _ = walk()
    t = step.land - 0.5 * LATEST
    dcm, here = planned(plan, step, t), (step.pos, np.zeros(3))
    new = adapted(plan, t, dcm[0] + (0.12, 0.0), dcm, here, step, LIMITS)
    assert new is not None
    changed = new.steps[3]
    assert changed.land == pytest.approx(t + SOON)
    assert np.linalg.norm(changed.pos - step.pos) < 1e-3
    assert new.steps[4:] == plan.steps[4:]


@pytest.mark.parametrize("height", [0.0, 0.03, 0.06])
def test_a_foot_is_not_set_down_faster_than_it_can_fall(height: float):
    plan, step, t = walk()
    t = step.lift + LIMITS.swing_time[0]
    dcm = planned(plan, step, t)
    here = 0.5 * (plan.start_pose(step)[:3, 3] + step.pos) + (0.0, 0.0, height)
    side = -1.0 if step.foot == "left" else 1.0
    error = np.array((0.0, 0.09 * side))
    new = adapted(plan, t, dcm[0] + error, dcm, (here, np.zeros(3)), step, LIMITS)
    assert new is not None
    drop = np.sqrt(height / (np.sqrt(3.0) / 10.0 * DROP))
    assert new.steps[3].land - t >= max(LATEST, 0.99 * drop)


@pytest.mark.parametrize("angle", np.arange(0.0, 360.0, 30.0))
@pytest.mark.parametrize("size", [0.08, 0.15, 0.4])
def test_steps_stay_within_limits(angle: float, size: float):
    error = size * np.array((np.cos(np.radians(angle)), np.sin(np.radians(angle))))
    plan, step, new = answer(error)
    if new is None:
        return
    changed = new.steps[3]
    stance = plan.sole(other(step.foot), step.lift)
    assert GAIT.problem(step.foot, stance, changed.pose) is None
    low, high = LIMITS.swing_time
    assert low - 1e-9 <= changed.land - changed.lift <= high + 1e-9
    assert new.steps[:3] == plan.steps[:3]
    for before, after in zip(plan.steps[4:], new.steps[4:], strict=True):
        assert np.allclose(after.pos - before.pos, changed.pos - step.pos, atol=1e-9)


def test_a_foot_goes_where_the_push_goes():
    for axis, sign in ((0, 1.0), (0, -1.0), (1, 1.0), (1, -1.0)):
        error = np.zeros(2)
        error[axis] = sign * 0.15
        _, step, new = answer(error)
        assert new is not None
        moved = (new.steps[3].pos - step.pos)[axis] * sign
        # Legs do not cross: inward of the sole's side there is little room.
        assert moved > 0.0 or (axis == 1 and moved > -0.03)


@pytest.mark.parametrize("start", [(1.0, -2.0, 0.8), (-3.0, 0.5, 3.0)])
def test_the_answer_moves_with_the_frame(start: tuple[float, float, float]):
    c, s = np.cos(start[2]), np.sin(start[2])
    turn = np.array(((c, -s), (s, c)))
    error = np.array((0.1, 0.05))
    _, _, plain = answer(error)
    _, _, moved = answer(turn @ error, start)
    assert plain is not None
    assert moved is not None
    for a, b in zip(plain.steps, moved.steps, strict=True):
        assert b.land == pytest.approx(a.land, abs=1e-9)
        assert np.allclose(turn @ a.pos[:2] + start[:2], b.pos[:2], atol=1e-7)
        turned = yaw_of(b.pose) - yaw_of(a.pose) - start[2]
        assert np.cos(turned) == pytest.approx(1.0)


def test_left_and_right_are_mirror_images():
    plan, step, t = walk()
    flip = np.array((1.0, -1.0, 1.0))

    def mirrored(s: Footstep) -> Footstep:
        return replace(s, foot=other(s.foot), pose=pose_at(*(s.pos * flip)[:2].tolist(), 0.0))

    twin = FootstepPlan([mirrored(s) for s in plan], plan.weight_shift)
    dcm = planned(plan, step, t)
    error, here, speed = np.array((0.05, 0.09)), step.pos, np.array((0.4, 0.0, 0.0))
    new = adapted(plan, t, dcm[0] + error, dcm, (here, speed), step, LIMITS)
    back = tuple(d * flip[:2] for d in dcm)
    other_new = adapted(
        twin,
        t,
        back[0] + error * flip[:2],
        (back[0], back[1]),
        (here * flip, speed),
        twin.steps[3],
        LIMITS,
    )
    assert new is not None
    assert other_new is not None
    assert np.allclose(new.steps[3].pos * flip, other_new.steps[3].pos, atol=1e-9)
    assert new.steps[3].land == pytest.approx(other_new.steps[3].land)


@pytest.mark.parametrize("sideways", [0.06, -0.06])
def test_the_dcm_lands_where_the_plan_has_it_from_its_foot(sideways: float):
    """A pendulum simulated to the new landing, its ZMP at the stance sole's centre.

    Fore and aft, where nothing pushed, its DCM is as far from the new foothold as the plan's is
    from the old one at that time; as far as the plan's is now would be 75 mm elsewhere.
    """
    plan, step, t = walk()
    dcm = planned(plan, step, t)
    pushed = dcm[0] + (0.0, sideways)
    _, _, new = answer(np.array((0.0, sideways)))
    assert new is not None
    changed, stance = new.steps[3], plan.sole(other(step.foot), t)[:2, 3]
    time = changed.land + 0.5 * SHORT_PAUSE - t
    landed = stance + (pushed - stance) * np.exp(OMEGA * time)
    offset, wanted = landed - changed.pos[:2], dcm[1] - step.pos[:2]
    # The ZMP, which is moved by 10 mm at the optimum, and the next step take up 17 and 32 mm.
    assert abs(offset[0] - wanted[0]) < 0.035


def test_the_next_step_catches_what_falls_to_the_side_where_it_lands():
    """Past a left foot's inner edge the right foot can step; past its outer edge it cannot."""
    none = np.zeros(2)
    low, high = _carried(LIMITS, "left", none)
    right_low, right_high = _carried(LIMITS, "right", none)
    assert -low[1] > 2.0 * high[1] > 0.0
    assert (right_low[1], right_high[1]) == pytest.approx((-high[1], -low[1]))
    assert (right_low[0], right_high[0]) == pytest.approx((low[0], high[0]))
    assert high[0] > -low[0] > 0.0  # further ahead than back
