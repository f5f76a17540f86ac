"""The momentum model against MuJoCo's angular momentum of the whole robot."""

import mujoco
import numpy as np
import pinocchio as pin
import pytest

from preview_walk.constants import GRAVITY
from preview_walk.controller.momentum_model import momentum_model
from preview_walk.footsteps.footstep import Footstep
from preview_walk.footsteps.plan import FootstepPlan
from preview_walk.geometry.poses import pose_at
from preview_walk.pattern.swing import swing_of
from preview_walk.pattern.swing_moment import MomentumModel, swing_zmp_shift
from preview_walk.robots.load import load_robot
from preview_walk.robots.robot import Robot
from preview_walk.robots.state import to_mujoco
from preview_walk.types import FEET, Array, Foot, other

WORLD = pin.ReferenceFrame.LOCAL_WORLD_ALIGNED


@pytest.fixture(scope="module")
def robot() -> Robot:
    return load_robot("talos")


@pytest.fixture(scope="module")
def model(robot: Robot) -> MomentumModel:
    return momentum_model(robot)


def angular_momentum(robot: Robot, q: Array, v: Array) -> Array:
    """Return the whole robot's angular momentum (3,) about its CoM, by MuJoCo."""
    data = mujoco.MjData(robot.mj)
    to_mujoco(q, v, data.qpos, data.qvel)
    mujoco.mj_forward(robot.mj, data)
    mujoco.mj_subtreeVel(robot.mj, data)
    return np.array(data.subtree_angmom[0])


def velocity_for(
    robot: Robot, q: Array, swing: Foot, foot_velocity: Array, com_velocity: Array
) -> Array:
    """Return the smallest v (nv,) with these velocities (3,), all else of the gait at rest.

    By the normal equations of the constraints, found here from Pinocchio's Jacobians.
    """
    data = robot.pin.createData()
    pin.computeJointJacobians(robot.pin, data, q)
    pin.updateFramePlacements(robot.pin, data)
    com = pin.jacobianCenterOfMass(robot.pin, data, q)

    def jacobian(frame: int) -> Array:
        return np.asarray(pin.getFrameJacobian(robot.pin, data, frame, WORLD))

    rows = np.vstack(
        [
            com,
            jacobian(robot.soles[other(swing)].frame),
            jacobian(robot.torso)[3:],
            jacobian(robot.soles[swing].frame),
        ]
    )
    wanted = np.concatenate([com_velocity, np.zeros(9), foot_velocity, np.zeros(3)])
    v = rows.T @ np.linalg.solve(rows @ rows.T, wanted)
    assert rows @ v == pytest.approx(wanted, abs=1e-9)
    return np.asarray(v)


@pytest.mark.parametrize("foot", FEET)
def test_is_the_momentum_of_a_moving_foot_in_the_posture(
    robot: Robot, model: MomentumModel, foot: Foot
) -> None:
    for axis in range(3):
        velocity = np.eye(3)[axis]
        v = velocity_for(robot, robot.posture, foot, velocity, np.zeros(3))
        momentum = angular_momentum(robot, robot.posture, v)
        assert model.foot[foot] @ velocity == pytest.approx(momentum, abs=1e-6)


def test_is_the_momentum_of_a_moving_com_in_the_posture(robot: Robot, model: MomentumModel) -> None:
    """Half and half of either foot standing, as the model takes it."""
    for axis in range(3):
        velocity = np.eye(3)[axis]
        momenta = [
            angular_momentum(
                robot,
                robot.posture,
                velocity_for(robot, robot.posture, foot, np.zeros(3), velocity),
            )
            for foot in FEET
        ]
        assert model.com @ velocity == pytest.approx(np.mean(momenta, axis=0), abs=1e-6)
    assert model.mass == robot.mass


def test_a_symmetric_robot_has_a_mirrored_model(model: MomentumModel) -> None:
    mirror = np.diag((1.0, -1.0, 1.0))
    # Angular momentum is a pseudovector: its mirror image changes sign too.
    mirrored = -mirror @ model.foot["left"] @ mirror
    assert mirrored == pytest.approx(model.foot["right"], abs=0.05)


@pytest.mark.parametrize("foot", FEET)
def test_foresees_the_zmp_shift_of_the_multibody_robot(
    robot: Robot, model: MomentumModel, foot: Foot
) -> None:
    """A small step, CoM and trunk at rest: the robot is moved along it, and L differentiated.

    Each configuration is one small integration step from the last; MuJoCo says what L is.
    """
    soles, height = {}, 0.03
    data = robot.pin.createData()
    pin.framesForwardKinematics(robot.pin, data, robot.posture)
    for side in FEET:
        soles[side] = pose_at(*data.oMf[robot.soles[side].frame].translation[:2].tolist())
    landing = pose_at(soles[foot][0, 3] + 0.08, soles[foot][1, 3])
    step = Footstep(foot, landing, 2.0, 2.6)
    plan = FootstepPlan.standing(soles["left"], soles["right"]).replace_after(0.0, [step])
    swing, dt = swing_of(plan, step, height), 0.005
    q, momenta = np.array(robot.posture), []
    samples = np.arange(round((step.land - step.lift) / dt) + 1, dtype=np.float64)
    times: Array = step.lift + dt * samples
    for t in times:
        v = velocity_for(robot, q, foot, swing.at(t)[1][:3], np.zeros(3))
        momenta.append(angular_momentum(robot, q, v))
        half = pin.integrate(robot.pin, q, 0.5 * dt * v)
        middle = velocity_for(robot, half, foot, swing.at(t + 0.5 * dt)[1][:3], np.zeros(3))
        q = pin.integrate(robot.pin, q, dt * middle)
    rate = np.gradient(np.array(momenta), dt, axis=0)
    true = np.column_stack([-rate[:, 1], rate[:, 0]]) / (robot.mass * GRAVITY)
    foreseen = swing_zmp_shift(plan, times, model, height)
    inner = slice(2, -2)
    assert np.abs(true[inner, 0]).max() > 0.01
    # To first order: 8 cm forward and 4 cm up are not nothing to a leg of 0.8 m.
    assert np.abs(foreseen - true)[inner].max() < 0.15 * np.abs(true[inner]).max()


def test_the_figures_of_the_theory(robot: Robot, model: MomentumModel) -> None:
    """What docs/theory.md, section 4, says of TALOS."""
    assert robot.com_height == pytest.approx(0.876, abs=5e-4)
    assert model.effective_height(robot.com_height) == pytest.approx(1.009, abs=5e-4)
    assert (GRAVITY / model.effective_height(robot.com_height)) ** 0.5 == pytest.approx(
        3.12, abs=5e-3
    )
    half = 0.5 * robot.step_width
    plan = FootstepPlan.standing(pose_at(-0.25, half), pose_at(0.0, -half)).replace_after(
        0.0, [Footstep("left", pose_at(0.25, half), 1.0, 1.7)]
    )
    shift = swing_zmp_shift(plan, np.arange(0.0, 2.0, 0.005), model, 0.06 * robot.leg_length)
    assert np.abs(shift).max() == pytest.approx(0.055, abs=5e-4)
