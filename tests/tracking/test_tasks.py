"""Each task's closed loop, stepped in kinematics alone: the robot accelerates just as it asks."""

import numpy as np
import pinocchio as pin
import pytest
from tracking.states import random_state

from preview_walk.robots.robot import Robot
from preview_walk.tracking.dynamics import Dynamics
from preview_walk.tracking.tasks import (
    AngularMomentumTask,
    CoMTask,
    FootTask,
    PostureTask,
    Task,
    TorsoTask,
)
from preview_walk.types import Array

DT = 1e-3


def follow(robot: Robot, task: Task, q: Array, v: Array, duration: float) -> Dynamics:
    """Move with the least accelerations that obey the task; return where it ends."""
    dynamics = Dynamics(robot)
    jacobian, target = np.zeros((task.rows, robot.pin.nv)), np.zeros(task.rows)
    dynamics.update(q, v)
    for _ in range(round(duration / DT)):
        task.update(dynamics, jacobian, target)
        v = v + DT * (np.linalg.pinv(jacobian) @ target)
        q = pin.integrate(robot.pin, q, DT * v)
        dynamics.update(q, v)
    return dynamics


def test_the_com_moves_with_the_acceleration_asked(robot: Robot) -> None:
    task = CoMTask(1.0)
    task.acceleration = np.array([0.3, -0.2, 0.1])
    q, _ = random_state(robot, 0, 0.05)
    end = follow(robot, task, q, np.zeros(robot.pin.nv), 0.5)
    np.testing.assert_allclose(end.com_velocity, 0.5 * task.acceleration, atol=1e-3)


def test_a_foot_settles_on_its_pose(robot: Robot) -> None:
    task = FootTask("left", 1.0, 25.0)
    q, v = random_state(robot, 1, 0.05)
    start = Dynamics(robot)
    start.update(q, v)
    foot = start.soles["left"]
    turn = pin.exp3(np.array([0.1, -0.2, 0.15]))
    task.pose = np.eye(4)
    task.pose[:3, :3] = turn @ foot.rotation
    task.pose[:3, 3] = foot.position + 0.05
    end = follow(robot, task, q, 0.1 * v, 0.6).soles["left"]
    np.testing.assert_allclose(end.position, task.pose[:3, 3], atol=1e-3)
    np.testing.assert_allclose(end.rotation, task.pose[:3, :3], atol=2e-3)
    np.testing.assert_allclose(end.velocity, 0.0, atol=1e-2)


def test_a_foot_on_its_reference_takes_over_the_reference_acceleration(talos: Robot) -> None:
    task = FootTask("right", 1.0, 25.0)
    q, v = random_state(talos, 2)
    dynamics = Dynamics(talos)
    dynamics.update(q, v)
    foot = dynamics.soles["right"]
    task.pose = np.eye(4)
    task.pose[:3, :3], task.pose[:3, 3] = foot.rotation, foot.position
    task.velocity = np.concatenate(
        [foot.rotation @ foot.velocity[:3], foot.rotation @ foot.velocity[3:]]
    )
    task.acceleration = np.arange(6.0)
    jacobian, target = np.zeros((6, talos.pin.nv)), np.zeros(6)
    task.update(dynamics, jacobian, target)
    local = (target + foot.drift).reshape(2, 3) @ foot.rotation.T
    np.testing.assert_allclose(local.reshape(6), task.acceleration, atol=1e-9)


def test_the_torso_turns_upright(robot: Robot) -> None:
    task = TorsoTask(1.0, 12.0)
    task.rotation = pin.exp3(np.array([0.0, 0.0, 0.4]))
    q, v = random_state(robot, 3, 0.05)
    end = follow(robot, task, q, 0.1 * v, 1.2).torso
    np.testing.assert_allclose(end.rotation, task.rotation, atol=2e-3)


def test_turns_are_asked_for_in_the_frames_own_axes(talos: Robot) -> None:
    """However the robot is turned: a turn about the world's axis w is one about R^T w."""
    q, _ = random_state(talos, 6)
    dynamics = Dynamics(talos)
    dynamics.update(q, np.zeros(talos.pin.nv))
    about = np.array([0.3, -0.2, 0.5])
    torso, foot = TorsoTask(1.0, 10.0), FootTask("left", 1.0, 10.0)
    torso.rotation = pin.exp3(about) @ dynamics.torso.rotation
    foot.pose = dynamics.soles["left"].pose
    foot.pose[:3, :3] = pin.exp3(about) @ foot.pose[:3, :3]
    for task, frame in ((torso, dynamics.torso), (foot, dynamics.soles["left"])):
        jacobian, target = np.zeros((task.rows, dynamics.nv)), np.zeros(task.rows)
        task.update(dynamics, jacobian, target)
        np.testing.assert_allclose(target[-3:], 100.0 * frame.rotation.T @ about, atol=1e-9)


def test_angular_momentum_decays_at_its_rate(robot: Robot) -> None:
    task = AngularMomentumTask(1.0, 5.0)
    q, v = random_state(robot, 4, 0.05)
    v = 0.3 * v
    before = Dynamics(robot)
    before.update(q, v)
    momentum = before.momentum_jacobian @ v
    end = follow(robot, task, q, v, 0.2)
    left = end.momentum_jacobian @ end.v
    np.testing.assert_allclose(left, momentum * np.exp(-1.0), atol=0.02 * np.abs(momentum).max())


def test_loose_joints_are_damped_only(talos: Robot) -> None:
    n = talos.pin.nv - 6
    task = PostureTask(np.zeros(n), np.ones(n), 8.0, loose=[3])
    dynamics = Dynamics(talos)
    q, v = random_state(talos, 5)
    dynamics.update(q, v)
    target = np.zeros(n)
    task.target(dynamics, target)
    expected = -64.0 * q[7:] - 16.0 * v[6:]
    expected[3] = -16.0 * v[9]
    np.testing.assert_allclose(target, expected)


@pytest.mark.parametrize("rows", [3])
def test_rows_are_those_written(talos: Robot, rows: int) -> None:
    dynamics = Dynamics(talos)
    for task in (CoMTask(1.0), TorsoTask(1.0, 1.0), AngularMomentumTask(1.0, 1.0)):
        jacobian, target = np.full((rows, dynamics.nv), np.nan), np.full(rows, np.nan)
        task.update(dynamics, jacobian, target)
        assert task.rows == rows
        assert np.isfinite(jacobian).all()
        assert np.isfinite(target).all()
