"""Recovery: its decisions by themselves, and pushes in simulation: none, walking, standing."""

from __future__ import annotations

from dataclasses import replace
from math import cos, radians, sin

import numpy as np
import pytest

import preview_walk as pw
from preview_walk.errors import InvalidInput
from preview_walk.footsteps.footstep import Footstep
from preview_walk.geometry.poses import pose_at
from preview_walk.geometry.support import Sole
from preview_walk.robots.robot import Robot
from preview_walk.stabilizer.recovery import RecoveryMemory, early_landing, recover
from preview_walk.stabilizer.situation import Situation
from preview_walk.stabilizer.step_adaptation import LATEST, RELIFT
from preview_walk.stabilizer.step_limits import step_limits
from preview_walk.types import Array, other

OMEGA = 3.3
LIMITS = step_limits(0.8, 0.2, Sole(0.1, 0.06), OMEGA)


def in_swing(error: tuple[float, float], free: bool = True) -> tuple[Situation, Footstep]:
    """Return a walker in mid swing whose DCM is off by `error` (m), and the step in the air."""
    plan = pw.FootstepPlanner(0.2, 0.2, 0.9).generate_footsteps(8)
    step = plan.steps[3]
    t = step.lift + 0.4 * (step.land - step.lift)
    stance = plan.sole(other(step.foot), t)[:2, 3]
    end = step.pos[:2] + 0.4 * (stance - step.pos[:2])

    def planned(time: float) -> Array:
        return stance + (end - stance) * np.exp(OMEGA * (min(time, step.land) - step.land))

    start = plan.start_pose(step)[:3, 3]
    swing = (0.5 * (start + step.pos), (step.pos - start) / (step.land - step.lift))
    dcm = planned(t) + error
    return Situation(t, plan, dcm, np.zeros(2), planned, swing if free else None), step


def test_nothing_is_decided_where_nothing_is_wrong():
    situation, _ = in_swing((0.0, 0.0))
    assert recover(situation, RecoveryMemory(), LIMITS).plan is None


def test_a_decision_says_what_it_remembers_and_changes_nothing():
    situation, step = in_swing((0.0, -0.1))
    memory = RecoveryMemory()
    decision = recover(situation, memory, LIMITS)
    assert decision.plan is not None
    assert decision.plan.steps[3].pos != pytest.approx(step.pos)
    assert decision.memory.nominal is step
    assert decision.memory.changed == situation.t
    assert situation.plan.steps[3] is step
    assert memory.nominal is None
    # Asked again under the changed plan it still knows the step that was commanded.
    again = replace(situation, plan=decision.plan)
    assert recover(again, decision.memory, LIMITS).memory.nominal is step


def test_a_foot_that_has_touched_down_is_not_moved():
    situation, _ = in_swing((0.0, -0.1), free=False)
    assert recover(situation, RecoveryMemory(), LIMITS).plan is None


def on_both_feet(zmp: float, rate: float = 0.0) -> Situation:
    """Return a walker in double support that needs its ZMP `zmp` (m) ahead of midfeet.

    There the pendulum comes to the DCM that the plan has at the next lift; what the plan has now
    is far from both. `rate`: of a push forward, m/s.
    """
    plan = pw.FootstepPlanner(0.2, 0.2, 0.9).generate_footsteps(8)
    land, lift = plan.steps[3].land, plan.steps[4].lift
    t = land + 0.3 * (lift - land)
    middle = np.mean([plan.sole(foot, t)[:2, 3] for foot in ("left", "right")], axis=0)
    needed, goal = (middle + np.array((x, 0.0)) for x in (zmp, 0.05))
    dcm = needed + (goal - needed) * np.exp(-OMEGA * (lift - t))

    def planned(time: float) -> Array:
        return goal if time > t else dcm + np.array((0.3, 0.0))

    return Situation(t, plan, dcm, np.array((rate, 0.0)), planned, None)


def test_on_both_feet_the_plan_stays_while_a_zmp_above_the_soles_saves_it():
    """The soles reach 0.2 m ahead of midfeet, their held part 0.195 m."""
    for zmp in (-0.15, 0.0, 0.15):
        assert recover(on_both_feet(zmp), RecoveryMemory(), LIMITS).plan is None
    for zmp in (-0.4, 0.4):
        decision = recover(on_both_feet(zmp), RecoveryMemory(), LIMITS)
        assert decision.plan is not None
        assert decision.memory.changed == on_both_feet(zmp).t


def test_a_push_that_lasts_is_answered_where_it_leads():
    assert recover(on_both_feet(0.15, 1.0), RecoveryMemory(), LIMITS).plan is not None
    assert recover(on_both_feet(0.15, -1.0), RecoveryMemory(), LIMITS).plan is None


def test_an_early_touchdown_is_a_landing_in_a_recovery_only():
    situation, step = in_swing((0.0, 0.0))
    t, plan, pose = situation.t, situation.plan, pose_at(0.5, 0.12, 0.1)
    recovering = RecoveryMemory(changed=t - 0.2)
    landed = early_landing(plan, t, step.foot, pose, recovering)
    assert landed is not None
    assert landed.steps[3].pose == pytest.approx(pose)
    assert t < landed.steps[3].land < t + 1e-3
    assert early_landing(plan, t, other(step.foot), pose, recovering) is None
    assert early_landing(plan, t, step.foot, pose, RecoveryMemory(changed=t - 2.0)) is None
    assert early_landing(plan, step.land - 0.01, step.foot, pose, recovering) is None


