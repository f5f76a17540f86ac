"""The walker: what a tick hands to the tasks."""

from __future__ import annotations

import numpy as np
import pinocchio as pin
import pytest

import preview_walk as pw
from preview_walk.controller.balance import free_swing
from preview_walk.controller.walker import SWING_HEIGHT, Walker
from preview_walk.footsteps.plan import FootstepPlan
from preview_walk.geometry.poses import pose_at, yaw_of
from preview_walk.robots.robot import Robot
from preview_walk.robots.standing import standing_configuration
from preview_walk.types import Foot


def standing(robot: Robot, left_yaw: float, right_yaw: float) -> tuple[Walker, np.ndarray]:
    """Return a walker on two turned soles, and its configuration."""
    half = 0.5 * robot.step_width + 0.02
    plan = FootstepPlan.standing(pose_at(0.0, half, left_yaw), pose_at(0.0, -half, right_yaw))
    q = standing_configuration(robot, plan[0].pose, plan[1].pose)
    return Walker(robot, plan, q, friction=0.8), q


def loads(left: float, right: float) -> dict[Foot, np.ndarray]:
    """Return the wrenches of two normal forces (N) at the soles' centres."""
    return {"left": np.eye(6)[2] * left, "right": np.eye(6)[2] * right}


@pytest.mark.parametrize(("left", "right"), [(0.3, -0.1), (-0.05, -0.25), (3.2, 3.0)])
def test_the_torso_faces_between_the_feet(talos: Robot, left: float, right: float) -> None:
    walker, q = standing(talos, left, right)
    walker.tick(0.0, q, np.zeros(talos.pin.nv), loads(0.5 * walker.weight, 0.5 * walker.weight))
    facing = yaw_of(walker.body.torso.rotation)
    assert np.cos(facing - 0.5 * (left + right)) == pytest.approx(1.0, abs=1e-12)
    assert walker.body.torso.rotation[:, 2] == pytest.approx((0.0, 0.0, 1.0))


def test_the_torso_turns_with_half_the_speed_of_a_turning_swing(talos: Robot) -> None:
    planner = pw.FootstepPlanner(0.0, talos.step_width + 0.04, 0.9)
    plan = planner.generate_footsteps(4, turn=0.2)
    q = standing_configuration(talos, plan[0].pose, plan[1].pose)
    walker = Walker(talos, plan, q, friction=0.8)
    step = plan.steps[0]
    t = 0.5 * (step.lift + step.land)
    walker.tick(t, q, np.zeros(talos.pin.nv), loads(0.0, walker.weight))
    turning = walker.feet.targets[step.foot].velocity[5]
    assert turning > 0.1
    assert walker.body.torso.velocity == pytest.approx((0.0, 0.0, 0.5 * turning))


def test_a_swinging_soles_motion_is_told_in_the_world(talos: Robot) -> None:
    """Turned by 1.2 rad, with the whole robot moving ahead at 0.3 m/s."""
    planner = pw.FootstepPlanner(0.2, talos.step_width, 0.9)
    plan = planner.generate_footsteps(4, (0.0, 0.0, 1.2))
    q = standing_configuration(talos, plan[0].pose, plan[1].pose)
    walker = Walker(talos, plan, q, friction=0.8)
    step = plan.steps[0]
    t, v = 0.5 * (step.lift + step.land), np.zeros(talos.pin.nv)
    v[0] = 0.3
    walker.tick(t, q, v, loads(0.0, walker.weight))
    told = free_swing(t, walker.plan, walker.feet, walker.body.dynamics)
    assert told is not None
    assert told[0] == pytest.approx(plan.start_pose(step)[:3, 3], abs=1e-6)
    base = pin.Quaternion(q[3:7]).toRotationMatrix()
    assert told[1] == pytest.approx(base @ (0.3, 0.0, 0.0))


def test_after_another_plan_the_reference_goes_on_from_the_measured_com(talos: Robot) -> None:
    """A stand is left by steps: the error that remains is the DCM's alone."""
    walker, q = standing(talos, 0.0, 0.0)
    walker.tick(0.0, q, np.zeros(talos.pin.nv), loads(0.5 * walker.weight, 0.5 * walker.weight))
    moved, v = q.copy(), np.zeros(talos.pin.nv)
    moved[0] += 0.03
    v[0] = 1.0
    walker.tick(0.005, moved, v, loads(0.5 * walker.weight, 0.5 * walker.weight))
    assert len(walker.plan.steps) == 2
    assert walker.reference.com[:2] == pytest.approx(walker.body.dynamics.com[:2], abs=1e-6)


def test_who_has_come_down_walks_on_over_the_ground_that_is_there(talos: Robot) -> None:
    """Set down 2 m further on, up a slope: the steps lie on it."""
    ground = pw.read_ground("slope:degrees=5")
    plan = pw.FootstepPlanner(0.2, talos.step_width, 0.9).generate_footsteps(3)
    q = standing_configuration(talos, plan[0].pose, plan[1].pose)
    walker = Walker(talos, plan, q, friction=0.8, ground=ground)
    walker.airborne.fly(0.0, plan, walker.body.dynamics, walker.pattern.omega)
    q[0] += 2.0
    q[2] += ground.height(2.0, 0.0)
    walker.tick(0.02, q, np.zeros(talos.pin.nv), loads(0.5 * walker.weight, 0.5 * walker.weight))
    assert walker.airborne.landing is None
    for step, old in zip(walker.plan.steps, plan.steps, strict=True):
        x, y, z = step.pos
        assert (x, y) == pytest.approx((old.pos[0] + 2.0, old.pos[1]), abs=1e-3)
        assert z == pytest.approx(float(ground.height(x, y)), abs=1e-3)


def test_the_swing_height_is_the_legs_unless_told(talos: Robot) -> None:
    walker, _ = standing(talos, 0.0, 0.0)
    assert walker.swing_height == SWING_HEIGHT * talos.leg_length
    for height in (0.06, 0.12):
        plan = pw.FootstepPlanner(0.2, talos.step_width, 0.9).generate_footsteps(2)
        record = pw.Walk(talos, plan, swing_height=height).run().record()
        assert record.left_foot[:, 2, 3].max() == pytest.approx(height, abs=3e-3)
        assert record.run.swing_height == height


def test_the_planned_wrench_is_in_world_axes(talos: Robot) -> None:
    """On a walk that faces 2 rad aside the QP's wrench is what the sole's sensor then reads."""
    planner = pw.FootstepPlanner(0.25, talos.step_width, 0.9)
    record = pw.Walk(talos, planner.generate_footsteps(4, (0.0, 0.0, 2.0))).run().record()
    for foot in ("left", "right"):
        felt, asked = getattr(record, f"{foot}_force"), getattr(record, f"{foot}_force_ref")
        alone = felt[:, 2] > 0.9 * talos.mass * 9.81
        difference = np.median(np.abs(felt - asked)[alone], axis=0)
        size = np.abs(asked[alone]).max(axis=0)
        assert (size[:2] > 20.0).all(), "there are horizontal forces to tell axes apart by"
        # The sensor reads the tick before: a few newtons and newton-metres.
        assert (difference < (5.0, 5.0, 5.0, 2.0, 2.0, 2.0)).all(), difference
