"""Where the robot stands at the start: on the plan's soles, balanced, upright."""

from __future__ import annotations

import re
from dataclasses import replace

import numpy as np
import pinocchio as pin
import pytest

import preview_walk as pw
from preview_walk.controller.robot_limits import command_limits, gait_limits
from preview_walk.errors import InvalidInput
from preview_walk.footsteps.plan import FootstepPlan
from preview_walk.geometry.poses import midfeet, pose_at
from preview_walk.robots.robot import Robot
from preview_walk.robots.standing import at_com_height, standing_configuration
from preview_walk.types import FEET, Array


def stance(
    left: tuple[float, float, float] = (0.0, 0.085, 0.0),
    right: tuple[float, float, float] = (0.0, -0.085, 0.0),
    z: float = 0.0,
) -> FootstepPlan:
    return FootstepPlan.standing(pose_at(*left, z), pose_at(*right, z))


PLANS = {
    "as in the posture": stance(),
    "wider": stance((0.0, 0.14, 0.0), (0.0, -0.14, 0.0)),
    "one foot ahead": stance((0.12, 0.085, 0.0), (-0.1, -0.09, 0.0)),
    "toes out, on a table": stance((0.0, 0.1, 0.3), (0.0, -0.1, -0.2), 0.75),
    "far away, facing back": stance((99.9, -50.0, 2.9), (100.1, -50.05, 2.9)),
}


def placed(robot: Robot, plan: FootstepPlan) -> tuple[pin.Data, Array]:
    q = standing_configuration(robot, plan[0].pose, plan[1].pose)
    data = robot.pin.createData()
    pin.framesForwardKinematics(robot.pin, data, q)
    pin.centerOfMass(robot.pin, data, q)
    return data, q


@pytest.mark.parametrize("plan", PLANS.values(), ids=list(PLANS))
def test_stands_on_the_soles_balanced_and_upright(talos: Robot, plan: FootstepPlan) -> None:
    data, q = placed(talos, plan)
    for step in plan[:2]:
        sole = data.oMf[talos.soles[step.foot].frame].homogeneous
        assert sole == pytest.approx(step.pose, abs=1e-8)
    x, y, yaw = midfeet(plan[0].pose, plan[1].pose)
    com = data.com[0]
    assert com[:2] == pytest.approx((x, y), abs=0.005)
    assert com[2] == pytest.approx(plan[0].pos[2] + talos.com_height, abs=0.01)
    torso = data.oMf[talos.torso].rotation
    assert torso[2, 2] > np.cos(np.radians(2.0))
    facing = np.arctan2(torso[1, 0], torso[0, 0])
    assert np.cos(facing - yaw) > np.cos(np.radians(2.0))
    assert (q[7:] >= talos.q_lower - 1e-9).all()
    assert (q[7:] <= talos.q_upper + 1e-9).all()


def test_is_the_walking_posture_where_the_soles_fit(talos: Robot) -> None:
    half = 0.5 * talos.step_width
    q = standing_configuration(
        talos, *(s.pose for s in stance((0.0, half, 0.0), (0.0, -half, 0.0)))
    )
    assert q == pytest.approx(talos.posture, abs=1e-9)


@pytest.mark.parametrize("plan", [PLANS["wider"], PLANS["one foot ahead"]])
def test_a_placed_robot_keeps_standing(talos: Robot, plan: FootstepPlan) -> None:
    record = pw.Walk(talos, plan).run(until=0.5).record()
    assert not record.run.fell
    assert np.abs(record.com[-1] - record.com[0]).max() < 0.01
    for foot in FEET:
        slip = np.ptp(getattr(record, f"{foot}_foot")[:, :2, 3], axis=0)
        assert slip.max() < 2e-3


def test_soles_out_of_reach_are_refused(talos: Robot) -> None:
    sentence = (
        "step_width: talos cannot stand on soles 1.600 m apart at its walking height; "
        f"it stands on soles {talos.step_width:.3f} m apart."
    )
    with pytest.raises(InvalidInput, match=f"^{re.escape(sentence)}$"):
        standing_configuration(talos, *(s.pose for s in stance((0.0, 0.8, 0.0), (0.0, -0.8, 0.0))))


def test_the_limits_are_those_of_the_robots_legs_and_soles(talos: Robot) -> None:
    limits = gait_limits(talos)
    assert limits.step_width == talos.step_width
    assert limits.sole.half_length == talos.soles["left"].half_length
    assert limits.sole.half_width == talos.soles["right"].half_width
    assert 0.5 * talos.leg_length < limits.forward < talos.leg_length
    assert limits == pw.Walk.standing(talos).limits


def test_fast_hips_do_not_bound_velocity_commands(talos: Robot) -> None:
    assert command_limits(talos) == gait_limits(talos)


def test_slow_hips_do(talos: Robot) -> None:
    """Half the speed of the joints, half the turn and the way of a step; sidesteps stay."""
    hips = np.zeros(len(talos.v_limit), bool)
    for leg in talos.legs.values():
        hips[[talos.pin.joints[joint].idx_v - 6 for joint in leg.joints[:3]]] = True
    once, twice = (
        command_limits(replace(talos, v_limit=np.where(hips, speed, talos.v_limit)))
        for speed in (0.4, 0.8)
    )
    assert twice.forward == pytest.approx(2.0 * once.forward)
    assert once.backward == pytest.approx(once.forward)
    assert twice.turn_out + twice.turn_in == pytest.approx(2.0 * (once.turn_out + once.turn_in))
    assert once.max_width == gait_limits(talos).max_width


def test_yaw_joints_bound_turns_and_pitch_joints_lengths(talos: Robot) -> None:
    """TALOS's legs begin with a yaw, a roll and a pitch joint."""
    free = command_limits(talos)

    def slowed(number: int) -> pw.GaitLimits:
        slow = np.array([f"_{number}_joint" in n and "leg" in n for n in talos.joint_names])
        assert slow.sum() == 2
        return command_limits(replace(talos, v_limit=np.where(slow, 0.4, talos.v_limit)))

    yaw, pitch = slowed(1), slowed(3)
    assert yaw.turn_out < 0.9 * free.turn_out
    assert (yaw.forward, yaw.backward) == (free.forward, free.backward)
    assert pitch.forward < 0.9 * free.forward
    assert (pitch.turn_out, pitch.turn_in) == (free.turn_out, free.turn_in)


@pytest.mark.parametrize("change", [-0.05, 0.02])
def test_a_com_height_of_ones_own(talos: Robot, change: float) -> None:
    robot = at_com_height(talos, talos.com_height + change)
    data, q = placed(robot, stance())
    assert data.com[0] == pytest.approx((0.0, 0.0, talos.com_height + change), abs=1e-8)
    assert q[3:7] == pytest.approx(talos.posture[3:7], abs=1e-9)
    assert robot.com_height == pytest.approx(talos.com_height + change)


@pytest.mark.parametrize("height", [0.5, 1.2, np.nan])
def test_a_com_height_that_the_legs_cannot_give(talos: Robot, height: float) -> None:
    sentence = f"com_height must be between 0.738 and 0.916 m for the legs of talos, got {height}."
    with pytest.raises(InvalidInput, match=f"^{re.escape(sentence)}$"):
        at_com_height(talos, height)