def pushed(robot: Robot, share: float | None, angle: float, impulse: float) -> pw.Walk:
    """Return a walk pushed while the left foot stands (share of single support), or standing."""
    planner = pw.FootstepPlanner(0.2, robot.step_width, 0.9, 0.2 / 0.9)
    plan = planner.generate_footsteps(6 if share is not None else 0)
    t = 0.3
    if share is not None:
        step = next(s for s in plan.steps if s.foot == "right")
        t = step.lift + share * (step.land - step.lift)
    force = impulse / 0.2
    along = (force * cos(radians(angle)), force * sin(radians(angle)), 0.0)
    walk = pw.Walk(robot, plan, pushes=[pw.Push(t, 0.2, along)])
    return walk.run(until=t + 3.5)


def test_without_a_push_the_plan_stays(talos: Robot):
    plan = pw.FootstepPlanner(0.25, talos.step_width).generate_footsteps(3)
    walk = pw.Walk(talos, plan).run(until=plan.end)
    assert not walk.fallen
    assert walk.plan is plan


@pytest.mark.parametrize(
    ("share", "angle", "impulse"),
    [
        (0.5, 0.0, 55.0),
        (0.3, -90.0, 40.0),
        (0.5, 90.0, 33.0),
        (0.9, -90.0, 43.0),
        (0.9, 180.0, 60.0),
    ],
)
def test_a_walk_survives_a_push(talos: Robot, share: float, angle: float, impulse: float):
    walk = pushed(talos, share, angle, impulse)
    assert not walk.fallen
    assert len(walk.record().plans) > 1


def test_a_sideways_push_on_a_stand_is_stepped_out_of(talos: Robot):
    walk = pushed(talos, None, 90.0, 47.0)
    assert not walk.fallen


def test_steps_that_no_plan_may_have_are_no_answer(talos: Robot, monkeypatch: pytest.MonkeyPatch):
    def refused(*_: object) -> None:
        raise InvalidInput("step 7 must be taken by the left foot.")

    monkeypatch.setattr("preview_walk.stabilizer.recovery.adapt_step", refused)
    walk = pushed(talos, 0.5, 0.0, 20.0)
    assert not walk.fallen
    assert len(walk.record().plans) == 1


def test_a_push_is_opposed_as_it_comes(talos: Robot):
    """At once the ZMP goes where the push's moment about it is the weight's, or beyond."""
    walk = pushed(talos, None, 0.0, 10.0)
    record = walk.record()
    before, after = np.searchsorted(record.time, (0.29, 0.33))
    wanted = 50.0 / (talos.mass * walk.walker.pattern.omega**2)
    shift = record.zmp[after, 0] - record.zmp[before, 0]
    assert 0.95 * wanted < shift < talos.soles["left"].half_length
    assert np.abs(record.com - record.com[0])[:, :2].max() < 0.01


@pytest.mark.parametrize("impulse", [12.0, 17.1, 20.0])
def test_a_narrow_soled_robot_pushed_sideways_stands_where_it_is(impulse: float):
    """With the load all on one sole's edge the other sole stays at the ground."""
    walk = pushed(pw.load_robot("g1"), None, 90.0, impulse)
    assert not walk.fallen
    assert walk.plan.steps == ()
    record = walk.record()
    assert record.right_foot[:, 2, 3].max() < 0.002


def test_ankles_answer_a_small_push_on_a_stand(talos: Robot):
    walk = pushed(talos, None, 0.0, 15.0)
    assert not walk.fallen
    assert walk.plan.steps == ()


def test_a_stand_is_left_by_steps_and_stands_again(talos: Robot):
    walk = pushed(talos, None, 0.0, 42.0)
    assert not walk.fallen
    assert len(walk.plan.steps) >= 2
    assert walk.plan.end < walk.time
    assert np.linalg.norm(walk.walker.body.dynamics.com_velocity) < 0.05


def test_a_foot_that_rises_again_is_given_the_time_to():
    """Hurried down again from there, it would hit the ground."""
    g1 = pw.load_robot("g1")
    planner = pw.FootstepPlanner(0.15, g1.step_width, 0.75, 0.2)
    plan = planner.generate_footsteps(8)
    step = [s for s in plan.steps if s.foot == "right"][2]
    t = step.lift + 0.5 * (step.land - step.lift)
    walk = pw.Walk(g1, plan, pushes=[pw.Push(t, 0.2, (-104.5, 0.0, 0.0))]).run(until=t + 2.0)
    assert not walk.fallen
    risen, lift, land, soonest = 0, 0.0, 0.0, 0.0
    for plan in walk.record().plans:
        now = [k for k in range(2, len(plan.foot)) if plan.lift[k] <= plan.time < plan.land[k]]
        if not now:
            continue
        late = plan.lift[now[0]] == lift and land - plan.time < LATEST
        if plan.lift[now[0]] != lift:
            soonest = 0.0
        elif late and plan.land[now[0]] > plan.time + RELIFT - 1e-6:
            risen, soonest = risen + 1, plan.land[now[0]]
        lift, land = plan.lift[now[0]], plan.land[now[0]]
        assert late or land > soonest - 1e-6
    assert risen > 0
