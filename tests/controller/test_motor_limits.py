"""What a swing asks of motors and ground: against walks as they were measured, and in words."""

from __future__ import annotations

import re
from dataclasses import replace

import numpy as np
import pytest

import preview_walk as pw
from preview_walk.controller.body_model import SWING_HEIGHT, walker_model
from preview_walk.controller.motor_limits import MotorLimits, _loads
from preview_walk.controller.robot_limits import command_limits, gait_limits, usual_planner
from preview_walk.errors import InvalidInput
from preview_walk.footsteps.gaits import straight
from preview_walk.footsteps.plan import FootstepPlan
from preview_walk.pattern.check import check_plan
from preview_walk.pattern.com_path import com_path
from preview_walk.robots.robot import Robot
from preview_walk.types import FEET, Array


def plan_of(robot: Robot, length: float, time: float, ramp: int = 2) -> FootstepPlan:
    planner = pw.FootstepPlanner(length, robot.step_width, time)
    return planner.generate_footsteps(8, ramp=ramp)


def over_half_a_swing(signal: Array) -> Array:
    """Return the largest mean (n,) over half of a swing of a signal (N, n)."""
    half = len(signal) // 2
    sums = np.cumsum(np.vstack([np.zeros(signal.shape[1]), signal]), axis=0)
    return np.asarray(np.abs(sums[half:] - sums[: len(sums) - half]).max(axis=0) / half)


@pytest.mark.parametrize(("length", "time"), [(0.25, 0.9), (0.28, 0.46), (0.365, 0.575)])
def test_asks_for_what_is_measured(talos: Robot, length: float, time: float) -> None:
    """Where a walk has all it needs, the torques and speeds of each joint are those foreseen.

    The walk's own record is the witness: nothing in it comes from this inverse dynamics.
    """
    plan = plan_of(talos, length, time)
    record = pw.simulate(talos, plan)
    legs = [talos.pin.joints[j].idx_v - 6 for foot in FEET for j in talos.legs[foot].joints]
    com = com_path(plan, walker_model(talos, SWING_HEIGHT * talos.leg_length))
    for step in plan.steps:
        a, b = np.searchsorted(record.time, (step.lift, step.land))
        loads = _loads(talos, plan, step, com)
        for foreseen, measured, limit in (
            (loads.torque, record.tau[a:b], talos.effort),
            (loads.speed, record.v[a:b, 6:], talos.v_limit),
        ):
            error = over_half_a_swing(foreseen) - over_half_a_swing(measured)
            assert np.abs(error / limit)[legs].max() < 0.03


@pytest.mark.parametrize("ramp", [0, 2])
@pytest.mark.parametrize(("length", "time"), [(0.528, 0.374), (0.601, 0.374), (0.601, 0.46)])
def test_gaits_that_fall_are_refused(talos: Robot, length: float, time: float, ramp: int) -> None:
    plan = plan_of(talos, length, time, ramp)
    assert check_plan(plan, replace(gait_limits(talos), motors=None)) == ()
    finding = check_plan(plan, gait_limits(talos))[0]
    said = r"step \d needs (\d+ N·m|[\d.]+ rad/s) of 'leg_\w+' over half its swing, it has"
    ground = r"step \d needs the ZMP [\d.]+ m outside the (left|right) sole over half its swing"
    assert re.match(f"{said}|{ground}", finding.text)
    assert finding.argument == "step_length"
    with pytest.raises(
        InvalidInput, match=r"^the plan cannot be walked: at [\d.]+ s step \d needs"
    ):
        pw.simulate(talos, plan)


@pytest.mark.parametrize(("length", "time"), [(0.25, 0.9), (0.6, 0.72), (0.447, 0.46), (0.2, 0.31)])
def test_gaits_that_walk_are_not(talos: Robot, length: float, time: float) -> None:
    assert check_plan(plan_of(talos, length, time), gait_limits(talos)) == ()


def test_weaker_motors_and_slower_joints_are_named(talos: Robot) -> None:
    """Half of one joint's torque, or speed, and it is that joint, with what it has."""
    plan = plan_of(talos, 0.4, 0.5)
    knee = talos.joint_names.index("leg_left_4_joint")
    weak, slow = talos.effort.copy(), talos.v_limit.copy()
    weak[knee], slow[knee] = 40.0, 1.0
    (text, *_) = (f.text for f in check_plan(plan, gait_limits(replace(talos, effort=weak))))
    assert re.search(
        r"needs \d+ N·m of 'leg_left_4_joint' over half its swing, it has 40 N·m", text
    )
    (text, *_) = (f.text for f in check_plan(plan, gait_limits(replace(talos, v_limit=slow))))
    assert re.search(r"of 'leg_left_4_joint' over half its swing, it has 1\.0 rad/s", text)


def test_the_same_step_needs_the_same_wherever_it_is(talos: Robot) -> None:
    """Far away, facing elsewhere; and a long walk's middle steps are looked at once."""
    planner = pw.FootstepPlanner(0.4, talos.step_width, 0.5)
    here, there = (
        [n.share for _, n in MotorLimits(talos).needs(planner.generate_footsteps(9, start, ramp=2))]
        for start in ((0.0, 0.0, 0.0), (40.0, -7.0, 2.0))
    )
    assert here == pytest.approx(there, rel=1e-3)
    needs = [n for _, n in MotorLimits(talos).needs(planner.generate_footsteps(40, ramp=2))]
    assert len({id(need) for need in needs}) < 20


def test_the_planner_finds_shorter_steps_for_weak_motors(talos: Robot) -> None:
    planner = pw.FootstepPlanner(0.6, talos.step_width, 0.46)
    plan = straight(3.0, planner, limits=gait_limits(talos))
    assert check_plan(plan, gait_limits(talos)) == ()
    bold = straight(3.0, planner, limits=replace(gait_limits(talos), motors=None))
    assert len(plan.steps) > len(bold.steps)


def test_weak_motors_bound_velocity_commands(talos: Robot) -> None:
    """A quarter of the hips' torque: shorter steps; all of it is enough for the legs' reach."""
    free = command_limits(talos)
    assert free.forward == gait_limits(talos).forward
    hips = [talos.pin.joints[leg.hip].idx_v - 6 for leg in talos.legs.values()]
    weak = talos.effort.copy()
    weak[hips] *= 0.25
    bound = command_limits(replace(talos, effort=weak))
    assert 0.5 * free.forward < bound.forward < 0.8 * free.forward


def test_usual_steps_are_taloss_own_and_shorter_for_shorter_legs(talos: Robot) -> None:
    planner = usual_planner(talos)
    assert (planner.step_length, planner.step_time) == (0.25, 0.9)
    small = usual_planner(replace(talos, leg_length=0.2))
    assert (small.step_length, small.step_time) == (0.062, 0.45)
