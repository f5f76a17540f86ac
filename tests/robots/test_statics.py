"""What standing on one leg asks of the motors, and the posture that follows from it."""

from functools import cache

import numpy as np
import pinocchio as pin
import pytest

from preview_walk.robots.building.statics import (
    CROUCHED,
    KNEE_SHARE,
    STRETCHED,
    carrying_torques,
    straightened,
)
from preview_walk.robots.load import load_robot
from preview_walk.robots.reading.description import catalogue
from preview_walk.robots.standing import stance_of
from preview_walk.types import FEET

ROBOT = cache(load_robot)


def stretch_of(robot, q):
    data = robot.pin.createData()
    pin.framesForwardKinematics(robot.pin, data, q)
    return data.oMi[robot.legs["left"].hip].translation[2] / robot.legs["left"].length


def knee_share(robot, q):
    """Return the larger share of a knee's limit that carrying the robot alone takes."""
    shares = []
    for foot in FEET:
        knee = robot.pin.joints[robot.legs[foot].knee].idx_v - 6
        torque = carrying_torques(robot.pin, q, robot.soles[foot].frame)[knee]
        shares.append(abs(torque) / robot.effort[knee])
    return max(shares)


@pytest.mark.parametrize("foot", FEET)
def test_torques_are_the_slope_of_the_potential_energy(foot):
    """Virtual work: turn one joint, the sole staying where it is; all else follows rigidly."""
    robot = ROBOT("humanoid-walker")
    model, q, frame = robot.pin, robot.posture, robot.soles[foot].frame
    data = model.createData()
    pin.computeJointJacobians(model, data, q)
    pin.updateFramePlacements(model, data)
    jacobian = pin.getFrameJacobian(model, data, frame, pin.ReferenceFrame.LOCAL)
    torques = carrying_torques(model, q, frame)
    for joint in range(model.nv - 6):
        turn = np.zeros(model.nv)
        turn[6 + joint] = 1e-5
        turn[:6] = -np.linalg.solve(jacobian[:, :6], jacobian[:, 6 + joint]) * 1e-5
        energy = [
            pin.computePotentialEnergy(model, data, pin.integrate(model, q, sign * turn))
            for sign in (1.0, -1.0)
        ]
        assert (energy[0] - energy[1]) / 2e-5 == pytest.approx(torques[joint], abs=1e-3)


@pytest.mark.parametrize("name", catalogue())
def test_knees_hold_the_walking_posture_which_is_no_straighter_than_it_must_be(name):
    robot = ROBOT(name)
    stretch, share = stretch_of(robot, robot.posture), knee_share(robot, robot.posture)
    assert CROUCHED - 1e-9 <= stretch <= STRETCHED + 1e-9
    assert share <= KNEE_SHARE
    assert stretch == pytest.approx(CROUCHED) or share == pytest.approx(KNEE_SHARE, abs=5e-3)


def test_half_the_knee_torque_makes_a_robot_stand_straighter():
    robot = ROBOT("humanoid-walker")

    def posture(effort):
        return straightened(stance_of(robot), robot.posture, effort * robot.effort)

    assert posture(1.0) is robot.posture
    assert CROUCHED < stretch_of(robot, posture(0.5)) < STRETCHED
    # Knees that could not even hold that do not make it lock them.
    assert stretch_of(robot, posture(0.01)) == pytest.approx(STRETCHED)


def test_the_user_is_told():
    note = "stands straight, at 0.95 of the leg's length: the knees are weak"
    assert note in ROBOT("romeo").notes
    assert not any("knees are weak" in note for note in ROBOT("talos").notes)
