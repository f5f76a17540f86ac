import copy
import pickle
import re
from collections.abc import Callable

import numpy as np
import pinocchio as pin
import pytest
from tracking.states import random_state

from preview_walk.errors import InvalidInput
from preview_walk.robots.robot import Robot
from preview_walk.tracking.dynamics import Dynamics, FrameTerms
from preview_walk.types import Array

H = 1e-5
"""Step (s) of the finite differences: their error is of order H^2 times third derivatives."""


def moved(robot: Robot, q: Array, v: Array, dt: float) -> Array:
    return np.asarray(pin.integrate(robot.pin, q, dt * v))


def at(robot: Robot, q: Array, v: Array) -> Dynamics:
    dynamics = Dynamics(robot)
    dynamics.update(q, v)
    return dynamics


@pytest.mark.parametrize("seed", range(3))
def test_com_jacobian_and_drift_by_finite_differences(robot: Robot, seed: int) -> None:
    q, v = random_state(robot, seed)
    here = at(robot, q, v)
    ahead, behind = (at(robot, moved(robot, q, v, s * H), v) for s in (1, -1))
    np.testing.assert_allclose(here.com_velocity, (ahead.com - behind.com) / (2 * H), atol=1e-7)
    acceleration = (ahead.com_velocity - behind.com_velocity) / (2 * H)
    np.testing.assert_allclose(here.com_drift, acceleration, atol=1e-6)
    np.testing.assert_allclose(here.com_jacobian @ v, here.com_velocity)
    for dof in range(robot.pin.nv):
        unit = np.eye(robot.pin.nv)[dof]
        ahead, behind = (at(robot, moved(robot, q, unit, s * H), unit) for s in (1, -1))
        column = (ahead.com - behind.com) / (2 * H)
        np.testing.assert_allclose(here.com_jacobian[:, dof], column, atol=1e-8)


def terms_of(dynamics: Dynamics, name: str) -> FrameTerms:
    return dynamics.torso if name == "torso" else dynamics.soles[name]  # type: ignore[index]


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("name", ["left", "right", "torso"])
def test_frame_terms_by_finite_differences(robot: Robot, name: str, seed: int) -> None:
    q, v = random_state(robot, seed)
    here = terms_of(at(robot, q, v), name)
    ahead, behind = (terms_of(at(robot, moved(robot, q, v, s * H), v), name) for s in (1, -1))
    rotation = here.rotation

    linear = (ahead.position - behind.position) / (2 * H)
    turn = pin.log3(behind.rotation.T @ ahead.rotation) / (2 * H)
    np.testing.assert_allclose(here.velocity[:3], rotation.T @ linear, atol=1e-7)
    np.testing.assert_allclose(here.velocity[3:], turn, atol=1e-7)
    np.testing.assert_allclose(here.jacobian @ v, here.velocity, atol=1e-12)

    def world(terms: FrameTerms) -> Array:
        return np.concatenate(
            [terms.rotation @ terms.velocity[:3], terms.rotation @ terms.velocity[3:]]
        )

    change = (world(ahead) - world(behind)) / (2 * H)
    drift = np.concatenate([rotation.T @ change[:3], rotation.T @ change[3:]])
    np.testing.assert_allclose(here.drift, drift, atol=1e-5)


@pytest.mark.parametrize("seed", range(3))
def test_momentum_by_finite_differences(robot: Robot, seed: int) -> None:
    q, v = random_state(robot, seed)
    here = at(robot, q, v)
    here.update_momentum()

    def momentum(dt: float) -> Array:
        data = robot.pin.createData()
        h = pin.computeCentroidalMomentum(robot.pin, data, moved(robot, q, v, dt), v)
        return np.array(h.angular)

    np.testing.assert_allclose(here.momentum_jacobian @ v, momentum(0.0), atol=1e-10)
    change = (momentum(H) - momentum(-H)) / (2 * H)
    np.testing.assert_allclose(here.momentum_drift, change, atol=1e-5)


@pytest.mark.parametrize("seed", range(3))
def test_mass_and_bias_are_those_of_inverse_dynamics(robot: Robot, seed: int) -> None:
    q, v = random_state(robot, seed)
    a = np.random.default_rng(seed).standard_normal(robot.pin.nv)
    dynamics = at(robot, q, v)
    mass = np.triu(dynamics.mass) + np.triu(dynamics.mass, 1).T
    np.testing.assert_allclose(dynamics.mass[:6], mass[:6], atol=1e-12)
    torques = pin.rnea(robot.pin, robot.pin.createData(), q, v, a)
    torques[6:] += robot.damping * v[6:]
    np.testing.assert_allclose(mass @ a + dynamics.bias, torques, atol=1e-9)


def test_terms_follow_every_update(talos: Robot) -> None:
    dynamics = Dynamics(talos)
    foot, com, mass = dynamics.soles["left"], dynamics.com, dynamics.mass
    for seed in range(3):
        q, v = random_state(talos, seed)
        dynamics.update(q, v)
        fresh = at(talos, q, v)
        np.testing.assert_array_equal(foot.position, fresh.soles["left"].position)
        np.testing.assert_array_equal(foot.rotation, fresh.soles["left"].rotation)
        np.testing.assert_array_equal(com, fresh.com)
        np.testing.assert_array_equal(mass, fresh.mass)


def test_a_frame_by_name(talos: Robot) -> None:
    dynamics = Dynamics(talos)
    hand = dynamics.frame("arm_left_7_link")
    assert dynamics.frame("arm_left_7_link") is hand
    q, v = random_state(talos, 0)
    dynamics.update(q, v)
    data = talos.pin.createData()
    pin.framesForwardKinematics(talos.pin, data, q)
    np.testing.assert_allclose(hand.position, data.oMf[hand.frame].translation)
    np.testing.assert_allclose(hand.jacobian @ v, hand.velocity, atol=1e-12)


def test_an_unknown_frame(talos: Robot) -> None:
    said = re.escape("expected the name of a frame of talos, got 'third_arm'; it has universe, ")
    with pytest.raises(InvalidInput, match=said):
        Dynamics(talos).frame("third_arm")


@pytest.mark.parametrize("copied", [lambda x: pickle.loads(pickle.dumps(x)), copy.deepcopy])
def test_a_copy_is_at_the_same_state(robot: Robot, copied: Callable[[Dynamics], Dynamics]) -> None:
    """Before the next update too: whoever asks a walk's copy for its CoM gets the walk's."""
    here = at(robot, *random_state(robot, 1))
    hand = here.add_frame(robot.pin.nframes - 1)
    twin = copied(here)
    for name in ("q", "v", "com", "com_velocity", "com_jacobian", "com_drift", "bias"):
        assert (getattr(twin, name) == getattr(here, name)).all(), name
    assert (twin.add_frame(hand.frame).pose == hand.pose).all()
    assert twin.com is not here.com
