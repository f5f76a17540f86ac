"""Every robot of the catalogue walks with the same controller; TALOS does in `test_walk`."""

from __future__ import annotations

import numpy as np
import pytest

import preview_walk as pw
from preview_walk.controller.robot_limits import command_limits
from preview_walk.footsteps.gaits import turn_in_place
from preview_walk.record.summary import Summary
from preview_walk.robots.problems import one_leg_torques
from preview_walk.robots.robot import Robot


def planner_for(robot: Robot) -> pw.FootstepPlanner:
    """Return steps of a quarter of the leg's length in the rhythm of its pendulum."""
    time = 3.13 * np.sqrt(robot.leg_length / 9.81)
    return pw.FootstepPlanner(0.25 * robot.leg_length, robot.step_width, time)


def assert_walked(summary: Summary, com_error: float) -> None:
    assert not summary.fell, summary.fall_reason
    assert max(error or 0.0 for error in summary.com_error_rms) <= com_error
    assert (summary.torque_ratio_max or np.inf) <= 1.0
    assert (summary.final_position_error or np.inf) <= 0.05
    assert (summary.final_yaw_error or np.inf) <= 0.05
    assert summary.qp_failures == 0


@pytest.mark.parametrize(
    "name", ["alexander", "g1", "g1_hands", "human", "humanoid-walker", "icub"]
)
def test_four_steps(name: str) -> None:
    robot = pw.load_robot(name)
    summary = pw.simulate(robot, planner_for(robot).generate_footsteps(4)).summary()
    assert_walked(summary, 0.003)
    assert summary.steps == 4


@pytest.mark.parametrize("name", ["romeo", "simple_humanoid"])
def test_twelve_steps_of_robots_at_their_limits(name: str) -> None:
    """Both are short of torque in the hips: the walk takes all there is, and never more."""
    robot = pw.load_robot(name)
    assert np.abs(one_leg_torques(robot) / robot.effort).max() > 0.9
    summary = pw.simulate(robot, planner_for(robot).generate_footsteps(12)).summary()
    assert_walked(summary, 0.010)
    assert summary.steps == 12


@pytest.mark.parametrize(("name", "angle"), [("icub", 0.5 * np.pi), ("romeo", 0.15 * np.pi)])
def test_a_turn_in_place(name: str, angle: float) -> None:
    """One base faces backward; the other robot's hips turn at 0.3 rad/s at most."""
    robot = pw.load_robot(name)
    turn = turn_in_place(angle, planner_for(robot), limits=command_limits(robot))
    record = pw.simulate(robot, turn)
    assert_walked(record.summary(), 0.010)
    heading = record.left_foot[-1][:2, 0]
    assert heading == pytest.approx((np.cos(angle), np.sin(angle)), abs=0.02)


def test_a_velocity_beyond_the_joints_speed_is_cut_to_what_they_can() -> None:
    """Romeo's hips pitch at 2.1 rad/s; asked for more than a robot of its size could walk."""
    walk = pw.Walk.standing(pw.load_robot("romeo"))
    walk.schedule([((2.0, 0.0, 0.0), 5.0)])
    summary = walk.run().record().summary()
    assert not summary.fell, summary.fall_reason
    assert summary.speed == pytest.approx(0.33, abs=0.03)
