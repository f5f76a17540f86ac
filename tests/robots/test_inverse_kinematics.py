"""The Gauss-Newton loop of all postures, on a robot and against plain algebra."""

import numpy as np
import pinocchio as pin
import pytest

from preview_walk.robots.building.inverse_kinematics import Stop, gauss_newton, sole_rows
from preview_walk.robots.load import load_robot


@pytest.fixture(scope="module")
def robot():
    return load_robot("humanoid-walker")


def test_the_rows_of_a_sole_are_the_slope_of_its_miss(robot):
    """Central differences of the error along every velocity coordinate."""
    model, data, frame = robot.pin, robot.pin.createData(), robot.soles["left"].frame
    target = pin.SE3(pin.rpy.rpyToMatrix(0.1, -0.2, 0.3), np.array((0.05, 0.1, 0.02)))

    def rows(q):
        pin.computeJointJacobians(model, data, q)
        pin.updateFramePlacements(model, data)
        return sole_rows(model, data, frame, target)

    _, jacobian = rows(robot.posture)
    step = 1e-6
    for column in range(model.nv):
        turn = np.zeros(model.nv)
        turn[column] = step
        ahead, _ = rows(pin.integrate(model, robot.posture, turn))
        behind, _ = rows(pin.integrate(model, robot.posture, -turn))
        np.testing.assert_allclose((ahead - behind) / (2 * step), jacobian[:, column], atol=1e-8)


def test_directions_that_do_not_matter_have_no_rows(robot):
    model, data = robot.pin, robot.pin.createData()
    pin.computeJointJacobians(model, data, robot.posture)
    pin.updateFramePlacements(model, data)
    target = pin.SE3(pin.rpy.rpyToMatrix(0.1, -0.2, 0.3), np.ones(3))
    error, jacobian = sole_rows(model, data, robot.soles["left"].frame, target, (3,))
    assert error[3] == 0.0
    assert not jacobian[3].any()
    assert (np.delete(error, 3) != 0.0).all()


def test_what_must_vanish_does_and_the_rest_is_as_small_as_can_be(robot):
    """The joints can obey one of two wishes: exactly the first, while the second is given up."""
    model, place = robot.pin, 7

    def residual(q):
        jacobian = np.zeros((2, model.nv))
        jacobian[0, 6] = jacobian[1, 6] = 1.0
        return np.array((q[place] - 0.2, 0.0 * q[place])), jacobian * ((1.0,), (0.0,))

    q, left = gauss_newton(model, robot.posture, [6], residual, Stop(1e-12, 20, exact=1))
    assert left < 1e-12
    assert q[place] == pytest.approx(0.2, abs=1e-12)
    others = np.delete(q, place)
    np.testing.assert_array_equal(others, np.delete(robot.posture, place))


def test_it_gives_up(robot):
    jacobian = np.zeros((1, robot.pin.nv))
    jacobian[0, 6] = 1.0
    _, left = gauss_newton(
        robot.pin, robot.posture, [6], lambda q: (np.ones(1), jacobian), Stop(1e-9, 3)
    )
    assert left == 1.0
